// SPDX-License-Identifier: MIT
//
// The rows of N and T as a check of their plausibility sees them: their entries, and the nodes of
// the body that they touch.
//
// Which unknowns belong to a node is not said anywhere in the data. It follows from the layout
// where that is given; from K, where unknowns of a node have the same neighbours (the
// supervariables of sparse elimination orders); or from one of the usual numberings, node by node
// or direction by direction. Of these the first one is taken that explains most contact nodes: one
// row of T, of any contact node, touches the same nodes as the row of N.
#pragma once

#include <slant/contact/contact_data.hpp>
#include <slant/contact/node_layout.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// The entries of the rows of a sparse matrix, without those that are rounding errors of their row.
template <class S>
class row_entries {
 public:
  struct entry {
    index unknown;
    S value;
  };
  using row = std::vector<entry>;

  explicit row_entries(Eigen::SparseMatrix<S> const& m) : rows_(std::size_t(m.rows())) {
    using std::abs;
    slant::detail::for_each_entry(m, [&](index i, index j, S const& value) {
      if (value != S(0)) rows_[static_cast<std::size_t>(i)].push_back({j, value});
    });
    for (row& r : rows_) {
      S const small = S(64) * std::numeric_limits<S>::epsilon() * largest(r);
      std::erase_if(r, [&](entry const& e) { return !(abs(e.value) > small); });
    }
  }
  [[nodiscard]] index size() const { return static_cast<index>(rows_.size()); }
  [[nodiscard]] row const& operator[](index i) const { return rows_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] static S largest(row const& r) {
    using std::abs;
    S most(0);
    for (entry const& e : r) most = std::max<S>(most, abs(e.value));
    return most;
  }
  /// ‖row‖₂, whatever its scale.
  [[nodiscard]] static S length(row const& r) {
    using std::sqrt;
    S const unit = largest(r);
    if (!(unit > S(0))) return S(0);
    S sum(0);
    for (entry const& e : r) sum += (e.value / unit) * (e.value / unit);
    return unit * sqrt(sum);
  }
  /// The cosine of the angle between two rows that are not zero.
  [[nodiscard]] static S cosine(row const& a, row const& b) {
    S const la = length(a), lb = length(b);
    S sum(0);
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].unknown == b[j].unknown) sum += (a[i].value / la) * (b[j].value / lb);
      bool const next = a[i].unknown <= b[j].unknown;
      if (b[j].unknown <= a[i].unknown) ++j;
      if (next) ++i;
    }
    return sum;
  }

 private:
  std::vector<row> rows_;  // by increasing unknowns, since m is stored by columns
};

[[nodiscard]] inline std::uint64_t mixed(std::uint64_t x) {  // splitmix64
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// A node for each unknown, its place among the unknowns of the node, and how many these are.
struct node_classes {
  std::vector<index> node{};
  std::vector<index> rank{};
  std::vector<index> size{};  ///< of each node

  /// Nodes by keys: unknowns with the same key share one.
  template <class Key>
  static node_classes by(index unknowns, Key key) {
    node_classes c;
    std::unordered_map<std::uint64_t, index> found;
    for (index j = 0; j < unknowns; ++j) {
      auto const at = found.try_emplace(key(j), static_cast<index>(c.size.size())).first->second;
      if (at == static_cast<index>(c.size.size())) c.size.push_back(0);
      c.node.push_back(at);
      c.rank.push_back(c.size[static_cast<std::size_t>(at)]++);
    }
    return c;
  }
  [[nodiscard]] index of(index unknown) const { return node[static_cast<std::size_t>(unknown)]; }
  [[nodiscard]] index size_at(index unknown) const {
    return size[static_cast<std::size_t>(of(unknown))];
  }
};

/// Unknowns with the same neighbours in the graph of K.
template <class S>
[[nodiscard]] node_classes classes_of_graph(Eigen::SparseMatrix<S> const& K) {
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(K.cols()), 0);
  slant::detail::for_each_entry(K, [&](index i, index j, S const&) {
    keys[static_cast<std::size_t>(j)] += mixed(static_cast<std::uint64_t>(i));
  });
  return node_classes::by(K.cols(), [&](index j) { return keys[static_cast<std::size_t>(j)]; });
}

/// The nodes that a row touches, as one number; 0 for an empty row.
template <class Row>
[[nodiscard]] std::uint64_t nodes_touched(Row const& row, node_classes const& classes) {
  std::vector<index> nodes;
  for (auto const& e : row) nodes.push_back(classes.of(e.unknown));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::uint64_t sum = 0;
  for (index const node : nodes) sum += mixed(static_cast<std::uint64_t>(node) + 1U);
  return sum;
}

/// The rows of contact data with their nodes.
template <class S>
struct contact_rows {
  row_entries<S> N, T;
  index m, tangents;
  node_classes classes{};
  std::vector<std::uint64_t> of_N{}, of_T{};  ///< nodes_touched of each row
  bool known = false;  ///< the classes explain most contact nodes, or there is no friction

  contact_rows(Eigen::SparseMatrix<S> const& K, data<S> const& c, node_layout<S> const& layout)
      : N(c.N), T(c.T), m(c.nodes()), tangents(c.tangents()) {
    index const n = K.cols();
    auto const number = [](index i) { return static_cast<std::uint64_t>(i); };
    if (layout.is_known()) {
      if (take(node_classes::by(
              n, [&](index j) { return number(layout.node[static_cast<std::size_t>(j)]); })))
        return;
    }
    if (take(classes_of_graph(K)) || tangents == 0) return;
    for (index D = tangents + 1; D <= 3; ++D) {
      if (n % D != 0) continue;
      if (take(node_classes::by(n, [&](index j) { return number(j / D); }))) return;
      if (take(node_classes::by(n, [&](index j) { return number(j % (n / D)); }))) return;
    }
    (void)take(classes_of_graph(K));
    known = false;
  }

  /// Row k of T of a node.
  [[nodiscard]] index tangent(index i, index k) const { return tangents * i + k; }
  [[nodiscard]] std::uint64_t nodes_of_N(index i) const {
    return of_N[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::uint64_t nodes_of_T(index r) const {
    return of_T[static_cast<std::size_t>(r)];
  }
  /// Unknowns of a complete node: the most common number of those that N and T touch.
  [[nodiscard]] index usual_size() const {
    std::unordered_map<index, index> counts;
    for (row_entries<S> const* rows : {&N, &T}) {
      for (index i = 0; i < rows->size(); ++i) {
        for (auto const& e : (*rows)[i]) ++counts[classes.size_at(e.unknown)];
      }
    }
    index size = 0, most = 0;
    for (auto const& [s, count] : counts) {
      if (count < most || (count == most && s < size)) continue;
      size = s;
      most = count;
    }
    return size;
  }

 private:
  bool take(node_classes found) {
    classes = std::move(found);
    of_N.clear();
    of_T.clear();
    for (index i = 0; i < m; ++i) of_N.push_back(nodes_touched(N[i], classes));
    for (index r = 0; r < T.size(); ++r) of_T.push_back(nodes_touched(T[r], classes));
    known = true;
    if (tangents == 0) return true;
    std::unordered_map<std::uint64_t, index> some_T;
    for (std::uint64_t const nodes : of_T) ++some_T[nodes];
    index explained = 0, all = 0;
    for (std::uint64_t const nodes : of_N) {
      if (nodes == 0) continue;
      ++all;
      explained += some_T.contains(nodes) ? 1 : 0;
    }
    return known = 2 * explained > all;
  }
};

}  // namespace slant::contact::detail
