// SPDX-License-Identifier: MIT
#include <fem/mini_element.hpp>
#include <fem/triangle_quadrature.hpp>
#include <support/testing.hpp>

namespace mini_element_test {

using Eigen::Matrix3d;

Eigen::Matrix<double, 2, 3> const corners{{0.1, 1.3, 0.4}, {-0.2, 0.3, 1.1}};

/// x^i y^j over the triangle (0,0), (1,0), (0,1): i! j! / (i + j + 2)!.
TEST_CASE("triangle rule: exact to degree 5 and not beyond") {
  auto const error = [](int i, int j) {
    double sum = 0;
    for (auto const& q : fem::triangle_points())
      sum += q.weight / 2 * std::pow(q.at[1], i) * std::pow(q.at[2], j);
    return std::abs(sum - std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3));
  };
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j) CHECK(error(i, j) < 1e-16);
  CHECK(error(6, 0) > 1e-6);
}

TEST_CASE("edge rule: exact to degree 5 and not beyond") {
  auto const error = [](int i) {
    double sum = 0;
    for (auto const& q : fem::edge_points()) sum += q.weight * std::pow(q.at, i);
    return std::abs(sum - 1.0 / (i + 1));
  };
  for (int i = 0; i <= 5; ++i) CHECK(error(i) < 1e-15);
  CHECK(error(6) > 1e-4);
}

struct quadrature {
  fem::p1_element<2> element = fem::make_p1_element<2>(corners);

  [[nodiscard]] Vector2d bubble_gradient(Vector3d const& φ) const {
    return 27 * element.gradients * Vector3d(φ[1] * φ[2], φ[0] * φ[2], φ[0] * φ[1]);
  }
  template <class F>
  [[nodiscard]] auto integral(F const& f) const {
    auto const points = fem::triangle_points();
    auto sum = (points[0].weight * element.volume * f(points[0].at)).eval();
    for (std::size_t i = 1; i < points.size(); ++i)
      sum += points[i].weight * element.volume * f(points[i].at);
    return sum;
  }
};

TEST_CASE("the condensed element is that of the eliminated bubbles") {
  double const ν = 0.3;
  quadrature const q;
  fem::mini_element const mini(q.element, ν);

  double const A_β = q.integral([&](Vector3d const& φ) {
    return Eigen::Matrix<double, 1, 1>(ν * q.bubble_gradient(φ).squaredNorm());
  })(0);
  Eigen::Matrix<double, 3, 2> const B_β = -q.integral([&](Vector3d const& φ) {
    return Eigen::Matrix<double, 3, 2>(φ * q.bubble_gradient(φ).transpose());
  });
  double const scale = A_β;
  CHECK((mini.stabilisation() - B_β * B_β.transpose() / A_β).norm() < 1e-15 / A_β);
  CHECK((mini.stiffness() -
         Matrix3d(ν * q.element.volume * q.element.gradients.transpose() * q.element.gradients))
            .norm() < 1e-15 * scale);
  CHECK((mini.divergence() - q.integral([&](Vector3d const& φ) {
          return Eigen::Matrix<double, 2, 3>(-φ[0] * q.element.gradients);
        })).norm() < 1e-15);

  Vector2d const load(0.3, -0.7);
  Vector3d const p(1, 2, -0.4);
  CHECK((mini.bubble(load, p) - (load - B_β.transpose() * p) / A_β).norm() < 1e-15);
  CHECK((mini.divergence_of_bubble_load(load) + B_β * load / A_β).norm() < 1e-15);
  CHECK(mini.bubble_integral() == doctest::Approx(q.integral([](Vector3d const& φ) {
          return Eigen::Matrix<double, 1, 1>(fem::mini_element::bubble_at(φ));
        })(0)));
  CHECK(fem::mini_element::bubble_at({1.0 / 3, 1.0 / 3, 1.0 / 3}) == doctest::Approx(1));
  // ∫ ∇φ_a·∇β = 0: this is why there is nothing else to condense.
  CHECK(q.integral([&](Vector3d const& φ) { return q.bubble_gradient(φ); }).norm() < 1e-15);
}

}  // namespace mini_element_test
