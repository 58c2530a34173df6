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

#include <slant/base/partitions.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/krylov/spectral_bound.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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

namespace slant::detail {

// --- tentative prolongation ----------------------------------------------------------------------
//
// The tentative prolongation of smoothed aggregation [Vaněk, Mandel, Brezina 1996, Algorithm 1]:
// on each aggregate the candidates B of the near kernel are made orthonormal, B = Q R. Q is what
// the coarse unknowns of the aggregate stand for, R are the candidates of the coarse level: P₀ R =
// B, so that the range of P₀ holds the near kernel exactly.
//
// Candidates that depend on the others there (the rotation of a single node) get no coarse unknown.

template <class S>
using row_major_sparse = Eigen::SparseMatrix<S, Eigen::RowMajor>;

/// P₀, and nodes and candidates of the coarse level.
template <class S>
struct tentative_prolongation {
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  row_major_sparse<S> P;
  node_blocks nodes;
  matrix_type candidates;

  tentative_prolongation(aggregation const& a, node_blocks const& fine, matrix_type const& B) {
    std::vector<std::vector<int>> members(static_cast<std::size_t>(a.count));
    for (index i = 0; i < fine.count(); ++i) {
      auto& list = members[static_cast<std::size_t>(a.of[static_cast<std::size_t>(i)])];
      for (int j = fine.begin(i); j < fine.end(i); ++j) list.push_back(j);
    }
    std::vector<Eigen::Triplet<S>> entries;
    entries.reserve(static_cast<std::size_t>(B.size()));
    matrix_type coarse(a.count * B.cols(), B.cols());
    int next = 0;
    matrix_type Q, R;
    for (auto const& list : members) {
      orthonormalise(B, list, Q, R);
      for (index c = 0; c < Q.cols(); ++c) {
        for (std::size_t j = 0; j < list.size(); ++j) {
          S const value = Q(static_cast<index>(j), c);
          if (value != S(0)) entries.emplace_back(list[j], next + static_cast<int>(c), value);
        }
      }
      coarse.middleRows(next, R.rows()) = R;
      next += static_cast<int>(R.rows());
      nodes.first.push_back(next);
    }
    candidates = coarse.topRows(next);
    P.resize(B.rows(), next);
    P.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  /// Q with orthonormal columns that span the rows `list` of B, R = QᵀB. Gram and Schmidt, twice.
  static void orthonormalise(matrix_type const& B, std::vector<int> const& list, matrix_type& Q,
                             matrix_type& R) {
    using std::sqrt;
    auto const rows = static_cast<index>(list.size());
    Q.resize(rows, B.cols());
    matrix_type const part = B(list, Eigen::all);
    index rank = 0;
    for (index c = 0; c < B.cols(); ++c) {
      auto q = Q.col(rank);
      q = part.col(c);
      S const size = q.norm();
      for (int twice = 0; twice < 2; ++twice) {
        for (index l = 0; l < rank; ++l) q -= Q.col(l).dot(q) * Q.col(l);
      }
      S const left = q.norm();
      if (!(left > sqrt(std::numeric_limits<S>::epsilon()) * size)) continue;
      q /= left;
      if (++rank == rows) break;
    }
    Q.conservativeResize(rows, rank);
    R = Q.transpose() * part;
  }
};

// --- smoothed prolongation -----------------------------------------------------------------------
//
// P = (I − ω D⁻¹K) P₀, D = diag(K), ω = damping / λ_max(D⁻¹K): one step of Jacobi's method takes
// the energy out of the jumps between aggregates [Vaněk, Mandel, Brezina 1996].
//
// λ_max: a few Lanczos steps, raised by what they may have missed, or the bound of Gershgorin if
// that is smaller. A value too small would cost convergence, never definiteness.

/// y = D^−½ K D^−½ x.
template <class S>
struct unit_diagonal_operator {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  row_major_sparse<S> const& k;
  vector_type root;  // D^−½

  [[nodiscard]] index rows() const { return k.rows(); }
  [[nodiscard]] index cols() const { return k.cols(); }
  struct room {
    vector_type scaled;
  };
  [[nodiscard]] room workspace(vector_type const&) const { return {vector_type(k.rows())}; }
  void apply(vector_type const& x, vector_type& y, room& w) const {
    w.scaled = root.cwiseProduct(x);
    y.noalias() = k * w.scaled;
    y.array() *= root.array();
  }
};

/// An estimate of λ_max(D⁻¹K) from above for a symmetric K with positive diagonal d.
template <class S, class V>
[[nodiscard]] S jacobi_eigenvalue(row_major_sparse<S> const& k, V const& d) {
  using std::abs;
  using std::sqrt;
  V root(d.size());
  for (index i = 0; i < d.size(); ++i) root[i] = S(1) / sqrt(d[i]);
  S gershgorin(0);
  for (index i = 0; i < k.rows(); ++i) {
    S sum(0);
    for (typename row_major_sparse<S>::InnerIterator e(k, i); e; ++e) {
      sum += abs(e.value()) * root[e.col()];
    }
    gershgorin = std::max<S>(gershgorin, sum * root[i]);
  }
  unit_diagonal_operator<S> const scaled{k, root};
  auto const lanczos = largest_eigenvalue_bound(scaled, root, {.steps = 12, .failure = 0.5});
  return std::min<S>(gershgorin, lanczos.upper);
}

/// P from P₀.
template <class S>
[[nodiscard]] row_major_sparse<S> smoothed_prolongation(row_major_sparse<S> const& k,
                                                        row_major_sparse<S> const& P0, S damping) {
  using std::sqrt;
  Eigen::Matrix<S, Eigen::Dynamic, 1> const d = k.diagonal();
  S const ω = damping / jacobi_eigenvalue(k, d);
  row_major_sparse<S> smooth = k * P0;
  for (index i = 0; i < smooth.rows(); ++i) {
    for (typename row_major_sparse<S>::InnerIterator e(smooth, i); e; ++e) {
      e.valueRef() *= -ω / d[i];
    }
  }
  row_major_sparse<S> P = P0 + smooth;
  // Of an aggregate without neighbours the damped step may leave nothing: it stays as it was.
  using columns = Eigen::Array<S, Eigen::Dynamic, 1>;
  auto const squares = [](row_major_sparse<S> const& m) {
    columns sums = columns::Zero(m.cols());
    for (index i = 0; i < m.rows(); ++i) {
      for (typename row_major_sparse<S>::InnerIterator e(m, i); e; ++e) {
        sums[e.col()] += e.value() * e.value();
      }
    }
    return sums;
  };
  S const enough = sqrt(std::numeric_limits<S>::epsilon());
  columns const keep = (squares(P) < enough * squares(P0)).template cast<S>();
  if ((keep > S(0)).any()) {
    for (index i = 0; i < smooth.rows(); ++i) {
      for (typename row_major_sparse<S>::InnerIterator e(smooth, i); e; ++e) {
        if (keep[e.col()] > S(0)) e.valueRef() = S(0);
      }
    }
    P = P0 + smooth;
  }
  P.makeCompressed();
  return P;
}

}  // namespace slant::detail
