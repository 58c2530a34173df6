// SPDX-License-Identifier: MIT
#include <slant/slanting/affine.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace identity_test {

TEST_CASE("the identity") {
  slant::identity_map const f(3);
  VectorXd const y{{1.0, -2.0, 3.0}};
  CHECK(slant::evaluate(f, y) == y);
  CHECK(slanting_support::dense_slant(f, y).isIdentity(0));
  static_assert(
      slant::declares_positive_definite<slant::slant_operator_t<slant::identity_map, VectorXd>>);
  static_assert(slant::has_slant_update<slant::identity_map, VectorXd>);
  slant::testing::check_slanting_laws(f, y, slant::testing::archetype::vector(y));
  CHECK_THROWS_WITH_AS(slant::identity_map(-1), "n: got -1, expected a size >= 0",
                       slant::bad_input);
}

}  // namespace identity_test
