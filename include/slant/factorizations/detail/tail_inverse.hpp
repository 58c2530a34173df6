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
#include <cstddef>
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

}  // namespace slant::detail
