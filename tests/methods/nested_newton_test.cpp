// SPDX-License-Identifier: MIT
#include "nested_newton.hpp"

namespace nested_newton_test {

TEST_CASE("nested Newton on the wire: at most 6 steps on every mesh up to n = 256") {
  test::check_nested_newton(4);
}

}  // namespace nested_newton_test
