// SPDX-License-Identifier: MIT
#include "coulomb_scenes.hpp"

#include <slant/contact/parts/extension.hpp>
#include <support/testing.hpp>

namespace extension_test {

/// ‖d‖_{A⁻¹} of a brick by dense linear algebra, A = B K⁻¹Bᵀ.
struct brick {
  fem::contact_scene<3> scene = fem::make_steel_brick({.k = 3, .load = fem::brick_load::lift});
  contact::data<double> data = test::contact_data(scene);
  contact::detail::scene_matrices<double> matrices{scene.K, data};
  contact::detail::extension<double> extension{};
  MatrixXd A = test::dense_dual(scene.K, data).A;
  double exact(VectorXd const& d) const { return std::sqrt(d.dot(A.ldlt().solve(d))); }
};

/// A reduced gradient as runs leave it: rough, on a part of the contacts.
VectorXd rough(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  VectorXd d = VectorXd::Zero(size);
  for (double& entry : d) entry = random() % 3 == 0 ? gauss(random) : 0;
  return d;
}

TEST_CASE("extension: each displacement bounds the norm from above, a relaxed one closely") {
  brick s;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    VectorXd const d = rough(s.A.rows(), seed);
    double const exact = s.exact(d), zero = s.extension.by_zero(s.matrices, d);
    double const relaxed = s.extension.relaxed(s.matrices, d, 12, 0);
    CHECK(zero >= exact);
    CHECK(relaxed >= exact * (1 - 1e-12));
    CHECK(relaxed < zero);
    CHECK(relaxed <= 1.1 * exact);
    CHECK(s.extension.tail(s.matrices) <= 1e-10 * exact);
  }
}

TEST_CASE("extension: no more relaxations than asked for, none where the norm is small enough") {
  brick s;
  VectorXd const d = rough(s.A.rows(), 3);
  double const zero = s.extension.by_zero(s.matrices, d);
  CHECK(s.extension.relaxed(s.matrices, d, 12, 2 * zero) == zero);
  double const one = s.extension.relaxed(s.matrices, d, 1, 0);
  CHECK(one < zero);
  CHECK(s.extension.relaxed(s.matrices, d, 1, 0) <= one);  // goes on from there
  (void)s.extension.by_zero(s.matrices, d);
  // What is asked for may be impossible, or negative.
  double const most = s.extension.relaxed(s.matrices, d, 12, -1);
  (void)s.extension.by_zero(s.matrices, d);
  CHECK(most == s.extension.relaxed(s.matrices, d, 12, 0));
}

TEST_CASE("extension: in any units") {
  brick s;
  VectorXd const d = rough(s.A.rows(), 4);
  (void)s.extension.by_zero(s.matrices, d);
  double const there = s.extension.relaxed(s.matrices, d, 6, 0);
  for (int const power : {-400, 400}) {
    VectorXd const tiny = std::ldexp(1.0, power) * d;
    (void)s.extension.by_zero(s.matrices, tiny);
    CHECK(s.extension.relaxed(s.matrices, tiny, 6, 0) == std::ldexp(there, power));
    auto other = s.scene.K;
    other *= std::ldexp(1.0, power);
    contact::detail::scene_matrices<double> const scaled(other, s.data);
    (void)s.extension.by_zero(scaled, d);
    CHECK(s.extension.relaxed(scaled, d, 6, 0) == doctest::Approx(std::ldexp(there, power / 2)));
  }
}

TEST_CASE("extension: rows that are empty or depend on each other") {
  brick s;
  auto data = s.data;
  data.d[2] = std::numeric_limits<double>::infinity();  // never meets its obstacle
  contact::detail::scene_matrices<double> const without(s.scene.K, data);
  VectorXd d = rough(s.A.rows(), 5);
  d(2) = 1;
  CHECK(std::isinf(s.extension.by_zero(without, d)));
  CHECK(std::isinf(s.extension.relaxed(without, d, 3, 0)));
  d(2) = 0;
  CHECK(s.extension.by_zero(without, d) > 0);

  // The same row twice, and what it can do.
  data = s.data;
  for (Eigen::Index j = 0; j < data.N.cols(); ++j) data.N.coeffRef(1, j) = data.N.coeff(0, j);
  contact::detail::scene_matrices<double> const twice(s.scene.K, data);
  CHECK_FALSE(twice.is_orthogonal);
  d = rough(s.A.rows(), 6);
  d(1) = d(0);
  double const zero = s.extension.by_zero(twice, d);
  CHECK(std::isfinite(zero));
  CHECK(s.extension.tail(twice) <= 1e-6 * zero);
  CHECK(s.extension.relaxed(twice, d, 3, 0) == zero);
}

}  // namespace extension_test
