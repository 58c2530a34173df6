// SPDX-License-Identifier: MIT
#include <slant/operators/identity.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace identity_test {

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

}  // namespace identity_test
