// SPDX-License-Identifier: MIT
//
// The factors L D Lᵀ of a symmetric positive semidefinite matrix of blocks, for the coarsest level:
//
//     for each block column J:   D_J⁻¹,   L_IJ = A_IJ D_J⁻¹,   A_IK ← A_IK − L_IJ A_KJᵀ
//
// Unknowns whose pivot cannot be told from zero, as the last ones of a body that floats and those of
// aggregates that are held, are left out. So solve applies the inverse of a principal submatrix, a
// generalised inverse, which is self-adjoint and semidefinite whatever rounding does to the pivots.
//
// n³/6 multiplications for n unknowns, n²/2 numbers; factoring anew does not allocate.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/lanes.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::detail {

// --- inverse of a block --------------------------------------------------------------------------
//
// The inverse of a small symmetric positive semidefinite matrix on the unknowns that it can tell
// apart, by the sweeps of Gauss and Jordan [Goodnight 1979]: unknown c with the pivot d = a_cc,
//
//     a_ij ← a_ij − a_ic a_cj / d,     a_ic ← a_ic / d,     a_cc ← −1/d,
//
// leaves −A⁻¹ in the end. An unknown whose pivot cannot be told from zero is left out: the result is
// the inverse of a principal submatrix and 0 in the other rows and columns. It is symmetric,
// semidefinite, and a generalised inverse of A.

/// a (n × n, by columns, symmetric) becomes its inverse. Unknown c is left out unless its pivot
/// exceeds least[c] ≥ 0. Returns the least of pivot / scale[c], of those with scale[c] > 0.
template <int N, class S>
S invert_semidefinite(S* a, S const* least, S const* scale) {
  bool kept[N];
  S lowest(1);
  for (int c = 0; c < N; ++c) {
    S const d = a[c * N + c];
    if (scale[c] > S(0) && d < lowest * scale[c]) lowest = d / scale[c];
    kept[c] = d > least[c];
    if (!kept[c]) {
      for (int i = 0; i < N; ++i) a[c * N + i] = a[i * N + c] = S(0);
      continue;
    }
    S const inverse = S(1) / d;
    S column[N];
    for (int i = 0; i < N; ++i) column[i] = a[c * N + i];
    for (int j = 0; j < N; ++j) {
      S const factor = column[j] * inverse;
      for (int i = 0; i < N; ++i) a[j * N + i] -= column[i] * factor;
    }
    for (int i = 0; i < N; ++i) a[c * N + i] = a[i * N + c] = column[i] * inverse;
    a[c * N + c] = -inverse;
  }
  for (int k = 0; k < N * N; ++k) a[k] = -a[k];
  return lowest;
}

// --- factors -------------------------------------------------------------------------------------

template <int N, class T>
class dense_factor {
  using columns = lanes<T, N>;
  static constexpr int stride = columns::size;
  static constexpr std::size_t size = static_cast<std::size_t>(N) * stride;  // of a block

 public:
  /// Room for `nodes` blocks.
  explicit dense_factor(int nodes = 0)
      : nodes_(nodes),
        blocks_(row(nodes) * size, T(0)),
        inverses_(static_cast<std::size_t>(nodes) * size, T(0)),
        sizes_(static_cast<std::size_t>(nodes) * N, 0.0) {}

  [[nodiscard]] int nodes() const { return nodes_; }

  /// Factors A; block(i, j, entries) → what stands for the block (i, j) of A. Pivots are measured by
  /// the diagonal, and by that of `free`: what it is while nothing is held, because a face may leave
  /// of an unknown what is but a rounding error of that. Returns the least pivot relative to its
  /// diagonal entry, which is 0 up to rounding for a semidefinite matrix.
  template <class Block>
  double factor(block_matrix<N, T> const& A, block_matrix<N, T> const& free, Block block) {
    std::fill(blocks_.begin(), blocks_.end(), T(0));
    for (int i = 0; i < nodes_; ++i) {
      A.for_each_in_row(i, [&](int j, T const* entries) {
        if (j > i) return;
        T const* const from = block(i, j, entries);
        for (int c = 0; c < N; ++c) {
          for (int q = 0; q < N; ++q) at(i, j)[stride * c + q] = from[N * c + q];
        }
      });
      for (int c = 0; c < N; ++c) {
        sizes_[static_cast<std::size_t>(N * i + c)] = static_cast<double>(
            std::max(at(i, i)[(stride + 1) * c], free.diagonal(i)[(N + 1) * c]));
      }
    }
    double lowest = 1;
    for (int J = 0; J < nodes_; ++J) {
      double d[N * N], least[N], scale[N];
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) d[N * c + q] = static_cast<double>(at(J, J)[stride * c + q]);
        scale[c] = sizes_[static_cast<std::size_t>(N * J + c)];
        least[c] = noise * (scale[c] > 0 ? scale[c] : 0);
      }
      lowest = std::min(lowest, invert_semidefinite<N>(d, least, scale));
      T* const inverse = inverses_.data() + static_cast<std::size_t>(J) * size;
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) inverse[stride * c + q] = T(d[N * c + q]);
      }
      for (int I = nodes_ - 1; I > J; --I) {  // rows K > I still need A_KJ of the rows below
        eliminate(I, J, inverse);
      }
    }
    return lowest;
  }

  /// x = A⁺b, block vectors that may be the same.
  void solve(T const* b, T* x) const {
    for (int i = 0; i < nodes_; ++i) {  // L y = b
      columns s = columns::load(b + offset(i));
      for (int j = 0; j < i; ++j) {
        T const* const l = at(i, j);
        columns t = columns::zero();
        unrolled<N>([&](auto c) __attribute__((always_inline)) {
          t.add(l + stride * c, x[offset(j) + static_cast<std::size_t>(c())]);
        });
        s -= t;
      }
      s.store_padded(x + offset(i));
    }
    for (int i = 0; i < nodes_; ++i) {  // z = D⁻¹y
      T const* const inverse = inverses_.data() + static_cast<std::size_t>(i) * size;
      columns y = columns::load(x + offset(i)), z = columns::zero();
      unrolled<N>([&](auto c)
                      __attribute__((always_inline)) { z.add(inverse + stride * c, y[c]); });
      z.store_padded(x + offset(i));
    }
    for (int i = nodes_ - 1; i > 0; --i) {  // Lᵀx = z, row i of L after row i + 1
      columns const from = columns::load(x + offset(i));
      for (int j = 0; j < i; ++j) {
        T const* const l = at(i, j);
        unrolled<N>([&](auto c) __attribute__((always_inline)) {
          columns product = columns::zero();
          product.add_product(columns::load(l + stride * c), from);
          x[offset(j) + static_cast<std::size_t>(c())] -= sum_of_lanes<T, N>(product);
        });
      }
    }
  }

 private:
  /// A pivot below so much of its diagonal entry is one of rounding: entries of a coarse level are
  /// sums of some tens of products each of which is rounded.
  static constexpr double noise = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());

  [[nodiscard]] static std::size_t row(int i) {
    return static_cast<std::size_t>(i) * (static_cast<std::size_t>(i) + 1) / 2;
  }
  [[nodiscard]] static std::size_t offset(int i) { return static_cast<std::size_t>(i) * stride; }
  [[nodiscard]] T* at(int i, int j) {
    return blocks_.data() + (row(i) + static_cast<std::size_t>(j)) * size;
  }
  [[nodiscard]] T const* at(int i, int j) const {
    return blocks_.data() + (row(i) + static_cast<std::size_t>(j)) * size;
  }

  /// Row I, J < I: A_IK ← A_IK − L_IJ A_KJᵀ for J < K ≤ I, then L_IJ in the place of A_IJ.
  void eliminate(int I, int J, T const* inverse) {
    columns a[N], l[N];
    for (int c = 0; c < N; ++c) {
      a[c] = columns::load(at(I, J) + stride * c);
      l[c] = columns::zero();
    }
    unrolled<N>([&](auto c) __attribute__((always_inline)) {
      unrolled<N>([&](auto k)
                      __attribute__((always_inline)) { l[c].add(a[k], inverse[stride * c + k]); });
    });
    for (int K = J + 1; K <= I; ++K) {
      T* const to = at(I, K);
      T const* const other = at(K, J);
      unrolled<N>([&](auto c) __attribute__((always_inline)) {
        columns s = columns::zero();
        unrolled<N>([&](auto k)
                        __attribute__((always_inline)) { s.add(l[k], other[stride * k + c]); });
        columns t = columns::load(to + stride * c);
        t -= s;
        t.store_padded(to + stride * c);
      });
    }
    for (int c = 0; c < N; ++c) l[c].store_padded(at(I, J) + stride * c);
  }

  int nodes_ = 0;
  std::vector<T> blocks_;      // A_IJ, J ≤ I, by rows of blocks; columns of `stride` numbers
  std::vector<T> inverses_;    // D_J⁻¹
  std::vector<double> sizes_;  // of the diagonal entries
};

}  // namespace slant::detail
