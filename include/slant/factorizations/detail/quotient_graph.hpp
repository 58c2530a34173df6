// SPDX-License-Identifier: MIT
//
// Unknowns with the same neighbours, such as the displacements of one mesh node, are neighbours in
// every good ordering: orderings are found on the graph of groups of them, which in three
// dimensions has a ninth of the edges.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant::detail {

/// The graph of a symmetric matrix (both triangles), consecutive unknowns with equal columns being
/// one vertex.
class quotient_graph {
 public:
  explicit quotient_graph(Eigen::SparseMatrix<double> const& k)
      : group_(static_cast<std::size_t>(k.cols())) {
    // A column ends where the next one begins, unless there is room to insert.
    int const* const lengths = k.innerNonZeroPtr();
    auto const column = [&k, lengths](index j) {
      int const* const begin = k.innerIndexPtr() + k.outerIndexPtr()[j];
      index const length =
          lengths != nullptr ? lengths[j] : k.outerIndexPtr()[j + 1] - k.outerIndexPtr()[j];
      return std::pair(begin, begin + length);
    };
    for (index j = 0; j < k.cols(); ++j) {
      bool same = false;
      if (j > 0) {
        auto const [a, b] = column(j);
        auto const [c, d] = column(j - 1);
        same = std::equal(a, b, c, d);
      }
      if (!same) first_.push_back(static_cast<int>(j));
      group_[static_cast<std::size_t>(j)] = static_cast<int>(first_.size()) - 1;
    }
    first_.push_back(static_cast<int>(k.cols()));
    graph_.resize(size(), size());
    std::vector<int> seen(static_cast<std::size_t>(size()), -1);
    std::vector<int> begin{0}, rows;
    for (int v = 0; v < size(); ++v) {
      auto const [a, b] = column(first_[static_cast<std::size_t>(v)]);
      for (auto i = a; i != b; ++i) {
        int const w = group_[static_cast<std::size_t>(*i)];
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
  /// Number of unknowns of a group.
  [[nodiscard]] int weight(int v) const {
    return first_[static_cast<std::size_t>(v) + 1] - first_[static_cast<std::size_t>(v)];
  }
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
