// SPDX-License-Identifier: MIT
//
// What every factorisation of a symmetric positive definite matrix checks, in the same words.
//
// Singularity. The pivot of row p is d = K_pp − Σ ℓ²d, a difference whose rounding error is a small
// multiple of ε K_pp for each term subtracted. A pivot d ≤ 4 max(n, 16) ε K_pp is thus
// indistinguishable from zero, and is refused. (Floating bricks of linear elasticity, six rigid
// motions each, are refused up to the 2·10⁴ unknowns that were tried.) The measure is the diagonal
// entry of the same row, not the largest one, so that a soft body beside a stiff one is not called
// singular.
#pragma once

#include <slant/operators/detail/matrix_entries.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slant::detail {

/// Throws bad_input unless K is square, finite and symmetric up to rounding.
template <class M>
void require_symmetric_matrix(std::string_view name, M const& k) {
  require_square(name, k);
  require_finite_entries(name, k);
  require_symmetric_entries(name, k);
}

/// Throws bad_input unless b and x have the sizes of right-hand sides and solutions.
template <class X, class Y>
void check_solve(index n, X const& b, Y const& x) {
  check_rows("b", b, n, "rows() of the factorisation");
  check_rows("x", x, n, "rows() of the factorisation");
  check_same_columns("x", x, b, "one for each column of b");
}

/// Throws bad_input unless order is a permutation of 0 … n − 1.
inline void check_permutation(std::string_view name, std::vector<int> const& order, index n) {
  check_size(name, static_cast<index>(order.size()), n, "one entry for each row of K,");
  std::vector<bool> seen(order.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] < 0 || order[i] >= n || seen[static_cast<std::size_t>(order[i])]) {
      throw bad_input(name, show(order[i]), "each of 0, …, rows − 1 once")
          .at(static_cast<index>(i));
    }
    seen[static_cast<std::size_t>(order[i])] = true;
  }
}

/// The smallest pivot of a row with that diagonal entry that can be told from zero.
template <class S>
[[nodiscard]] S smallest_pivot(index n, S const& diagonal) {
  return S(4) * S(std::max<index>(n, 16)) * std::numeric_limits<S>::epsilon() * diagonal;
}

/// Throws bad_input that names the pivot: its position in the elimination, its row, its value.
template <class S>
[[noreturn]] void refuse_pivot(std::string_view name, index pivot, index row, S const& value,
                               bool singular) {
  std::string text("pivot ");
  text.append(show(pivot)).append(" (row ").append(show(row)).append(") = ").append(show(value));
  if (singular) text.append(", zero up to rounding");
  throw bad_input(name, text, "a symmetric positive definite matrix");
}

/// Throws unless pivot number k, of the given row, belongs to a positive definite matrix. Values
/// are those of K / 2^e; the message shows them in the units of K.
template <class S>
void require_positive_pivot(std::string_view name, index n, index k, index row, S const& pivot,
                            S const& diagonal, int e) {
  using std::ldexp;
  S const least = smallest_pivot(n, diagonal);
  if (pivot > least) return;
  refuse_pivot(name, k, row, S(ldexp(pivot, e)), diagonal >= S(0) && pivot >= -least);
}

}  // namespace slant::detail
