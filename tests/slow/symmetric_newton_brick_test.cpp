// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <methods/newton_brick.hpp>

namespace symmetric_newton_brick_test {

TEST_CASE("larger bricks: energy error 1e-8 within 250 products under every load") {
  for (int const k : {6, 8}) {
    for (auto const load : fem::brick_loads) test::check_newton_brick(k, load, 250, 160);
  }
}

}  // namespace symmetric_newton_brick_test
