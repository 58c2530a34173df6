// SPDX-License-Identifier: MIT
//
// What a sparse Cholesky factorisation would cost, without the factorisation: the entries of L and
// the operations, counted column by column along the elimination tree [Liu 1990] for the minimum
// degree ordering that Eigen brings. Unknowns of a node share their pattern, so nodes are counted
// instead of unknowns: that is b² times less work for blocks of b.
//
// An estimate, not a promise: CHOLMOD may find an ordering by nested dissection, with up to a third
// of these operations for large bodies in space, and supernodes store some zeros.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/operators/node_blocks.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant {

/// Result of estimate_fill.
struct fill_estimate {
  double entries = 0;     ///< of L, the diagonal included
  double operations = 0;  ///< multiplications and additions of the factorisation
  bool complete = true;   ///< false: stopped counting at the limit, it is more than that
};

/// The estimate for a symmetric K (both triangles). Stops counting beyond `enough` operations.
/// Throws bad_input if K is not square.
template <class M>
[[nodiscard]] fill_estimate estimate_fill(Eigen::SparseCompressedBase<M> const& k,
                                          double enough = std::numeric_limits<double>::infinity()) {
  detail::check_size("columns of K", k.cols(), k.rows(), "rows of K,");
  fill_estimate result;
  if (k.rows() == 0) return result;
  index const b = detected_block_size(k), n = k.rows() / b;

  using pattern_type = Eigen::SparseMatrix<signed char>;
  std::vector<Eigen::Triplet<signed char>> entries;
  for (index j = 0; j < n; ++j) {
    index last = -1;
    for (typename M::InnerIterator e(k.derived(), j * b); e; ++e) {
      index const i = (M::IsRowMajor ? e.col() : e.row()) / b;
      if (std::exchange(last, i) != i) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), static_cast<signed char>(1));
      }
    }
  }
  pattern_type pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern.template selfadjointView<Eigen::Lower>(), order);
  // order.indices()[new] = old
  std::vector<int> place(static_cast<std::size_t>(n));
  for (index i = 0; i < n; ++i) {
    place[static_cast<std::size_t>(order.indices()[i])] = static_cast<int>(i);
  }
  std::vector<int> parent(static_cast<std::size_t>(n), -1), seen(static_cast<std::size_t>(n), -1);
  std::vector<double> below(static_cast<std::size_t>(n), 0);
  auto const B = static_cast<double>(b);
  for (int i = 0; i < n; ++i) {
    seen[static_cast<std::size_t>(i)] = i;
    for (pattern_type::InnerIterator e(pattern, order.indices()[i]); e; ++e) {
      int j = place[static_cast<std::size_t>(e.row())];
      if (j >= i) continue;
      while (seen[static_cast<std::size_t>(j)] != i) {
        auto const at = static_cast<std::size_t>(j);
        if (parent[at] < 0) parent[at] = i;
        // Columns of block j with c blocks below have Σ (b c + i)² operations, i < b: what one
        // block more adds to b³ c² + b² (b − 1) c.
        result.operations += B * B * (B * (2 * below[at]++ + 1) + B - 1);
        result.entries += B * B;
        seen[at] = i;
        j = parent[at];
      }
    }
    result.entries += B * (B + 1) / 2;
    result.operations += B * B * B / 3;
    if (result.operations > enough) {
      result.complete = false;
      return result;
    }
  }
  return result;
}

}  // namespace slant
