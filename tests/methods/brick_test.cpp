// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>

#include <support/testing.hpp>
#include "brick_runs.hpp"

namespace brick_test {

TEST_CASE("symmetric_newton: error 1e-8 within 250 products, half of them with a preconditioner") {
  for (auto const load : fem::brick_loads)
    test::check_newton_brick(test::effort(4, 2), load, 250, 125);
}

TEST_CASE("interior_point: error 1e-6 in 30 steps and 300 products") {
  for (auto const load : fem::brick_loads) {
    for (int k = 2; k <= test::effort(4, 2); ++k) {
      test::check_brick(
          k, load, {1e-6, 300, 1e-7, 30}, [](auto const&, auto const& dual, auto const& watch) {
            auto const qp = dual.qp();
            return slant::solve(slant::interior_point{qp}, dual.zero(),
                                slant::reduced_gradient_below(1e-9) || slant::at_most(60), watch);
          });
    }
  }
}

}  // namespace brick_test
