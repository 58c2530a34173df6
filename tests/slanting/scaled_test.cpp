// SPDX-License-Identifier: MIT
#include "slanting_support.hpp"

#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/max.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/slanting_laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>
#include <type_traits>

namespace scaled_test {

using Eigen::VectorXd;

TEST_CASE("values and slanting operators are multiplied") {
  auto const f = slant::scale(-2.5, slant::positive_part(3));
  VectorXd const y{{1.0, -2.0, 0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{-2.5, 0.0, 0.0}});
  Eigen::MatrixXd const expected = Eigen::Vector3d(-2.5, 0, -2.5).asDiagonal();
  CHECK(slanting_support::dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y);
  CHECK(slant::evaluate(slant::scale(2, slant::positive_part(3)), y)[0] == 2);
}

TEST_CASE("only a factor marked as positive keeps definiteness") {
  auto const any = slant::scale(2.0, slant::positive_part(3));
  auto const positive = slant::scale(slant::positive(2.0), slant::positive_part(3));
  using any_slope = slant::slant_operator_t<std::remove_cvref_t<decltype(any)>, VectorXd>;
  using positive_slope = slant::slant_operator_t<std::remove_cvref_t<decltype(positive)>, VectorXd>;
  static_assert(slant::declares_self_adjoint<any_slope>);
  static_assert(!slant::declares_positive_semidefinite<any_slope>);
  static_assert(slant::declares_positive_semidefinite<positive_slope>);
  CHECK(any.factor() == positive.factor());
}

TEST_CASE("archetypes") {
  namespace archetype = slant::testing::archetype;
  auto const f = slant::scale(0.5, archetype::slanting_function(2));
  slant::testing::check_slanting_laws(f, archetype::vector(VectorXd{{1.0, -2.0}}));
}

TEST_CASE("bad input") {
  double const infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::scale(infinity, slant::positive_part(3))),
                       "c: got inf, expected a finite number", slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::scale(slant::positive(-1.0), slant::positive_part(3))),
                  slant::bad_input);
}

}  // namespace scaled_test
