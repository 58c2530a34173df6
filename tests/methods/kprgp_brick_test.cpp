// SPDX-License-Identifier: MIT
#include "brick_accuracy.hpp"

#include <doctest/doctest.h>

namespace kprgp_brick_test {

TEST_CASE("KPRGP on a brick: energy error at most 1e-6") {
#ifdef __OPTIMIZE__
  for (auto const load : fem::brick_loads) test::check_brick_accuracy(4, load);
#else  // With sanitizers a product takes fifty times as long; they see as much on a smaller mesh.
  test::check_brick_accuracy(3, fem::brick_load::lift);
#endif
}

}  // namespace kprgp_brick_test
