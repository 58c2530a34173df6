// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_gauss_seidel.hpp>

#include "oracle/naive_friction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace one_contact_test {

/// The largest violation of the law, relative to q, by the oracle.
template <int N>
double violation(Eigen::Matrix<double, N, N> const& W, Eigen::Matrix<double, N, 1> const& q,
                 double mu, Eigen::Matrix<double, N, 1> const& r) {
  using oracle::friction_real;
  oracle::friction_vector m(1);
  m[0] = mu;
  auto const all =
      oracle::naive_friction(oracle::friction_matrix(W.template cast<friction_real>()),
                             oracle::friction_vector(q.template cast<friction_real>()), m,
                             oracle::friction_vector(r.template cast<friction_real>()));
  return double(all[0].natural_map) / q.norm();
}

template <int N>
void check_random(bool symmetric) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  auto const number = [&](auto...) { return normal(random); };
  int slips = 0, sticks = 0, opens = 0;
  for (int k = 0; k < 2000; ++k) {
    using matrix = Eigen::Matrix<double, N, N>;
    matrix const H = matrix::NullaryExpr(number), skew = matrix::NullaryExpr(number);
    matrix W = H * H.transpose() + 0.05 * matrix::Identity();
    if (!symmetric) W += 0.1 * (skew - skew.transpose());
    Eigen::Matrix<double, N, 1> const q = Eigen::Matrix<double, N, 1>::NullaryExpr(number);
    double const mu = std::exp(normal(random));
    auto const c = slant::contact::detail::solve_one_contact<N, double>(W, q, mu, 0.);
    CHECK(violation<N>(W, q, mu, c.r) <= 1e-13 * (1 + mu) * (1 + W.norm() * c.r.norm() / q.norm()));
    (c.r(0) == 0 ? opens : c.slip > 0 ? slips : sticks) += 1;
    if (c.slip > 0) {
      // u_t = −λ r_t, from any guess.
      Eigen::Matrix<double, N, 1> const u = W * c.r + q;
      CHECK((u + c.slip * c.r).template tail<N - 1>().norm() <= 1e-10 * q.norm() * (1 + c.slip));
      auto const warm =
          slant::contact::detail::solve_one_contact<N, double>(W, q, mu, 1e6 * (1 + c.slip));
      CHECK(violation<N>(W, q, mu, warm.r) <=
            1e-13 * (1 + mu) * (1 + W.norm() * warm.r.norm() / q.norm()));
    }
  }
  CHECK(opens > 200);
  CHECK(sticks > 200);
  CHECK(slips > 200);
}

TEST_CASE("one contact: random data in the plane and in space, symmetric or not") {
  check_random<2>(true);
  check_random<2>(false);
  check_random<3>(true);
  check_random<3>(false);
}

TEST_CASE("one contact: no friction, and very much of it") {
  Eigen::Matrix3d W;
  W << 2, 0.5, 0, 0.5, 1, 0, 0, 0, 3;
  Eigen::Vector3d const q(-1, 2, 3);
  auto const smooth = slant::contact::detail::solve_one_contact<3, double>(W, q, 0., 0.);
  CHECK(smooth.r == Eigen::Vector3d(0.5, 0, 0));
  CHECK(smooth.slip == 0);
  auto const rough = slant::contact::detail::solve_one_contact<3, double>(W, q, 1e8, 0.);
  CHECK((W * rough.r + q)(0) == doctest::Approx(0).epsilon(1e-12));
  CHECK(violation<3>(W, q, 1e8, rough.r) <= 1e-6);  // û is as large as μ
  // Only the normal component: closed at its own impulse, open when it leaves.
  CHECK(slant::contact::detail::solve_one_contact<3, double>(W, Eigen::Vector3d(1, 2, 3), 1., 0.)
            .r.norm() == 0);
}

TEST_CASE("one contact: hardly any friction, slip λ beyond the range of squares") {
  Eigen::Matrix3d W = Eigen::Matrix3d::Identity();
  W(1, 2) = W(2, 1) = 0.5;
  for (double const mu : {1e-150, 1e-160, 1e-200, 1e-300, 1e-320}) {
    for (double const guess : {0., 1e10, 1e300}) {
      auto const c = slant::contact::detail::solve_one_contact<3, double>(
          W, Eigen::Vector3d(-1, 3, 4), mu, guess);
      CHECK(c.r(0) == doctest::Approx(1));
      CHECK(std::abs(c.r(1) / mu + 0.6) <= 1e-3);  // digits of mu itself where it is subnormal
      CHECK(std::abs(c.r(2) / mu + 0.8) <= 1e-3);
      CHECK(c.slip > 1e149);
    }
  }
  // A block that is tiny: its determinant is below the range.
  auto const c = slant::contact::detail::solve_one_contact<3, double>(
      1e-170 * W, Eigen::Vector3d(-1, 0.1, 0.1), 1., 0.);
  CHECK((1e-170 * W * c.r + Eigen::Vector3d(-1, 0.1, 0.1)).norm() <= 1e-15);
}

}  // namespace one_contact_test
