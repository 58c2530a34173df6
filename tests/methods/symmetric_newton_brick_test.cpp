// SPDX-License-Identifier: MIT
#include "newton_brick.hpp"

#include <doctest/doctest.h>
#include <support/effort.hpp>

namespace symmetric_newton_brick_test {

TEST_CASE("the brick: energy error 1e-8 within 250 products, half of them with a preconditioner") {
  for (auto const load : fem::brick_loads)
    test::check_newton_brick(test::effort(4, 2), load, 250, 125);
}

}  // namespace symmetric_newton_brick_test
