// SPDX-License-Identifier: MIT
//
// Dense linear algebra in quadruple precision, written for references: loops over arrays, no header
// of the library and none of Eigen's factorisations takes part. 113 bits and exponents up to
// 1e4932, so that units of 1e±150 need no care. The arithmetic is that of the compiler's run time,
// as fast in an unoptimised build.
#pragma once

#include <cstddef>
#include <vector>

namespace stability {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
using quad = long double;  // 113 bits where there is no other type of that name
#endif

using quad_vector = std::vector<quad>;

[[nodiscard]] inline quad magnitude(quad a) {
  return a < 0 ? -a : a;
}

/// √a by Newton's method from the root of a double in range; 0 for a ≤ 0.
[[nodiscard]] quad root(quad a);

[[nodiscard]] quad dot(quad_vector const& x, quad_vector const& y);

/// ‖x‖₂.
[[nodiscard]] inline quad length(quad_vector const& x) {
  return root(dot(x, x));
}

/// A dense matrix, row after row.
struct quad_matrix {
  std::size_t rows = 0, cols = 0;
  quad_vector entries{};

  quad_matrix() = default;
  quad_matrix(std::size_t m, std::size_t n) : rows(m), cols(n), entries(m * n, quad(0)) {}

  [[nodiscard]] quad& operator()(std::size_t i, std::size_t j) { return entries[i * cols + j]; }
  [[nodiscard]] quad operator()(std::size_t i, std::size_t j) const {
    return entries[i * cols + j];
  }
  [[nodiscard]] quad_vector times(quad_vector const& x) const;
};

/// Cholesky's factor of a definite matrix; ok is false at the first pivot that is not positive.
class quad_cholesky {
 public:
  explicit quad_cholesky(quad_matrix a);
  [[nodiscard]] bool ok() const { return ok_; }
  /// A⁻¹ x.
  [[nodiscard]] quad_vector solve(quad_vector x) const;

 private:
  quad_matrix l_;
  bool ok_ = true;
};

/// x with A x = b by elimination with partial pivoting; empty if A is singular.
[[nodiscard]] quad_vector eliminate(quad_matrix a, quad_vector b);

}  // namespace stability
