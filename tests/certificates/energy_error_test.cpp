// SPDX-License-Identifier: MIT
#include <slant/certificates/energy_error.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace energy_error_test {

TEST_CASE("relative errors: of a solution that is zero, of one about which nothing is known") {
  CHECK(slant::energy_error<double>{.bound = 0, .size = 0}.relative() == 0);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3, .proven = true}.relative() == 0.5);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3}.relative() == 1);
  CHECK(std::isinf(slant::energy_error<double>{.bound = 2, .size = 1}.relative()));
  // An estimate just below the size at a point 1e13 solutions away: nothing is known.
  CHECK(std::isinf(slant::energy_error<double>{.bound = 1 - 1e-6, .size = 1}.relative()));
  CHECK(std::isinf(slant::energy_error<double>{}.relative()));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(slant::error_bound(nan, 0.0)));
  CHECK(std::isnan(slant::error_bound(0.0, nan)));
  CHECK(slant::error_bound(0.0, 0.0) == 0);
  CHECK(slant::error_bound(2.0, 0.0) == doctest::Approx(2));
  CHECK(slant::error_bound(0.0, 4.0) == doctest::Approx(2));
  CHECK(slant::error_bound(1e-200, 1e-300) >= 1e-150);
  CHECK(slant::error_bound(1e200, 1e300) >= 1e200);
}

}  // namespace energy_error_test
