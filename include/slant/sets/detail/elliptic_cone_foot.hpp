// SPDX-License-Identifier: MIT
//
// Nearest point of the elliptic cone: picks the units and the equation.
#pragma once

#include <slant/sets/detail/cone_projection.hpp>
#include <slant/sets/detail/elliptic_cone_secular.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <utility>

namespace slant::detail {

/// The region of a point, and its foot if that is on the mantle: of |x|, in units of 2^exponent.
template <class S>
struct elliptic_cone_point {
  cone_region region;
  elliptic_foot<S> foot{};
  int exponent = 0;
};

/// Nearest point for finite x and μ > 0 in any order.
template <class S>
[[nodiscard]] elliptic_cone_point<S> nearest_on_elliptic_cone(Eigen::Matrix<S, 2, 1> const& mu,
                                                              Eigen::Matrix<S, 3, 1> const& point) {
  using std::abs;
  if (point(1) == S(0) && point(2) == S(0)) {
    return {point(0) >= S(0) ? cone_region::inside : cone_region::apex};
  }
  int const e = binary_exponent(point);
  Eigen::Matrix<S, 3, 1> const v = times_power_of_two<S, 3>(point, -e);
  int const i = mu(0) < mu(1) ? 1 : 0, j = 1 - i;
  std::array<S, 2> const μ{mu(i), mu(j)}, x{S(abs(v(1 + i))), S(abs(v(1 + j)))};
  elliptic_cone_point<S> found{cone_region::mantle, {}, e};
  if (v(0) >= S(0)) {
    upper_cone_equation<S> const equation(μ, v(0), x);
    if (equation.inside()) return {cone_region::inside};
    found.foot = equation.foot(secular_root<S>(equation));
  } else {
    lower_cone_equation<S> const equation(μ, S(-v(0)), x);
    if (equation.polar()) return {cone_region::apex};
    found.foot = equation.foot(secular_root<S>(equation));
  }
  if (i == 1) {
    std::swap(found.foot.ratio(0), found.foot.ratio(1));
    std::swap(found.foot.unit(0), found.foot.unit(1));
  }
  return found;
}

}  // namespace slant::detail
