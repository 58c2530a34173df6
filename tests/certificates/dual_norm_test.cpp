// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace dual_norm_test {

auto spd(VectorXd const& d) {
  return slant::diagonal<slant::positive_definite>(d);
}

TEST_CASE("dual norm of a diagonal operator, from below by the limit of steps, from above by M") {
  VectorXd const a = VectorXd::LinSpaced(50, 1, 100);
  VectorXd const d = VectorXd::LinSpaced(50, -1, 2);
  double const exact = std::sqrt(d.cwiseAbs2().cwiseQuotient(a).sum());
  auto const A = spd(a);
  VectorXd const ones = VectorXd::Ones(50);
  auto const M = spd(ones);  // M ⪰ A⁻¹
  auto wa = slant::workspace(A, d);
  slant::dual_norm_workspace w(M, d);
  for (slant::index const most : {0, 1, 3, 10, 60}) {
    auto const above = slant::dual_norm(A, M, d, most, true, wa, w);
    CHECK(above.value >= exact * (1 - 1e-14));
    CHECK(above.applications <= most);
  }
  CHECK(slant::dual_norm(A, M, d, 60, true, wa, w).value <= 1.25 * exact);
  auto const estimate = slant::dual_norm(A, M, d, 60, false, wa, w);
  CHECK(estimate.value == doctest::Approx(exact).epsilon(0.3));
  CHECK(estimate.applications < 30);
}

TEST_CASE(
    "dual norm with the exact inverse takes one step; units do not matter; nothing allocates") {
  VectorXd const a = VectorXd::LinSpaced(20, 1, 50), inverse = a.cwiseInverse();
  VectorXd const d = VectorXd::LinSpaced(20, 1, 2);
  auto const A = spd(a);
  auto const M = spd(inverse);
  auto wa = slant::workspace(A, d);
  slant::dual_norm_workspace w(M, d);
  double const exact = std::sqrt(d.cwiseAbs2().cwiseQuotient(a).sum());
  auto const one = slant::dual_norm(A, M, d, 10, true, wa, w);
  CHECK(one.applications == 1);
  CHECK(one.value == doctest::Approx(exact).epsilon(1e-12));
  VectorXd const large = 0x1p900 * d;
  slant::testing::allocation_guard guard;
  auto const scaled = slant::dual_norm(A, M, large, 10, true, wa, w);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(scaled.value == 0x1p900 * one.value);
  VectorXd const zero = VectorXd::Zero(20);
  CHECK(slant::dual_norm(A, M, zero, 10, true, wa, w).value == 0);
}

TEST_CASE("dual norm: M that is A⁻¹ but for rounding makes products underflow, which is no end") {
  MatrixXd a = MatrixXd::Identity(6, 6);
  a(1, 0) = a(0, 1) = a(2, 1) = a(1, 2) = a(3, 2) = a(2, 3) = 1e-60;
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(a);
  VectorXd const d = VectorXd::Unit(6, 0);
  auto wa = slant::workspace(A, d);
  slant::dual_norm_workspace w(slant::identity(6), d);
  double const value = slant::dual_norm(A, slant::identity(6), d, 60, false, wa, w).value;
  CHECK(std::abs(value - 1.5) <= 0.51);  // the norm, and at most as much for what may be left
}

TEST_CASE("dual norm: directions that A or M does not see are not counted as nothing") {
  VectorXd a = VectorXd::Ones(4), m = VectorXd::Ones(4);
  m(3) = 0;
  auto const A = slant::diagonal(a), M = slant::diagonal(m);
  auto wa = slant::workspace(A, a);
  slant::dual_norm_workspace w(M, a);
  VectorXd const hidden = VectorXd::Unit(4, 3), both = VectorXd::Ones(4);
  CHECK(std::isinf(slant::dual_norm(A, M, hidden, 9, false, wa, w).value));
  CHECK(std::isinf(slant::dual_norm(A, M, both, 9, false, wa, w).value));
  auto wm = slant::workspace(M, a);
  slant::dual_norm_workspace w2(A, a);
  CHECK(std::isinf(slant::dual_norm(M, A, hidden, 9, false, wm, w2).value));
}

TEST_CASE("dual norm, A singular: what rounding leaves of d in the kernel does not count") {
  VectorXd a = VectorXd::LinSpaced(6, 1, 2);
  a(5) = 0;
  auto const A = slant::diagonal(a);
  auto wa = slant::workspace(A, a);
  auto const I = slant::identity(6);
  slant::dual_norm_workspace w(I, a);
  VectorXd d = VectorXd::Ones(6);
  double const exact = std::sqrt(a.head(5).cwiseInverse().sum());
  slant::gradient_size<double> const sizes{1.0, 1.0};
  for (double const unit : {1.0, 0x1p-400}) {
    slant::gradient_size<double> const scaled{unit * sizes.point, unit * sizes.load};
    d(5) = 1e-16;
    VectorXd const noisy = unit * d;
    CHECK(slant::dual_norm(A, I, noisy, 50, false, wa, w, scaled).value ==
          doctest::Approx(unit * exact));
    d(5) = 1e-6;
    VectorXd const more = unit * d;
    CHECK(std::isinf(slant::dual_norm(A, I, more, 50, false, wa, w, scaled).value));
  }
}

TEST_CASE("of a vector that is not finite nothing is known") {
  VectorXd const a = VectorXd::LinSpaced(5, 1, 5);
  auto const A = spd(a);
  for (double const bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    VectorXd d = VectorXd::Ones(5);
    d(2) = bad;
    auto wa = slant::workspace(A, d);
    slant::dual_norm_workspace w(A, d);
    CHECK_FALSE(slant::dual_norm(A, A, d, 10, false, wa, w).value <= 1e300);
  }
}

}  // namespace dual_norm_test
