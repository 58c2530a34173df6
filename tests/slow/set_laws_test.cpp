// SPDX-License-Identifier: MIT
//
// The laws of convex sets under many seeds: no honest set may be accused, in single precision
// neither.
#include <slant/sets/sets.hpp>
#include <slant/testing/set_breaches.hpp>

#include <support/testing.hpp>

namespace set_laws_test {

/// The first breach under any of the seeds.
template <class C>
std::string accusation(C const& set, double size = 1) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    for (auto const& breach : slant::testing::set_breaches(
             set, slant::testing::set_options{.seed = seed, .size = size})) {
      return "seed " + std::to_string(seed) + ": " + breach.law + ", " + breach.evidence;
    }
  }
  return "";
}

TEST_CASE_TEMPLATE("set laws: no honest set is accused", S, float, double) {
  using vector = Eigen::Matrix<S, 2, 1>;
  Eigen::Matrix<S, 2, 2> q;
  q << S(3) / S(5), S(-4) / S(5), S(4) / S(5), S(3) / S(5);
  CHECK(accusation(slant::half_line<S>{S(-1.5)}) == "");
  CHECK(accusation(slant::interval<S>{S(0.5), S(2)}) == "");
  CHECK(accusation(slant::ball<2, S>{}) == "");
  CHECK(accusation(slant::ball<2, S>{S(1e-7)}, 1e-7) == "");
  CHECK(accusation(slant::ball<3, S>{S(2)}) == "");
  CHECK(accusation(slant::ellipse<S>{S(2), S(1)}) == "");
  CHECK(accusation(slant::ellipse<S>{S(2), S(0.1)}) == "");
  CHECK(accusation(slant::second_order_cone<2, S>{S(2)}) == "");
  CHECK(accusation(slant::second_order_cone<3, S>{S(0.3)}) == "");
  CHECK(accusation(slant::second_order_cone<3, S>{S(0)}) == "");
  CHECK(accusation(slant::second_order_cone<4, S>{S(1)}) == "");
  CHECK(accusation(slant::shifted(slant::ball<2, S>{}, vector(S(3), S(-4)))) == "");
  CHECK(accusation(slant::shifted(slant::second_order_cone<2, S>{S(0.5)}, vector(S(-1), S(2)))) ==
        "");
  CHECK(accusation(slant::scaled(S(2.5), slant::ellipse<S>{S(1), S(0.2)})) == "");
  CHECK(accusation(slant::rotated(slant::ellipse<S>{S(1), S(0.2)}, q)) == "");
  CHECK(accusation(slant::rotated(slant::second_order_cone<2, S>{S(0.5)}, q)) == "");
  std::vector<S> const g{S(1), S(0.3), S(0)};
  CHECK(accusation(slant::cartesian(slant::half_lines<S>(2), slant::discs<slant::planar>(g),
                                    slant::free_components<S>(1))) == "");
}

}  // namespace set_laws_test
