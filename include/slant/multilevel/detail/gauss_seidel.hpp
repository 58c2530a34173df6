// SPDX-License-Identifier: MIT
//
// Sweeps of Gauss–Seidel over a symmetric matrix, perhaps with unknowns that are held at zero:
// those are passed over, which is the sweep over the principal submatrix of the others.
//
// Why Gauss–Seidel: forwards before and backwards after the coarse correction makes the cycle
// self-adjoint and definite for every definite matrix, whatever is held. No bound of a spectrum is
// needed that would have to be right.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <utility>
#include <vector>

namespace slant::detail {

/// Nothing is held.
struct nothing_held {
  constexpr bool operator()(index) const { return false; }
};

/// Unknown i is held if entry i of a list is not zero.
struct held_where {
  unsigned char const* entries;
  bool operator()(index i) const { return entries[i] != 0; }
};

/// A symmetric matrix, prepared for sweeps. Rows are compressed, their entries sorted.
template <class S>
class gauss_seidel {
 public:
  using matrix_type = Eigen::SparseMatrix<S, Eigen::RowMajor>;

  gauss_seidel() = default;
  /// The diagonal of K must be positive.
  explicit gauss_seidel(matrix_type k) : k_(std::move(k)), inverse_(k_.rows()) {
    k_.makeCompressed();
    diagonal_.resize(static_cast<std::size_t>(k_.rows()));
    for (index i = 0; i < k_.rows(); ++i) {
      int e = k_.outerIndexPtr()[i];
      while (k_.innerIndexPtr()[e] != i) ++e;
      diagonal_[static_cast<std::size_t>(i)] = e;
      inverse_[i] = S(1) / k_.valuePtr()[e];
    }
  }

  [[nodiscard]] matrix_type const& matrix() const { return k_; }

  /// x = (D + L)⁻¹ b and r = b − K x = −Lᵀx: together they cost one product.
  template <class V, class Held>
  void forwards_from_zero(V const& b, V& x, V& r, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) {
      x[i] = held(i) ? S(0) : S((b[i] - row(begin(i), middle(i), x)) * inverse_[i]);
    }
    for (index i = 0; i < k_.rows(); ++i) {
      r[i] = held(i) ? S(0) : S(-row(middle(i) + 1, end(i), x));
    }
  }
  /// r = b − K x, 0 where x is held.
  template <class V, class Held>
  void residual(V const& b, V const& x, V& r, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) {
      r[i] = held(i) ? S(0) : S(b[i] - row(begin(i), end(i), x));
    }
  }
  template <class V, class Held>
  void forwards(V const& b, V& x, Held held) const {
    for (index i = 0; i < k_.rows(); ++i) relax(i, b, x, held);
  }
  template <class V, class Held>
  void backwards(V const& b, V& x, Held held) const {
    for (index i = k_.rows() - 1; i >= 0; --i) relax(i, b, x, held);
  }

 private:
  [[nodiscard]] int begin(index i) const { return k_.outerIndexPtr()[i]; }
  [[nodiscard]] int end(index i) const { return k_.outerIndexPtr()[i + 1]; }
  [[nodiscard]] int middle(index i) const { return diagonal_[static_cast<std::size_t>(i)]; }

  /// Σ K_ij x_j over entries [from, to); four sums that do not wait for each other.
  template <class V>
  [[nodiscard]] S row(int from, int to, V const& x) const {
    S const* const values = k_.valuePtr();
    int const* const columns = k_.innerIndexPtr();
    S a(0), b(0), c(0), d(0);
    int e = from;
    for (; e + 3 < to; e += 4) {
      a += values[e] * x[columns[e]];
      b += values[e + 1] * x[columns[e + 1]];
      c += values[e + 2] * x[columns[e + 2]];
      d += values[e + 3] * x[columns[e + 3]];
    }
    for (; e < to; ++e) a += values[e] * x[columns[e]];
    return (a + b) + (c + d);
  }
  template <class V, class Held>
  void relax(index i, V const& b, V& x, Held held) const {
    if (held(i)) return;
    x[i] += (b[i] - row(begin(i), end(i), x)) * inverse_[i];
  }

  matrix_type k_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> inverse_;
  std::vector<int> diagonal_;  // where the entry K_ii is stored
};

}  // namespace slant::detail
