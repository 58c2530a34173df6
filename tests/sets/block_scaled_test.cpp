// SPDX-License-Identifier: MIT
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/scaled.hpp>
#include <slant/testing/set_laws.hpp>

#include <doctest/doctest.h>

#include <support/allocation_guard.hpp>

namespace block_scaled_test {

using Eigen::VectorXd;

/// Two half lines, a disc at the components 2 and 3, a free unknown; and each blown up by d by
/// hand.
auto plain() {
  return slant::cartesian(slant::half_lines(VectorXd{{0.5, -1.0}}), slant::discs(VectorXd{{2.0}}),
                          slant::free_components(1));
}
auto twin() {
  return slant::cartesian(slant::half_lines(VectorXd{{1.0, -3.0}}), slant::discs(VectorXd{{0.5}}),
                          slant::free_components(1));
}
VectorXd const d{{2.0, 3.0, 0.25, 0.25, 7.0}};

TEST_CASE("block_scaled: every block has its own factor") {
  auto const set = slant::block_scaled(d, plain());
  auto const other = twin();
  CHECK(slant::dimension_of(set) == 5);
  CHECK(slant::block_count(set) == slant::block_count(other));
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::srand(seed);
    VectorXd const x = 3 * VectorXd::Random(5);
    VectorXd y(5), expected(5);
    slant::project(set, x, y);
    slant::project(other, x, expected);
    CHECK((y - expected).cwiseAbs().maxCoeff() <= 1e-15);
    CHECK(set.contains(y));
    CHECK(set.contains(x) == other.contains(x));
    VectorXd const v = VectorXd::Random(5);
    CHECK(set.step_to_boundary(y, v) == doctest::Approx(other.step_to_boundary(y, v)));
  }
}

TEST_CASE("block_scaled: the laws of sets") {
  auto const set = slant::block_scaled(d, plain());
  slant::testing::check_set_laws(set, VectorXd(5));
}

TEST_CASE("block_scaled: no allocation") {
  auto const set = slant::block_scaled(d, plain());
  VectorXd const x = VectorXd::Constant(5, -4.0);
  VectorXd y(5);
  slant::testing::allocation_guard const guard;
  slant::project(set, x, y);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("block_scaled: factors are checked") {
  CHECK_THROWS_WITH(static_cast<void>(slant::block_scaled(VectorXd{{1.0}}, plain())),
                    "d: got 1, expected the dimension of the set, 5");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 0.0, 1.0, 1.0, 1.0}}, plain())),
      "d(1): got 0, expected a finite number > 0");
  CHECK_THROWS_WITH(
      static_cast<void>(slant::block_scaled(VectorXd{{1.0, 1.0, 1.0, 2.0, 1.0}}, plain())),
      "d(3): got 2, expected 1 as for the other unknowns of its block");
}

}  // namespace block_scaled_test
