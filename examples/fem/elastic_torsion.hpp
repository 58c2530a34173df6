// SPDX-License-Identifier: MIT
//
// Elastic–plastic torsion of a bar with a square cross-section (Moré and Toraldo, 1991; problem
// DEPT of MINPACK-2; Glowinski, Numerical Methods for Nonlinear Variational Problems, 1984):
//
//     min ½ ∫ |∇v|² − c ∫ v,    |v| ≤ dist(·, edges),    on (0, 1)²,
//
// v the stress potential, c the angle of twist per length. Where v is on a bound, the material is
// plastic; from c = 5 over 10 to 20 this zone grows and the problem becomes easier.
#pragma once

#include <algorithm>
#include <type_traits>

#include <fem/membrane.hpp>

namespace fem {

/// The problem with nx × ny interior nodes; TORSION1 (c = 5), TORSION3 (10), TORSION5 (20) in
/// CUTEst. Throws std::invalid_argument for a grid without nodes.
template <class S = double>
[[nodiscard]] membrane<S> make_elastic_torsion(Eigen::Index nx, Eigen::Index ny,
                                               std::type_identity_t<S> const& c = S(5)) {
  rectangle_grid<S> const grid{.nx = nx, .ny = ny};
  auto const distance = [](S const& x, S const& y) {
    return std::min(std::min<S>(x, S(1) - x), std::min<S>(y, S(1) - y));
  };
  return make_membrane(
      grid, [](S const&) { return S(1); }, constant(c),
      [&](S const& x, S const& y) { return S(-distance(x, y)); }, distance);
}

}  // namespace fem
