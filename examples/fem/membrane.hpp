// SPDX-License-Identifier: MIT
//
// Obstacle problems on a rectangle, as Moré and Toraldo pose them (SIAM J. Optimization 1, 1991,
// 93–113, "On the solution of large quadratic programming problems with bound constraints"):
//
//     min  ½ ∫ w |∇v|² − ∫ f v,    l ≤ v ≤ u,    v = 0 on the edges,
//
// with linear elements on triangles. Each problem is a header of its own: elastic_torsion.hpp,
// journal_bearing.hpp, lower_obstacle.hpp, double_obstacle.hpp.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>

#include <fem/five_point.hpp>

namespace fem {

/// min ½ vᵀA v − bᵀv over lower ≤ v ≤ upper.
template <class S = double>
struct membrane {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  rectangle_grid<S> grid;
  five_point<S> A;
  vector b;      ///< hx hy f at the nodes
  vector lower;  ///< −∞ where there is no bound
  vector upper;  ///< +∞ where there is no bound
};

/// The membrane with weight w(x), load f(x, y) and bounds l(x, y), u(x, y). Throws
/// std::invalid_argument for a grid without nodes or a weight that is not positive.
template <class S, class Weight, class Load, class Lower, class Upper>
[[nodiscard]] membrane<S> make_membrane(rectangle_grid<S> const& grid, Weight const& w,
                                        Load const& f, Lower const& l, Upper const& u) {
  five_point<S> A(grid, w);
  return {grid, std::move(A), at_nodes(grid, f) * (grid.hx() * grid.hy()), at_nodes(grid, l),
          at_nodes(grid, u)};
}

/// A function of (x, y) that is constant.
template <class S>
[[nodiscard]] auto constant(S const& value) {
  return [value](S const&, S const&) { return value; };
}
/// A bound that is none, above.
template <class S>
[[nodiscard]] auto no_upper_bound() {
  return constant(std::numeric_limits<S>::infinity());
}

}  // namespace fem
