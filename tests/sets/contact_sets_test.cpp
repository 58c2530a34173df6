// SPDX-License-Identifier: MIT
#include <slant/sets/contact_sets.hpp>

#include <support/testing.hpp>
#include "counting_disc.hpp"
#include "oracle/precise.hpp"

namespace contact_sets_test {

using namespace products;

TEST_CASE_TEMPLATE("contact_sets: the scalar is that of the data", S, float, oracle::float_50) {
  vec<S> const g = vec<S>::Constant(3, S(2));
  vec<S> const x = vec<S>::Constant(3, S(-9));
  CHECK(slant::project(slant::half_lines<S>(3), x) == vec<S>::Zero(3));
  CHECK(slant::project(slant::half_lines(g), x) == g);
  CHECK(slant::project(slant::intervals(g), x) == vec<S>(-g));
  CHECK(slant::project(slant::intervals(vec<S>(-g), g), x) == vec<S>(-g));
  CHECK(slant::project(slant::free_components<S>(3), x) == x);
  static_assert(std::is_same_v<typename decltype(slant::discs(g))::scalar, S>);
}

TEST_CASE("contact_sets: bad data is named") {
  vec<> const g = Vector2d(1, -2);
  CHECK(SLANT_COMPLAINT(slant::discs(g)) == "radius[1]: got -2, expected a number >= 0");
  CHECK(SLANT_COMPLAINT(slant::intervals(g)) == "radius[1]: got -2, expected a number >= 0");
  CHECK(SLANT_COMPLAINT(slant::intervals(g, vec<>(-g))) ==
        "l[0]: got 1, expected a number <= u = -1");
}

}  // namespace contact_sets_test
