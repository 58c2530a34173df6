// SPDX-License-Identifier: MIT
//
// The inverse of a small positive definite matrix by P A Pᵀ = L D Lᵀ, the largest entry left on the
// diagonal first: the steps of Eigen's LDLT, which has all its types anew for every size.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace slant::detail {

/// A⁻¹ of a symmetric A, of which the lower triangle is read. A direction in which A is zero has a
/// zero in the inverse. Does not allocate.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> definite_inverse(Eigen::Matrix<S, N, N> const& A) {
  std::array<std::array<S, N>, N> a;  // the lower triangle; L below the diagonal of D in the end
  std::array<std::size_t, N> order;
  for (std::size_t i = 0; i < N; ++i) {
    order[i] = i;
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = a[j][i] = A.data()[i + N * j];
  }
  auto const size = [](S const& x) { return x < S(0) ? S(-x) : x; };
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t first = k;
    for (std::size_t i = k + 1; i < N; ++i) {
      if (size(a[i][i]) > size(a[first][first])) first = i;
    }
    std::swap(order[k], order[first]);
    std::swap(a[k], a[first]);
    for (auto& row : a) std::swap(row[k], row[first]);
    if (!(size(a[k][k]) > (std::numeric_limits<S>::min)())) {
      for (std::size_t i = k + 1; i < N; ++i) a[i][k] = S(0);
    }
    for (std::size_t i = k + 1; i < N; ++i) {
      S const l = a[i][k] == S(0) ? S(0) : S(a[i][k] / a[k][k]);
      for (std::size_t j = k + 1; j <= i; ++j) a[i][j] = a[j][i] = S(a[i][j] - l * a[k][j]);
      a[i][k] = l;
    }
  }
  Eigen::Matrix<S, N, N> inverse;
  for (std::size_t column = 0; column < N; ++column) {
    std::array<S, N> x;
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = S(i == column ? 1 : 0);
      for (std::size_t j = 0; j < i; ++j) x[i] -= a[i][j] * x[j];
    }
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = size(a[i][i]) > (std::numeric_limits<S>::min)() ? S(x[i] / a[i][i]) : S(0);
    }
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t j = i + 1; j < N; ++j) x[i] -= a[j][i] * x[j];
      inverse.data()[order[i] + N * order[column]] = x[i];
    }
  }
  return inverse;
}

}  // namespace slant::detail
