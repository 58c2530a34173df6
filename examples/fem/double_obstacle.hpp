// SPDX-License-Identifier: MIT
//
// A membrane between two obstacles (Dembo and Tulowitzki, 1983; problem B of the obstacle problems
// of Moré and Toraldo, 1991):
//
//     min ½ ∫ |∇v|² − ∫ v,    s³ ≤ v ≤ s² + 0.02,    s = sin(9.2 x) sin(9.3 y),    on (0, 1)².
//
// The gap s²(1 − s) + 0.02 is narrow where s is near 0 or 1; a quarter of the nodes end on a bound.
#pragma once

#include <cmath>

#include <fem/membrane.hpp>

namespace fem {

/// The problem with nx × ny interior nodes; OBSTCLBL, OBSTCLBM and OBSTCLBU in CUTEst. Throws
/// std::invalid_argument for a grid without nodes.
template <class S = double>
[[nodiscard]] membrane<S> make_double_obstacle(Eigen::Index nx, Eigen::Index ny) {
  using std::sin;
  rectangle_grid<S> const grid{.nx = nx, .ny = ny};
  auto const s = [](S const& x, S const& y) {
    return S(sin(S(46) / S(5) * x) * sin(S(93) / S(10) * y));
  };
  return make_membrane(
      grid, [](S const&) { return S(1); }, constant(S(1)),
      [s](S const& x, S const& y) {
        S const value = s(x, y);
        return S(value * value * value);
      },
      [s](S const& x, S const& y) {
        S const value = s(x, y);
        return S(value * value + S(1) / S(50));
      });
}

}  // namespace fem
