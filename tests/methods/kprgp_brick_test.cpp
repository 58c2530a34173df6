// SPDX-License-Identifier: MIT
#include "brick_accuracy.hpp"

#include <doctest/doctest.h>
#include <support/effort.hpp>

namespace kprgp_brick_test {

TEST_CASE("KPRGP on a brick: energy error at most 1e-6") {
  for (auto const load : fem::brick_loads) test::check_brick_accuracy(test::effort(4, 2), load);
}

}  // namespace kprgp_brick_test
