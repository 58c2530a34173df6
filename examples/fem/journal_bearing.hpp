// SPDX-License-Identifier: MIT
//
// Pressure in a journal bearing (Moré and Toraldo, 1991; problem DPJB of MINPACK-2; the tutorial
// jbearing2.c of PETSc/TAO):
//
//     min ½ ∫ w_q |∇v|² − ∫ w_l v,   v ≥ 0,   on (0, 2π) × (0, 2b),
//
//     w_q(x, y) = (1 + ε cos x)³,    w_l(x, y) = ε sin x,
//
// ε the eccentricity. Where v = 0, the film of the lubricant cavitates.
#pragma once

#include <cmath>

#include <fem/membrane.hpp>

namespace fem {

/// Shape of the bearing; the defaults are those of jbearing2.c.
template <class S = double>
struct journal_bearing_data {
  S eccentricity = S(1) / S(10);  ///< ε in (0, 1)
  S b = S(10);                    ///< half of its length, > 0
};

/// The problem with nx × ny interior nodes (-mx, -my of jbearing2.c); JNLBRNG1 (ε = 0.1, b = 10) in
/// CUTEst. Throws std::invalid_argument for a grid without nodes or data out of range.
template <class S = double>
[[nodiscard]] membrane<S> make_journal_bearing(Eigen::Index nx, Eigen::Index ny,
                                               journal_bearing_data<S> const& data = {}) {
  using std::acos;
  using std::cos;
  using std::isfinite;
  using std::sin;
  S const ε = data.eccentricity;
  require(ε > S(0) && ε < S(1), "eccentricity", ε, "a number in (0, 1)");
  require(data.b > S(0) && isfinite(data.b), "b", data.b, "a number > 0");
  rectangle_grid<S> const grid{
      .nx = nx, .ny = ny, .width = S(2) * acos(S(-1)), .height = S(2) * data.b};
  return make_membrane(
      grid,
      [ε](S const& x) {
        S const gap = S(1) + ε * cos(x);
        return S(gap * gap * gap);
      },
      [ε](S const& x, S const&) { return S(ε * sin(x)); }, constant(S(0)), no_upper_bound<S>());
}

}  // namespace fem
