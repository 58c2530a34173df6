// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "brick_accuracy.hpp"

namespace kprgp_brick_test {

TEST_CASE("KPRGP on larger bricks: energy error at most 1e-6 under every load") {
  for (int const k : {4, 6, 8}) {
    for (auto const load : fem::brick_loads) test::check_brick_accuracy(k, load);
  }
}

}  // namespace kprgp_brick_test
