// SPDX-License-Identifier: MIT
#include <slant/sets/ball.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace set_laws_test {

namespace archetype = slant::testing::archetype;
using slant::testing::check_set_laws;

/// A client's own set, of which the library knows nothing: x + y <= 1.
struct half_plane {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const {
    double const excess = x[0] + x[1] - 1;
    return excess > 0 ? Vector2d(x[0] - excess / 2, x[1] - excess / 2) : Vector2d(x);
  }
  bool contains(auto const& x) const { return x[0] + x[1] <= 1 + 1e-15; }
};

TEST_CASE("set_laws: a set with a projection only") {
  check_set_laws(half_plane{}, slant::testing::set_options{.points = 200});
}

TEST_CASE("set_laws: archetypes keep the laws") {
  archetype::vector const prototype(VectorXd::Zero(3));
  check_set_laws(archetype::convex_set(3), prototype);
  check_set_laws(archetype::separable_set(3), prototype,
                 slant::testing::set_options{.seed = 2, .points = 20});
}

TEST_CASE("set_laws: a broken law makes the test fail, with its name" * doctest::should_fail()) {
  struct without_bound : half_plane {
    bool contains(Vector2d const&) const { return true; }
  };
  check_set_laws(without_bound{});
}

}  // namespace set_laws_test
