// SPDX-License-Identifier: MIT
//
// A Cholesky factorisation for the reference solutions, written for being obviously right: K = L Lᵀ
// within the envelope of K, row by row. It shares nothing with the factorisations of the library.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace oracle {

/// L Lᵀ of a sparse symmetric positive definite matrix; only its lower triangle is read. Fast when
/// the nodes are numbered along the longest direction, as box meshes do.
class envelope_cholesky {
 public:
  using row_major = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Throws std::runtime_error when a pivot is not positive.
  explicit envelope_cholesky(Eigen::SparseMatrix<double> const& K)
      : rows_(static_cast<std::size_t>(K.rows())), begin_(rows_.size()) {
    for (Eigen::Index i = 0; i < K.rows(); ++i) begin(i) = i;
    for_each_lower(
        K, [&](Eigen::Index i, Eigen::Index j, double) { begin(i) = std::min(begin(i), j); });
    for (Eigen::Index i = 0; i < K.rows(); ++i) row(i).setZero(i - begin(i) + 1);
    for_each_lower(K, [&](Eigen::Index i, Eigen::Index j, double v) { row(i)[j - begin(i)] = v; });
    for (Eigen::Index i = 0; i < size(); ++i) eliminate(i);
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }

  /// Y ← L⁻¹ Y.
  template <class Derived>
  void forward(Eigen::MatrixBase<Derived>& Y) const {
    for (Eigen::Index i = 0; i < size(); ++i) {
      Eigen::Index const length = i - begin(i);
      if (length > 0)
        Y.row(i).noalias() -= row(i).head(length).transpose() * Y.middleRows(begin(i), length);
      Y.row(i) /= row(i)[length];
    }
  }

  /// y ← L⁻ᵀ y.
  void backward(Eigen::VectorXd& y) const {
    for (Eigen::Index i = size() - 1; i >= 0; --i) {
      Eigen::Index const length = i - begin(i);
      y[i] /= row(i)[length];
      y.segment(begin(i), length) -= y[i] * row(i).head(length);
    }
  }

  /// K⁻¹ b.
  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd b) const {
    forward(b);
    backward(b);
    return b;
  }

 private:
  template <class F>
  static void for_each_lower(Eigen::SparseMatrix<double> const& K, F const& f) {
    for (Eigen::Index j = 0; j < K.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(K, j); entry; ++entry)
        if (entry.row() >= j) f(entry.row(), j, entry.value());
  }

  void eliminate(Eigen::Index i) {
    for (Eigen::Index j = begin(i); j <= i; ++j) {
      Eigen::Index const from = std::max(begin(i), begin(j));
      double const rest =
          row(i)[j - begin(i)] -
          row(i).segment(from - begin(i), j - from).dot(row(j).segment(from - begin(j), j - from));
      if (j < i) {
        row(i)[j - begin(i)] = rest / row(j)[j - begin(j)];
      } else {
        if (!(rest > 0)) throw std::runtime_error("envelope_cholesky: a pivot is not positive");
        row(i)[j - begin(i)] = std::sqrt(rest);
      }
    }
  }

  Eigen::Index& begin(Eigen::Index i) { return begin_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Eigen::Index begin(Eigen::Index i) const {
    return begin_[static_cast<std::size_t>(i)];
  }
  Eigen::VectorXd& row(Eigen::Index i) { return rows_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Eigen::VectorXd const& row(Eigen::Index i) const {
    return rows_[static_cast<std::size_t>(i)];
  }

  std::vector<Eigen::VectorXd> rows_;  ///< row i of L from its first nonzero to the diagonal
  std::vector<Eigen::Index> begin_;    ///< column of the first nonzero of each row
};

}  // namespace oracle
