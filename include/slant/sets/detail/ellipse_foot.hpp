// SPDX-License-Identifier: MIT
//
// Nearest point of an ellipse for axes and points of any size: picks the units and leaves the root
// of the secular equation only the cases that are neither very far out nor thinner than the
// exponent range.
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/ellipse_secular.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <cmath>
#include <limits>

namespace slant::detail {

/// Foot of a point so far out that a is negligible against bτ (and b against aτ): then (X, Y) has
/// the direction of (ax, by). Lengths of any size; a b τ comes in units of 4^e, e =
/// binary_exponent(a).
template <class S>
[[nodiscard]] ellipse_foot<S> far_ellipse_foot(S const& a, S const& b, S const& x, S const& y,
                                               int e) {
  using word = double_word<S>;
  int const x_exponent = binary_exponent(x), y_exponent = binary_exponent(y);
  int const b_exponent = binary_exponent(b);
  S const as = times_power_of_two<S>(a, -e), bs = times_power_of_two<S>(b, -b_exponent);
  auto const u = exact_product<S>(as, times_power_of_two<S>(x, -x_exponent));
  auto const v = exact_product<S>(bs, times_power_of_two<S>(y, -y_exponent));
  int u_exponent = e + x_exponent, v_exponent = b_exponent + y_exponent;
  if (x == S(0)) u_exponent = v_exponent;
  if (y == S(0)) v_exponent = u_exponent;
  int const f = u_exponent < v_exponent ? v_exponent : u_exponent;
  u_exponent -= f;
  v_exponent -= f;
  auto const us = times_power_of_two(u, u_exponent), vs = times_power_of_two(v, v_exponent);
  auto const n = square_root(us * us + vs * vs);
  return {false,
          times_power_of_two<S>((word(as) * (u / n)).hi, e + u_exponent),
          times_power_of_two<S>((word(bs) * (v / n)).hi, b_exponent + v_exponent),
          (us / n).hi,
          (vs / n).hi,
          times_power_of_two<S>(n.hi, f - 2 * e)};
}

/// Foot on an ellipse so thin that b is not a normal number in units of a: that of the long axis,
/// lifted to the boundary. Lengths of any size; a b τ comes in units of 4^e.
template <class S>
[[nodiscard]] ellipse_foot<S> thin_ellipse_foot(S const& a, S const& b, S const& x, S const& y,
                                                int e) {
  using std::sqrt;
  S const X = x < a ? S(x / a) : S(1);
  S const Y = sqrt((S(1) - X) * (S(1) + X));
  if (x <= a && y <= b * Y) return {true, x, y};
  S const ab_tau = times_power_of_two<S>(b, -e) * (times_power_of_two<S>(y, -e) / Y);
  return {false, x < a ? x : a, y < b * Y ? y : S(b * Y), X, Y, Y > S(0) ? ab_tau : infinity<S>()};
}

/// Foot of (x, y) in the first quadrant for 0 < b <= a, all finite. `e` is binary_exponent(a); a b
/// τ comes in units of 4^e, everything else in the units of the data.
template <class S>
[[nodiscard]] ellipse_foot<S> nearest_on_ellipse(S const& a, S const& b, S const& x, S const& y,
                                                 int e) {
  S const as = times_power_of_two<S>(a, -e), bs = times_power_of_two<S>(b, -e);
  S const xs = times_power_of_two<S>(x, -e), ys = times_power_of_two<S>(y, -e);
  S const ε = std::numeric_limits<S>::epsilon();
  if (bs < (std::numeric_limits<S>::min)() / ε) return thin_ellipse_foot<S>(a, b, x, y, e);
  if (xs >= S(16) / ε || bs * ys >= S(16) / ε) {  // then a/(bτ) is below ε/8
    return far_ellipse_foot<S>(a, b, x, y, e);
  }
  ellipse_secular_equation<S> const secular(as, bs, xs, ys);
  if (secular.inside()) return {true, x, y};
  auto foot = secular.foot();
  // A component that is no normal number in these units has had no influence on τ.
  S const least = (std::numeric_limits<S>::min)() / ε;
  foot.x = foot.x < least ? S(x * foot.x_ratio) : times_power_of_two<S>(foot.x, e);
  foot.y = foot.y < least ? S(y * foot.y_ratio) : times_power_of_two<S>(foot.y, e);
  return foot;
}

}  // namespace slant::detail
