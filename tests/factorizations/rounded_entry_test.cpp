// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace rounded_entry_test {

using slant::detail::rounded_entry;

TEST_CASE("rounded as a cast does it; what floats cannot hold is their largest number or zero") {
  CHECK(rounded_entry<float>(0.1) == 0.1f);
  CHECK(rounded_entry<float>(-1e-20) == -1e-20f);
  CHECK(rounded_entry<float>(1e300) == std::numeric_limits<float>::max());
  CHECK(rounded_entry<float>(-1e300) == -std::numeric_limits<float>::max());
  CHECK(rounded_entry<float>(1e-43) == 0);
  CHECK(rounded_entry<float>(-1e-43) == 0);
  CHECK(rounded_entry<float>(0.0) == 0);
  CHECK(rounded_entry<double>(0.1) == 0.1);
}

}  // namespace rounded_entry_test
