// SPDX-License-Identifier: MIT
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace scaled_test {

TEST_CASE("values and slanting operators are multiplied") {
  auto const f = slant::scale(slant::any_sign(-2.5), slant::positive_part(3));
  VectorXd const y{{1.0, -2.0, 0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{-2.5, 0.0, 0.0}});
  MatrixXd const expected = Vector3d(-2.5, 0, -2.5).asDiagonal();
  CHECK(slanting_support::dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y);
  CHECK(slant::evaluate(slant::scale(2, slant::positive_part(3)), y)[0] == 2);
}

TEST_CASE("a number keeps definiteness, one of any sign and a minus do not") {
  auto const p = slant::positive_part(3);
  auto const slope = [](auto const& f) { return f.slant(test::zeros(3)); };
  auto const plain = slope(2.0 * p);
  auto const any = slope(slant::any_sign(2.0) * p);
  auto const minus = slope(-p);
  static_assert(slant::declares_positive_semidefinite<decltype(plain)>);
  static_assert(slant::declares_self_adjoint<decltype(any)>);
  static_assert(!slant::declares_positive_semidefinite<decltype(any)>);
  static_assert(slant::declares_self_adjoint<decltype(minus)>);
  static_assert(!slant::declares_positive_semidefinite<decltype(minus)>);
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
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::scale(0, slant::positive_part(3))),
                       "c: got 0, expected a number > 0 in front of a function; for others write "
                       "-(c * f) or any_sign(c) * f",
                       slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::scale(slant::positive(-1.0), slant::positive_part(3))),
                  slant::bad_input);
}

}  // namespace scaled_test
