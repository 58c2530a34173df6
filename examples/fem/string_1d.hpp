// SPDX-License-Identifier: MIT
//
// The wire [T §4.1, K Ex 2]: an elastic string that hangs over a plane and enters a tube,
//
//   min ½ ∫ ‖y'‖² − ∫ yᵀf,   y = (y₁, y₂),  y(0) = y(1) = 0,
//       y₂ ≥ l on (0, ½),    ‖y‖ ≤ g on (½, 1),    f = (36π² sin 6πt, −4π² sin 2πt),
//
// on 2m interior nodes tᵢ = i h, h = 1/(2m+1), with linear elements and the load h f(tᵢ). The first
// m nodes carry the bound, the last m nodes the disc.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>

#include <fem/require.hpp>

namespace fem {

/// Separable quadratic problem min ½xᵀA x − bᵀx of the wire. The 4m unknowns are ordered so that
/// the feasible set is  power(half_line l, m) × power(disc g, m) × free(m):
///
///   x = ( y₂(t₁) … y₂(t_m),                                m bounded unknowns, y₂ ≥ l
///         y₁(t_{m+1}), y₂(t_{m+1}), …, y₁(t_2m), y₂(t_2m),  m consecutive pairs, ‖(y₁,y₂)‖ ≤ g
///         y₁(t₁) … y₁(t_m) )                                m free unknowns
///
/// which is the order (x₁, x₂, x₃, x₄) of [T (4.1)] with the two halves of the pairs interleaved.
template <class S = double>
struct wire {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  Eigen::SparseMatrix<S> A;  ///< 4m × 4m, symmetric positive definite
  vector b;                  ///< 4m
  Eigen::Index m = 0;        ///< bounds, discs and free unknowns: m of each

  /// Mesh width.
  [[nodiscard]] S h() const { return S(1) / S(static_cast<int>(2 * m + 1)); }
  /// Position of interior node 0 ≤ node < 2m.
  [[nodiscard]] S t(Eigen::Index node) const { return S(static_cast<int>(node + 1)) * h(); }
  /// Unknown that holds component 0 (y₁) or 1 (y₂) at interior node 0 ≤ node < 2m.
  [[nodiscard]] Eigen::Index unknown(Eigen::Index node, int component) const {
    if (node < m) return component == 1 ? node : 3 * m + node;
    return m + 2 * (node - m) + component;
  }
  /// y₁ and y₂ (columns) at the 2m interior nodes (rows).
  [[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 2> shape(vector const& x) const {
    Eigen::Matrix<S, Eigen::Dynamic, 2> y(2 * m, 2);
    for (Eigen::Index node = 0; node < 2 * m; ++node)
      for (int component = 0; component < 2; ++component)
        y(node, component) = x[unknown(node, component)];
    return y;
  }
};

/// Assembles the wire with 4m unknowns: for each component the matrix tridiag(−1, 2, −1)/h.
/// Throws std::invalid_argument for m < 1.
template <class S = double>
[[nodiscard]] wire<S> make_wire(Eigen::Index m) {
  using std::acos;
  using std::sin;
  require(m >= 1 && m <= (1 << 28), "m", m, "between 1 and 2^28 bounds");
  wire<S> w;
  w.m = m;
  w.b.resize(4 * m);
  w.A.resize(4 * m, 4 * m);
  w.A.reserve(Eigen::Matrix<int, Eigen::Dynamic, 1>::Constant(4 * m, 3));
  S const π = acos(S(-1));
  S const stiffness = S(1) / w.h();
  for (Eigen::Index node = 0; node < 2 * m; ++node) {
    w.b[w.unknown(node, 0)] = w.h() * S(36) * π * π * sin(S(6) * π * w.t(node));
    w.b[w.unknown(node, 1)] = -(w.h() * S(4) * π * π * sin(S(2) * π * w.t(node)));
    for (int component = 0; component < 2; ++component) {
      Eigen::Index const here = w.unknown(node, component);
      w.A.insert(here, here) = S(2) * stiffness;
      if (node + 1 == 2 * m) continue;
      Eigen::Index const next = w.unknown(node + 1, component);
      w.A.insert(here, next) = -stiffness;
      w.A.insert(next, here) = -stiffness;
    }
  }
  w.A.makeCompressed();
  return w;
}

}  // namespace fem
