// SPDX-License-Identifier: MIT
#include "newton_brick.hpp"

#include <doctest/doctest.h>

namespace symmetric_newton_brick_test {

TEST_CASE("the brick: energy error 1e-8 within 250 products, half of them with a preconditioner") {
#ifdef __OPTIMIZE__
  for (auto const load : fem::brick_loads) test::check_newton_brick(4, load, 250, 125);
#else  // With sanitizers a product takes fifty times as long; they see as much on a smaller mesh.
  test::check_newton_brick(3, fem::brick_load::lift, 250, 125);
#endif
}

}  // namespace symmetric_newton_brick_test
