// SPDX-License-Identifier: MIT
#include <slant/multilevel/multigrid.hpp>
#include <support/testing.hpp>

namespace multigrid_options_test {

using options = slant::multigrid_options;

TEST_CASE("options out of range are named") {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_NOTHROW(options{}.validate());
  for (double const θ : {-0.1, 1.0, nan}) {
    CHECK_THROWS_AS(options{.strength = θ}.validate(), slant::bad_input);
  }
  for (double const ω : {0.0, 2.0, nan}) {
    CHECK_THROWS_AS(options{.damping = ω}.validate(), slant::bad_input);
  }
  CHECK_THROWS_WITH_AS(options{.sweeps = 0}.validate(), "sweeps: got 0, expected at least 1",
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(options{.coarsest = 0}.validate(), "coarsest: got 0, expected at least 1",
                       slant::bad_input);
  CHECK_THROWS_WITH_AS(options{.levels = 0}.validate(), "levels: got 0, expected at least 1",
                       slant::bad_input);
  for (slant::index const b : {-1, 4}) {
    CHECK_THROWS_AS(options{.block_size = b}.validate(), slant::bad_input);
  }
  CHECK_THROWS_WITH_AS(options{.block_size = -1}.validate(),
                       "block_size: got -1, expected a number from 0 to 3", slant::bad_input);
  for (double const c : {1.0, nan}) {
    CHECK_THROWS_AS(options{.complexity = c}.validate(), slant::bad_input);
  }
  CHECK_THROWS_WITH_AS(options{.coordinates = MatrixXd::Zero(4, 2)}.validate(),
                       "rows of coordinates: got 4, expected 2 or 3", slant::bad_input);
  CHECK_THROWS_AS(options{.coordinates = MatrixXd::Constant(3, 2, nan)}.validate(),
                  slant::bad_input);
}

}  // namespace multigrid_options_test
