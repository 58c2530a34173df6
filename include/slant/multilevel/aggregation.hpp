// SPDX-License-Identifier: MIT
//
// Aggregation: nodes that are strongly coupled become one node of the next coarser level [Vaněk,
// Mandel, Brezina 1996, Algorithm 2].
//
//     1  a node whose strong neighbours are all unassigned becomes, with them, an aggregate
//     2  what is left joins the aggregate of step 1 that it is coupled to most strongly
//     3  what is left still becomes aggregates of neighbours
//
// A node is a block of consecutive unknowns. Nodes i and j are strongly coupled if ‖K_ij‖² > θ²
// ‖K_ii‖ ‖K_jj‖ in the norm of Frobenius: what is coupled weakly, as across a soft layer, cannot be
// corrected by one coarse unknown.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/operators/node_blocks.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

/// Which aggregate each node belongs to.
struct aggregation {
  std::vector<int> of;  ///< one entry per node
  index count = 0;      ///< number of aggregates
};

namespace detail {

/// Strong neighbours of each node, itself left out, with the square of the strength.
template <class S>
struct strong_graph {
  std::vector<std::size_t> first{0};
  std::vector<std::pair<int, S>> edges;

  template <class M>
  strong_graph(M const& k, node_blocks const& nodes, S const& θ) {
    using std::sqrt;
    auto const owner = nodes.owners();
    auto const n = static_cast<std::size_t>(nodes.count());
    std::vector<S> diagonal(n, S(0)), sum(n, S(0));
    std::vector<int> row;
    auto const visit = [&](index i, auto f) {
      for (int j = nodes.begin(i); j < nodes.end(i); ++j) {
        for (typename M::InnerIterator e(k, j); e; ++e) {
          f(owner[static_cast<std::size_t>(M::IsRowMajor ? e.col() : e.row())], e.value());
        }
      }
    };
    for (index i = 0; i < nodes.count(); ++i) {
      auto& d = diagonal[static_cast<std::size_t>(i)];
      visit(i, [&](int j, S const& v) { d += j == i ? v * v : S(0); });
      d = sqrt(d);
    }
    for (index i = 0; i < nodes.count(); ++i) {
      row.clear();
      visit(i, [&](int j, S const& v) {
        auto& s = sum[static_cast<std::size_t>(j)];
        if (s == S(0) && v != S(0)) row.push_back(j);
        s += v * v;
      });
      for (int const j : row) {
        S const size = std::exchange(sum[static_cast<std::size_t>(j)], S(0));
        S const limit = θ * θ * diagonal[static_cast<std::size_t>(i)];
        if (j != i && size > limit * diagonal[static_cast<std::size_t>(j)]) {
          edges.emplace_back(j, size / diagonal[static_cast<std::size_t>(j)]);
        }
      }
      first.push_back(edges.size());
    }
  }
  template <class F>
  void for_each(index i, F f) const {
    auto const j = static_cast<std::size_t>(i);
    for (std::size_t e = first[j]; e < first[j + 1]; ++e) f(edges[e].first, edges[e].second);
  }
};

}  // namespace detail

/// Aggregates of the nodes of a symmetric K; θ as at the top of this file.
template <class M>
[[nodiscard]] aggregation aggregate(Eigen::SparseCompressedBase<M> const& k,
                                    node_blocks const& nodes, double θ) {
  using S = typename M::Scalar;
  detail::strong_graph<S> const graph(k.derived(), nodes, S(θ));
  aggregation a{std::vector<int>(static_cast<std::size_t>(nodes.count()), -1), 0};
  auto const of = [&a](index i) -> int& { return a.of[static_cast<std::size_t>(i)]; };
  auto const open = [&](index i) {
    of(i) = static_cast<int>(a.count);
    graph.for_each(i, [&](int j, S const&) {
      if (of(j) < 0) of(j) = static_cast<int>(a.count);
    });
    ++a.count;
  };
  for (index i = 0; i < nodes.count(); ++i) {
    bool free = of(i) < 0;
    graph.for_each(i, [&](int j, S const&) { free = free && of(j) < 0; });
    if (free) open(i);
  }
  std::vector<int> const seeds = a.of;
  for (index i = 0; i < nodes.count(); ++i) {
    if (of(i) >= 0) continue;
    S strongest(0);
    graph.for_each(i, [&](int j, S const& strength) {
      int const there = seeds[static_cast<std::size_t>(j)];
      if (there < 0 || !(strength > strongest)) return;
      strongest = strength;
      of(i) = there;
    });
  }
  for (index i = 0; i < nodes.count(); ++i) {
    if (of(i) < 0) open(i);
  }
  return a;
}

}  // namespace slant
