// SPDX-License-Identifier: MIT
//
// Writes sparse matrices in Matrix Market format, so that reading gives the same bits.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <filesystem>
#include <slant/io/atomic_file.hpp>
#include <slant/io/number_text.hpp>
#include <string>

namespace slant {

/// What is stored: all entries, or the lower triangle of a symmetric matrix.
enum class matrix_market_symmetry : unsigned char { general, symmetric };

namespace detail {

inline std::string name_of_entry(index row, index col) {
  return " in row " + show(row + 1) + ", column " + show(col + 1);
}

/// Throws bad_input, naming the first entry that differs from its mirror image.
template <class Matrix>
void expect_symmetric(std::string const& file, Matrix const& A) {
  if (A.rows() != A.cols())
    throw bad_input(file, show(A.rows()) + " rows and " + show(A.cols()) + " columns",
                    "a square matrix, since it is to be stored as symmetric");
  Matrix const mirrored = A.transpose();
  Matrix const difference = A - mirrored;
  for (index col = 0; col < difference.outerSize(); ++col)
    for (typename Matrix::InnerIterator entry(difference, col); entry; ++entry)
      if (entry.value() != 0)
        throw bad_input(file,
                        show(A.coeff(entry.row(), entry.col())) +
                            name_of_entry(entry.row(), entry.col()) + " and " +
                            show(A.coeff(entry.col(), entry.row())) + " in its mirror image",
                        "equal entries, since it is to be stored as symmetric");
}

}  // namespace detail

/// Appends a matrix. Explicit zeros are written. Throws bad_input for NaN and infinity, and for a
/// matrix that is not exactly symmetric though it is to be stored so; std::system_error if there is
/// no room.
template <class Derived>
void write_matrix_market(atomic_file& file, Eigen::SparseMatrixBase<Derived> const& matrix,
                         matrix_market_symmetry symmetry = matrix_market_symmetry::general) {
  using matrix_type = Eigen::SparseMatrix<typename Derived::Scalar, Eigen::ColMajor,
                                          typename Derived::StorageIndex>;
  matrix_type const A(matrix.derived());
  std::string const name = detail::printable(file.target());
  bool const lower = symmetry == matrix_market_symmetry::symmetric;

  index count = 0;
  for (index col = 0; col < A.outerSize(); ++col)
    for (typename matrix_type::InnerIterator entry(A, col); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        throw bad_input(
            name, detail::show(entry.value()) + detail::name_of_entry(entry.row(), entry.col()),
            "finite entries");
      if (!lower || entry.row() >= entry.col()) ++count;
    }
  if (lower) detail::expect_symmetric(name, A);

  std::string text = "%%MatrixMarket matrix coordinate real ";
  text.append(lower ? "symmetric\n" : "general\n");
  text.append(detail::show(A.rows()) + " " + detail::show(A.cols()) + " " + detail::show(count));
  text += '\n';
  for (index col = 0; col < A.outerSize(); ++col) {
    for (typename matrix_type::InnerIterator entry(A, col); entry; ++entry) {
      if (lower && entry.row() < entry.col()) continue;
      detail::append_number(text, entry.row() + 1);
      text += ' ';
      detail::append_number(text, entry.col() + 1);
      text += ' ';
      detail::append_number(text, entry.value());
      text += '\n';
    }
    file.write(text);
    text.clear();
  }
  file.write(text);
}

/// The same as a file of its own, which appears complete or not at all.
template <class Derived>
void write_matrix_market(std::filesystem::path const& path,
                         Eigen::SparseMatrixBase<Derived> const& matrix,
                         matrix_market_symmetry symmetry = matrix_market_symmetry::general) {
  atomic_file file(path);
  write_matrix_market(file, matrix, symmetry);
  file.commit();
}

}  // namespace slant
