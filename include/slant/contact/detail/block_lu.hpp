// SPDX-License-Identifier: MIT
//
// LU factors of a matrix of N × N blocks that is assembled anew at every Newton step: a sparse LU,
// which allocates, as does the assembly; of a small or full matrix a dense LU, which does not for a
// size that it has seen.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/newton/detail/sparse_lu.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace slant::contact::detail {

/// See the top of this file.
template <int N, class S>
class block_lu {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using block_type = Eigen::Matrix<S, N, N>;

  /// assemble(put) calls put(i, j, block) for each of `count` blocks of a matrix of `rows` rows of
  /// blocks, once each. False if the matrix is singular, or has an entry that is not a number.
  template <class Assemble>
  [[nodiscard]] bool factor(index rows, index count, Assemble const& assemble) {
    index const n = N * rows;
    sparse_ = n > 48 && 8 * N * N * count <= n * n;
    return sparse_ ? factor_sparse(n, count, assemble) : factor_dense(n, assemble);
  }
  /// x = M⁻¹ b; false if that is not finite.
  [[nodiscard]] bool solve(vector_type const& b, vector_type& x) const {
    x.resize(b.size());
    if (sparse_) {
      sparse_lu_.solve(b, x);
    } else {
      x = dense_lu_.solve(b);
    }
    return slant::detail::is_finite(S(x.norm()));
  }
  /// Which LU the last matrix had.
  [[nodiscard]] bool is_sparse() const { return sparse_; }

 private:
  template <class Assemble>
  bool factor_dense(index n, Assemble const& assemble) {
    dense_.setZero(n, n);
    assemble([&](index i, index j, block_type const& b) {
      for (int c = 0; c < N; ++c) {
        for (int r = 0; r < N; ++r) dense_.coeffRef(N * i + r, N * j + c) = b.coeff(r, c);
      }
    });
    dense_lu_.compute(dense_);
    for (index i = 0; i < n; ++i) {
      S const pivot = dense_lu_.matrixLU()(i, i);
      if (pivot == S(0) || !slant::detail::is_finite(pivot)) return false;
    }
    return true;
  }
  template <class Assemble>
  bool factor_sparse(index n, index count, Assemble const& assemble) {
    triplets_.clear();
    triplets_.reserve(std::size_t(N * N * count));
    assemble([&](index i, index j, block_type const& b) {
      for (int c = 0; c < N; ++c) {
        for (int r = 0; r < N; ++r) {
          if (b(r, c) != S(0)) triplets_.emplace_back(int(N * i + r), int(N * j + c), b(r, c));
        }
      }
    });
    matrix_.resize(n, n);
    matrix_.setFromTriplets(triplets_.begin(), triplets_.end());
    return sparse_lu_.factor(matrix_);
  }

  bool sparse_ = false;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> dense_;
  Eigen::PartialPivLU<Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>> dense_lu_;
  std::vector<Eigen::Triplet<S>> triplets_;
  Eigen::SparseMatrix<S> matrix_;
  slant::detail::sparse_lu<S> sparse_lu_;
};

}  // namespace slant::contact::detail
