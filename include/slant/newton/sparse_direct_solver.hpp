// SPDX-License-Identifier: MIT
//
// Sparse Gaussian elimination for F°(y) dy = −F where F°(y) is no matrix but made of sparse ones: a
// natural residual I − G (I − ρA) with a sparse matrix A, say. The columns of the operator are
// taken some dozens at a time, and what is not zero of them becomes a sparse matrix: n² numbers are
// looked at, which up to some ten thousand unknowns is little beside the factorisation.
#pragma once

#include <slant/newton/direct_solver.hpp>

#include <algorithm>

namespace slant {

namespace detail {

/// Collects a sparse matrix from the columns of an operator, and factors it.
template <class S>
class sparse_columns {
  using block_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr index width = 32;

 public:
  static constexpr index factorizations = 1;

  explicit sparse_columns(index n) : matrix_(n, n) {}

  template <class G>
  [[nodiscard]] bool factor(G const& g) {
    index const n = matrix_.cols();
    matrix_.setZero();
    for (index first = 0; first < n; first += width) {
      block_type block(n, std::min(width, n - first));
      g.columns(first, block);
      append(first, block);
    }
    matrix_.finalize();
    return factors_.factor(matrix_);
  }
  template <class V>
  void solve(V const& b, V& x) const {
    factors_.solve(b, x);
  }
  /// y = G x, by the matrix.
  template <class V>
  void multiply(V const& x, V& y) const {
    slant::local(y).noalias() = matrix_ * slant::local(x);
  }

 private:
  void append(index first, block_type const& block) {
    for (index j = 0; j < index(block.cols()); ++j) {
      matrix_.startVec(first + j);
      for (index i = 0; i < index(block.rows()); ++i) {
        if (!(block(i, j) == S(0))) matrix_.insertBack(i, first + j) = block(i, j);
      }
    }
  }

  typename sparse_lu<S>::matrix_type matrix_;
  sparse_lu<S> factors_;
};

}  // namespace detail

/// Sparse LU of F°(y); for operators with columns, most of whose entries are zero. Allocates.
struct sparse_direct_solver {
  [[gnu::cold]] void validate() const {}

  template <class G, class V>
    requires linear_operator<G, V> && has_columns<G, detail::dense_matrix_t<V>>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    auto w = slant::workspace(g, f);
    return detail::direct_workspace<V, detail::sparse_columns<scalar_t<V>>, decltype(w)>{
        detail::sparse_columns<scalar_t<V>>(g.rows()), like(f, slant::local(f).size()),
        std::move(w)};
  }

  template <class G, class V, class P>
    requires linear_operator<G, V> && has_columns<G, detail::dense_matrix_t<V>>
  direction_report<scalar_t<V>> solve(G const& g, V const& f,
                                      direction_request<scalar_t<V>> const& request, V& dy,
                                      P& p) const {
    return detail::direct_direction(g, f, request, dy, p, [&](V& x) {
      if (!p.factors.factor(g)) return false;
      p.factors.solve(f, x);
      return true;
    });
  }

  /// The complaint about operators that it cannot handle.
  template <class G, class V>
  static consteval void refuse() {
    static_assert(has_columns<G, detail::dense_matrix_t<V>>,
                  "sparse_direct_solver: F°(y) must have columns");
  }
};

}  // namespace slant
