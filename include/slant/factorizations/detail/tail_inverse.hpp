// SPDX-License-Identifier: MIT
//
// Part of (L_tt L_ttᵀ)⁻¹ formed: the rows and columns of some of its unknowns. A product with it
// reads n²/2 entries once, where the sweeps read those of L_tt twice, and pays for the forming
// after some hundred products.
//
// Each column is a solve with a unit vector e_j, and only what stands from j on in it is needed:
// the panels before take no part in either sweep, which leaves a third of the work.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/packed_symmetric.hpp>
#include <slant/factorizations/detail/tail_solve.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace slant::detail {

/// Rows and columns `unknowns` (numbers of columns of L_tt, ascending) of the inverse, with the
/// entries of L_tt in `storage`.
template <class Storage>
[[nodiscard]] std::shared_ptr<packed_symmetric<double> const> tail_inverse(
    Storage const& storage, std::vector<int> const& unknowns) {
  constexpr index together = 32;  // a panel is read once for so many columns
  auto const n = static_cast<index>(unknowns.size());
  auto const unknown = [&](index i) { return index(unknowns[static_cast<std::size_t>(i)]); };
  auto result = std::make_shared<packed_symmetric<double>>(n);
  tail_vectors<double> v(storage.shape(), together);
  for (index first = 0; first < n; first += together) {
    index const end = std::min(first + together, n);
    v.x.setZero();
    for (index j = first; j < end; ++j) v.x(unknown(j), j - first) = 1;
    solve_in_place(storage, v, unknown(first));
    for (index j = first; j < end; ++j) {
      for (index i = j; i < n; ++i) result->set(i, j, v.x(unknown(i), j - first));
    }
  }
  return result;
}

/// Whether S⁻¹, formed, is still positive definite when its entries are rounded to T, which those
/// of a factor always mean. `stiffness`: K_ii of its unknowns, in its unit. With D = diag(S⁻¹) and
/// M = D^-½ S⁻¹ D^-½, in any units of the unknowns,
///
///     λ_min(M)⁻¹ ≤ tr M⁻¹ = Σ (S⁻¹)_ii S_ii ≤ Σ (S⁻¹)_ii K_ii.
///
/// Rounding changes each entry of M by at most half an ε of it, one independently of the other; the
/// norm of such a matrix is about twice that of its longest row.
template <class T>
[[nodiscard]] bool stays_definite(packed_symmetric<double> const& inverse,
                                  std::vector<double> const& stiffness) {
  double trace = 0, largest = 0;
  std::vector<double> squares(stiffness.size(), 1);  // of the rows of M
  for (index j = 0; j < inverse.size(); ++j) {
    double const d = inverse(j, j);
    trace += d * stiffness[static_cast<std::size_t>(j)];
    largest = std::max(largest, d);
    for (index i = j + 1; i < inverse.size(); ++i) {
      double const m = inverse(i, j) / std::sqrt(inverse(i, i) * d);
      squares[static_cast<std::size_t>(i)] += m * m;
      squares[static_cast<std::size_t>(j)] += m * m;
    }
  }
  if (squares.empty()) return true;
  constexpr double ε = std::numeric_limits<T>::epsilon();
  double const row = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  return largest < ε * std::numeric_limits<T>::max() && ε * row * trace < 0.5;
}

}  // namespace slant::detail
