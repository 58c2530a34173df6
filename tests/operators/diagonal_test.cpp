// SPDX-License-Identifier: MIT
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace diagonal_test {

TEST_CASE("a diagonal matrix") {
  VectorXd d = VectorXd::LinSpaced(6, -2, 3);
  auto const a = slant::diagonal(d);
  CHECK(test::matches(a, MatrixXd(d.asDiagonal()), 0));
  static_assert(slant::self_adjoint_operator<decltype(a), VectorXd>);
  static_assert(!slant::has_inverse<decltype(a), VectorXd>);
  slant::testing::check_operator_laws(a);
  d[0] = 17;  // referenced
  CHECK(a.entries()[0] == 17);
}

TEST_CASE("a multiple is added in the range of the result") {
  VectorXd const d = VectorXd::Constant(2, 0x1p600), x = VectorXd::Constant(2, 0x1p-600);
  VectorXd y = VectorXd::Zero(2);
  CHECK(test::allocations_of([&] { slant::diagonal(d).apply_add(0x1p600, x, y); }) == 0);
  CHECK(y == d);
}

TEST_CASE("temporaries are owned, expressions evaluated") {
  VectorXd const d = VectorXd::LinSpaced(4, 1, 4);
  CHECK(test::matches(slant::diagonal(VectorXd(d)), MatrixXd(d.asDiagonal()), 0));
  CHECK(test::matches(slant::diagonal(2 * d), MatrixXd((2 * d).asDiagonal()), 0));
  auto const expression = d.cwiseInverse();
  CHECK(test::matches(slant::diagonal(expression), MatrixXd(expression.asDiagonal()), 0));
}

TEST_CASE("definite ones have an inverse") {
  auto const a = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::LinSpaced(4, 1, 4)));
  static_assert(slant::spd_operator<decltype(a), VectorXd>);
  static_assert(slant::has_inverse<decltype(a), VectorXd>);
  static_assert(slant::spd_operator<decltype(a.inverse()), VectorXd>);
  slant::testing::check_operator_laws(a);
}

TEST_CASE("an inverse that would not be finite is refused") {
  auto const a = slant::diagonal<slant::positive_definite>(VectorXd(Vector3d(1, 1e-310, 2)));
  CHECK(SLANT_COMPLAINT(a.inverse()) ==
        "d[1]: got 1e-310, expected a number with a finite reciprocal");
}

TEST_CASE("laws are verified") {
  using namespace slant;
  VectorXd d = VectorXd::Ones(3);
  auto const reason = [&](auto make) { return SLANT_COMPLAINT(make(d)); };
  auto const any = [](auto const& v) { (void)slant::diagonal(v); };
  auto const definite = [](auto const& v) { (void)slant::diagonal<positive_definite>(v); };
  auto const semidefinite = [](auto const& v) { (void)slant::diagonal<positive_semidefinite>(v); };
  auto const projection = [](auto const& v) { (void)slant::diagonal<projector>(v); };
  auto const firm = [](auto const& v) { (void)slant::diagonal<firmly_nonexpansive>(v); };

  for (double const allowed : {0.0, 1.0}) {
    d[1] = allowed;
    semidefinite(d);
    projection(d);
    firm(d);
  }
  d[1] = 0;
  CHECK(reason(definite) == "d[1]: got 0, expected a number > 0");
  d[1] = -2;
  any(d);
  CHECK(reason(semidefinite) == "d[1]: got -2, expected a number >= 0");
  d[1] = 0.5;
  firm(d);
  CHECK(reason(projection) == "d[1]: got 0.5, expected 0 or 1");
  d[1] = 1.5;
  CHECK(reason(firm) == "d[1]: got 1.5, expected a number in [0, 1]");
  d[1] = std::numeric_limits<double>::infinity();
  CHECK(reason(any) == "d[1]: got inf, expected a finite number");
  d[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(reason(any) == "d[1]: got nan, expected a finite number");
}

TEST_CASE("entries may be any kind of vector") {
  slant::testing::archetype::vector const d(VectorXd(VectorXd::LinSpaced(3, 1, 2)));
  slant::testing::check_operator_laws(slant::diagonal(d), d);
}

TEST_CASE("the identity") {
  auto const a = slant::identity(5);
  static_assert(slant::spd_operator<slant::identity_operator, VectorXd>);
  static_assert(slant::declares_projector<slant::identity_operator>);
  static_assert(slant::declares_firmly_nonexpansive<slant::identity_operator>);
  CHECK(test::matches(a, MatrixXd(MatrixXd::Identity(5, 5)), 0));
  slant::testing::check_operator_laws(a);
  slant::testing::check_operator_laws(a, Eigen::VectorXf());
  slant::testing::check_operator_laws(a, slant::testing::archetype::vector(VectorXd()));
  CHECK(slant::identity(0).rows() == 0);
  CHECK(SLANT_COMPLAINT(slant::identity(-1)) == "n: got -1, expected a size >= 0");
}

TEST_CASE("the zero operator") {
  auto const wide = slant::zero(2, 3);
  CHECK(test::matches(wide, MatrixXd(MatrixXd::Zero(2, 3)), 0));
  static_assert(slant::laws_of<decltype(wide)> == slant::law_set{});
  slant::testing::check_operator_laws(wide);
  auto const square = slant::zero(3);
  static_assert(slant::psd_operator<decltype(square), VectorXd>);
  static_assert(!slant::spd_operator<decltype(square), VectorXd>);
  static_assert(slant::declares_projector<decltype(square)>);
  slant::testing::check_operator_laws(square);
  CHECK(SLANT_COMPLAINT(slant::zero(2, -1)) == "cols: got -1, expected a size >= 0");
}

}  // namespace diagonal_test
