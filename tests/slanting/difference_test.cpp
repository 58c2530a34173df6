// SPDX-License-Identifier: MIT
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace difference_test {

TEST_CASE("y - max(0, y) = min(0, y)") {
  auto const f = slant::subtract(slant::identity_map(3), slant::positive_part(3));
  VectorXd const y{{1.0, -2.0, 0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{0.0, -2.0, 0.0}});
  MatrixXd const expected = Vector3d(0, 1, 0).asDiagonal();
  CHECK(slanting_support::dense_slant(f, y) == expected);
  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, VectorXd>;
  static_assert(slant::declares_self_adjoint<slope>);
  static_assert(!slant::declares_positive_semidefinite<slope>);  // of a difference nobody knows
  slant::testing::check_slanting_laws(f, y);
}

TEST_CASE("order matters, archetypes") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const g = slant::subtract(f, slant::identity_map(2));
  VectorXd const y{{1.0, -2.0}};
  CHECK(slant::evaluate(g, archetype::vector(y)).local() == VectorXd{{0.5, 3.0}});
  slant::testing::check_slanting_laws(g, archetype::vector(y));
}

TEST_CASE("bad input") {
  MatrixXd const wide = MatrixXd::Ones(3, 4);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::subtract(slant::identity_map(3), slant::linear(wide))),
      "g.cols(): got 4, expected 3 (f.cols())", slant::bad_input);
}

}  // namespace difference_test
