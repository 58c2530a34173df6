// SPDX-License-Identifier: MIT
//
// A membrane over an obstacle (Dembo and Tulowitzki, 1983; problem A of the obstacle problems of
// Moré and Toraldo, 1991):
//
//     min ½ ∫ |∇v|² − ∫ v,    v ≥ sin(3.2 x) sin(3.3 y),    on (0, 1)².
//
// The obstacle is below zero near the far edges, where the membrane is fixed.
#pragma once

#include <cmath>

#include <fem/membrane.hpp>

namespace fem {

/// The problem with nx × ny interior nodes; OBSTCLAE and OBSTCLAL in CUTEst, without their upper
/// bound of 2000, which nothing reaches. Throws std::invalid_argument for a grid without nodes.
template <class S = double>
[[nodiscard]] membrane<S> make_lower_obstacle(Eigen::Index nx, Eigen::Index ny) {
  using std::sin;
  rectangle_grid<S> const grid{.nx = nx, .ny = ny};
  return make_membrane(
      grid, [](S const&) { return S(1); }, constant(S(1)),
      [](S const& x, S const& y) { return S(sin(S(16) / S(5) * x) * sin(S(33) / S(10) * y)); },
      no_upper_bound<S>());
}

}  // namespace fem
