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

#include <slant/base/partitions.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>
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
  pattern_type pattern(n, n);
  pattern.reserve(k.nonZeros() / (b * b));
  for (index j = 0; j < n; ++j) {
    pattern.startVec(j);
    // Blocks have no gaps, so that every b-th entry is the first one of a node.
    auto const rows = detail::inner_indices(k, j * b);
    for (std::size_t e = 0; e < rows.size(); e += static_cast<std::size_t>(b)) {
      pattern.insertBackByOuterInner(j, rows[e] / b) = 1;
    }
  }
  pattern.finalize();
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

namespace slant::detail {

/// The graph of a symmetric matrix (both triangles), consecutive unknowns with equal columns being
/// one vertex: such unknowns, the displacements of one mesh node say, are neighbours in every good
/// ordering, and in three dimensions the graph has a ninth of the edges.
class quotient_graph {
 public:
  explicit quotient_graph(Eigen::SparseMatrix<double> const& k)
      : group_(static_cast<std::size_t>(k.cols())) {
    for (index j = 0; j < k.cols(); ++j) {
      bool const same = j > 0 && std::ranges::equal(inner_indices(k, j), inner_indices(k, j - 1));
      if (!same) first_.push_back(static_cast<int>(j));
      group_[static_cast<std::size_t>(j)] = static_cast<int>(first_.size()) - 1;
    }
    first_.push_back(static_cast<int>(k.cols()));
    graph_.resize(size(), size());
    std::vector<int> seen(static_cast<std::size_t>(size()), -1);
    std::vector<int> begin{0}, rows;
    for (int v = 0; v < size(); ++v) {
      for (int const row : inner_indices(k, first_[static_cast<std::size_t>(v)])) {
        int const w = group_[static_cast<std::size_t>(row)];
        int& last = seen[static_cast<std::size_t>(w)];
        if (last != v) rows.push_back(w);
        last = v;
      }
      begin.push_back(static_cast<int>(rows.size()));
    }
    graph_ = Eigen::Map<Eigen::SparseMatrix<double> const>(
        size(), size(), static_cast<index>(rows.size()), begin.data(), rows.data(),
        Eigen::VectorXd::Ones(static_cast<index>(rows.size())).eval().data());
  }

  /// Number of groups.
  [[nodiscard]] int size() const { return static_cast<int>(first_.size()) - 1; }
  /// A matrix with this graph.
  [[nodiscard]] Eigen::SparseMatrix<double> const& graph() const noexcept { return graph_; }
  /// The groups that contain a marked unknown.
  [[nodiscard]] std::vector<char> groups(std::vector<char> const& marked) const {
    std::vector<char> result(static_cast<std::size_t>(size()), 0);
    for (std::size_t j = 0; j < marked.size(); ++j) {
      if (marked[j] != 0) result[static_cast<std::size_t>(group_[j])] = 1;
    }
    return result;
  }
  /// An ordering of the unknowns from one of the groups.
  [[nodiscard]] std::vector<int> expanded(std::vector<int> const& order) const {
    std::vector<int> result;
    result.reserve(group_.size());
    for (int v : order) {
      for (int j = first_[static_cast<std::size_t>(v)]; j < first_[static_cast<std::size_t>(v) + 1];
           ++j) {
        result.push_back(j);
      }
    }
    return result;
  }

 private:
  std::vector<int> group_;  // of each unknown
  std::vector<int> first_;  // unknown of each group, and the number of unknowns
  Eigen::SparseMatrix<double> graph_;
};

}  // namespace slant::detail
