// SPDX-License-Identifier: MIT
//
// What is written as text is read again with the same bits.
#include "numbers.hpp"

#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>

#include <io/io_support.hpp>

#include <cstdint>
#include <cstring>

namespace properties::texts {

using sparse = Eigen::SparseMatrix<double>;

/// Any finite double: subnormal ones and the largest too.
rc::Gen<double> any_finite() {
  auto const of_bits = rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    return std::isfinite(x) ? x : 0.0;
  });
  return rc::gen::oneOf(number(), of_bits);
}

sparse any_matrix(bool symmetric) {
  int const rows = *rc::gen::inRange(0, 6), cols = symmetric ? rows : *rc::gen::inRange(0, 6);
  sparse A(rows, cols);
  for (int j = 0; j < cols; ++j)
    for (int i = 0; i < rows; ++i) {
      if (*rc::gen::inRange(0, 3) > 0 || (symmetric && i < j)) continue;
      double const value = *any_finite();
      A.coeffRef(i, j) = value;
      if (symmetric) A.coeffRef(j, i) = value;
    }
  A.makeCompressed();
  return A;
}

bool is_same(sparse const& A, sparse const& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols() || A.nonZeros() != B.nonZeros()) return false;
  auto const entries = static_cast<std::size_t>(A.nonZeros());
  for (Eigen::Index j = 0; j <= A.cols(); ++j)
    if (A.outerIndexPtr()[j] != B.outerIndexPtr()[j]) return false;
  return std::memcmp(A.valuePtr(), B.valuePtr(), entries * sizeof(double)) == 0 &&
         std::memcmp(A.innerIndexPtr(), B.innerIndexPtr(), entries * sizeof(int)) == 0;
}

bool is_same(Eigen::VectorXd const& x, Eigen::VectorXd const& y) {
  return x.size() == y.size() &&
         (x.size() == 0 || std::memcmp(x.data(), y.data(),
                                       static_cast<std::size_t>(x.size()) * sizeof(double)) == 0);
}

}  // namespace properties::texts

namespace properties {

bool texts_are_read_again() {
  using namespace texts;
  io_test::temporary_folder const folder;
  bool good = rc::check("a matrix in a file", [&] {
    bool const symmetric = *rc::gen::arbitrary<bool>();
    sparse const A = any_matrix(symmetric);
    slant::write_matrix_market(folder / "A.mtx", A,
                               symmetric ? slant::matrix_market_symmetry::symmetric
                                         : slant::matrix_market_symmetry::general);
    RC_ASSERT(is_same(slant::read_matrix_market(folder / "A.mtx"), A));
  });
  good = rc::check(
             "a vector in a file",
             [&] {
               Eigen::VectorXd const x = vector_of(*rc::gen::inRange(1, 9), any_finite);
               slant::write_text_vector(folder / "x.txt", x);
               RC_ASSERT(is_same(slant::read_text_vector(folder / "x.txt", {.size = x.size()}), x));
               auto const complains = [&] {
                 try {
                   (void)slant::read_text_vector(folder / "x.txt", {.size = x.size() + 1});
                   return false;
                 } catch (slant::bad_input const&) {
                   return true;
                 }
               };
               RC_ASSERT(complains());
             }) &&
         good;
  return good;
}

}  // namespace properties
