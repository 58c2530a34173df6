// SPDX-License-Identifier: MIT
//
// The factors L D Lᵀ of a symmetric positive semidefinite matrix of blocks within its envelope, for
// the coarsest level [Jennings 1977, section 4.7]: with m_I the first block of row I that is there,
// for each block row I
//
//     A_IK ← A_IK − Σ A_IJ L_KJᵀ  over max(m_I, m_K) ≤ J < K,   for K = m_I … I − 1,
//     L_IJ = A_IJ D_J⁻¹,   D_I = A_II − Σ L_IJ A_IJᵀ.
//
// What is zero in front of m_I stays zero. Rows are in the order of Cuthill and McKee from an outer
// node, reversed, so that the envelope of a mesh is about as wide as its cross-section.
//
// Unknowns whose pivot cannot be told from zero, as the last ones of a body that floats and those of
// aggregates that are held, are left out. So solve applies the inverse of a principal submatrix, which
// is self-adjoint and semidefinite whatever rounding does to the pivots, and a generalised inverse
// where those that vanish are left out (weights of contrast leave more of them than 64 ε).
//
// Half the sum of (I − m_I)² products of blocks; factoring anew does not allocate.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/lanes.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
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
  S lowest(1);
  bool done[N] = {};
  for (int k = 0; k < N; ++k) {
    // Small pivots last: behind one what should vanish is rounding of the size of its inverse.
    int c = -1;
    S best(0);
    for (int i = 0; i < N; ++i) {
      S const ratio = scale[i] > S(0) ? a[i * N + i] / scale[i] : S(0);
      if (!done[i] && (c < 0 || ratio > best)) {
        c = i;
        best = ratio;
      }
    }
    done[c] = true;
    S const d = a[c * N + c];
    if (scale[c] > S(0) && d < lowest * scale[c]) lowest = d / scale[c];
    if (!(d > least[c])) {
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

// --- envelope ------------------------------------------------------------------------------------

/// An order of the rows of a matrix, and where each begins in it.
struct envelope {
  std::vector<int> order;          // the row of A that is row I of the factors
  std::vector<int> place;          // the other way round
  std::vector<int> first;          // m_I
  std::vector<std::size_t> begin;  // of block (I, m_I) in a list of all; and the end of that

  envelope() = default;
  template <int N, class T>
  explicit envelope(block_matrix<N, T> const& A)
      : place(static_cast<std::size_t>(A.nodes()), -1), begin(1, 0) {
    auto const n = static_cast<std::size_t>(A.nodes());
    order.reserve(n);
    for (int i = 0; i < A.nodes(); ++i) {
      if (place[static_cast<std::size_t>(i)] >= 0) continue;
      // The last node of a search lies at the outside.
      int outer = i;
      for (int k = 0; k < 2; ++k) {
        std::size_t const from = order.size();
        search(A, outer);
        outer = order.back();
        for (std::size_t l = from; l < order.size(); ++l) place[std::size_t(order[l])] = -1;
        order.resize(from);
      }
      search(A, outer);
    }
    std::reverse(order.begin(), order.end());
    for (std::size_t I = 0; I < n; ++I) place[static_cast<std::size_t>(order[I])] = int(I);
    for (std::size_t I = 0; I < n; ++I) {
      int m = static_cast<int>(I);
      A.for_each_in_row(
          order[I], [&](int j, T const*) { m = std::min(m, place[static_cast<std::size_t>(j)]); });
      first.push_back(m);
      begin.push_back(begin.back() + I + 1 - static_cast<std::size_t>(m));
    }
  }

  /// Multiplications of factors with blocks of N unknowns.
  [[nodiscard]] double work(int N) const {
    double sum = 0;
    for (std::size_t I = 0; I < first.size(); ++I) {
      double const left = static_cast<double>(I) - first[I];
      sum += left * (left + 1) / 2;
    }
    return sum * N * N * N;
  }

 private:
  /// Appends what can be reached from i: neighbours after neighbours, those with few of their own
  /// first.
  template <int N, class T>
  void search(block_matrix<N, T> const& A, int i) {
    auto const degree = [&](int j) {
      return A.lower().end(j) - A.lower().begin(j) + A.upper().end(j) - A.upper().begin(j);
    };
    std::size_t next = order.size();
    auto const visit = [&](int j) {
      if (place[static_cast<std::size_t>(j)] >= 0) return;
      place[static_cast<std::size_t>(j)] = 0;
      order.push_back(j);
    };
    for (visit(i); next < order.size(); ++next) {
      auto const from = static_cast<std::ptrdiff_t>(order.size());
      A.for_each_in_row(order[next], [&](int j, T const*) { visit(j); });
      std::sort(order.begin() + from, order.end(), [&](int j, int k) {
        return degree(j) != degree(k) ? degree(j) < degree(k) : j < k;
      });
    }
  }
};

// --- factors -------------------------------------------------------------------------------------

template <int N, class T>
class envelope_factor {
  using columns = lanes<T, N>;
  static constexpr int stride = columns::size;
  static constexpr std::size_t size = static_cast<std::size_t>(N) * stride;  // of a block

 public:
  envelope_factor() = default;
  /// Room for the factors of matrices with this envelope.
  explicit envelope_factor(envelope e)
      : envelope_(std::move(e)),
        blocks_(envelope_.begin.back() * size, T(0)),
        inverses_(envelope_.first.size() * size, T(0)) {}

  /// Factors A; block(i, j, entries) → what stands for the block (i, j) of A. Pivots are measured by
  /// the diagonal, and by that of `free`: what it is while nothing is held, because a face may leave
  /// of an unknown what is but a rounding error of that. Returns the least pivot relative to its
  /// diagonal entry, which is 0 up to rounding for a semidefinite matrix.
  template <class Block>
  double factor(block_matrix<N, T> const& A, block_matrix<N, T> const& free, Block block) {
    std::fill(blocks_.begin(), blocks_.end(), T(0));
    double lowest = 1;
    for (int I = 0; I < nodes(); ++I) {
      int const i = row(I);
      A.for_each_in_row(i, [&](int j, T const* entries) {
        int const J = envelope_.place[static_cast<std::size_t>(j)];
        if (J > I) return;
        T const* const from = block(i, j, entries);
        for (int c = 0; c < N; ++c) {
          for (int q = 0; q < N; ++q) at(I, J)[stride * c + q] = from[N * c + q];
        }
      });
      double d[N * N], least[N], scale[N];
      for (int c = 0; c < N; ++c) {
        scale[c] = static_cast<double>(
            std::max(at(I, I)[(stride + 1) * c], free.diagonal(i)[(N + 1) * c]));
        least[c] = noise * (scale[c] > 0 ? scale[c] : 0);
      }
      for (int K = first(I) + 1; K < I; ++K) subtract_products(I, K, at(I, K));
      eliminate(I);
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) d[N * c + q] = static_cast<double>(at(I, I)[stride * c + q]);
      }
      lowest = std::min(lowest, invert_semidefinite<N>(d, least, scale));
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) inverse(I)[stride * c + q] = T(d[N * c + q]);
      }
    }
    return lowest;
  }

  /// x = A⁺b, block vectors that may be the same.
  void solve(T const* b, T* x) const {
    for (int I = 0; I < nodes(); ++I) {  // L y = b
      columns s = columns::load(b + offset(I));
      for (int J = first(I); J < I; ++J) {
        T const* const l = at(I, J);
        T const* const y = x + offset(J);
        columns t = columns::zero();
        unrolled<N>([&](auto c) __attribute__((always_inline)) { t.add(l + stride * c, y[c()]); });
        s -= t;
      }
      s.store_padded(x + offset(I));
    }
    for (int I = 0; I < nodes(); ++I) {  // z = D⁻¹y
      T const* const d = inverse(I);
      columns y = columns::load(x + offset(I)), z = columns::zero();
      unrolled<N>([&](auto c) __attribute__((always_inline)) { z.add(d + stride * c, y[c]); });
      z.store_padded(x + offset(I));
    }
    for (int I = nodes() - 1; I > 0; --I) {  // Lᵀx = z, row I of L after row I + 1
      columns const from = columns::load(x + offset(I));
      for (int J = first(I); J < I; ++J) {
        T const* const l = at(I, J);
        T* const to = x + offset(J);
        unrolled<N>([&](auto c) __attribute__((always_inline)) {
          columns product = columns::zero();
          product.add_product(columns::load(l + stride * c), from);
          to[c()] -= sum_of_lanes<T, N>(product);
        });
      }
    }
  }

 private:
  /// A pivot below so much of its diagonal entry is one of rounding: entries of a coarse level are
  /// sums of some tens of products each of which is rounded.
  static constexpr double noise = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());

  [[nodiscard]] int nodes() const { return static_cast<int>(envelope_.first.size()); }
  [[nodiscard]] int row(int I) const { return envelope_.order[static_cast<std::size_t>(I)]; }
  [[nodiscard]] int first(int I) const { return envelope_.first[static_cast<std::size_t>(I)]; }
  /// Where the block I of a vector stands.
  [[nodiscard]] std::size_t offset(int I) const {
    return static_cast<std::size_t>(row(I)) * stride;
  }
  [[nodiscard]] std::size_t number(int I, int J) const {
    return envelope_.begin[static_cast<std::size_t>(I)] + static_cast<std::size_t>(J - first(I));
  }
  [[nodiscard]] T* at(int I, int J) { return blocks_.data() + number(I, J) * size; }
  [[nodiscard]] T const* at(int I, int J) const { return blocks_.data() + number(I, J) * size; }
  [[nodiscard]] T* inverse(int I) { return inverses_.data() + static_cast<std::size_t>(I) * size; }
  [[nodiscard]] T const* inverse(int I) const {
    return inverses_.data() + static_cast<std::size_t>(I) * size;
  }

  /// to ← to − Σ A_IJ L_KJᵀ over J < K.
  void subtract_products(int I, int K, T* to) {
    int const from = std::max(first(I), first(K));
    columns s[N];
    for (int c = 0; c < N; ++c) s[c] = columns::load(to + stride * c);
    T const* a = at(I, from);
    T const* l = at(K, from);
    for (int J = from; J < K; ++J, a += size, l += size) {
      unrolled<N>([&](auto c) __attribute__((always_inline)) {
        columns t = columns::zero();
        unrolled<N>([&](auto k) __attribute__((always_inline)) {
          t.add(columns::load(a + stride * k), l[stride * k + c]);
        });
        s[c] -= t;
      });
    }
    for (int c = 0; c < N; ++c) s[c].store_padded(to + stride * c);
  }

  /// L_IJ in the place of A_IJ, and A_II ← A_II − Σ A_IJ L_IJᵀ.
  void eliminate(int I) {
    columns s[N];
    for (int c = 0; c < N; ++c) s[c] = columns::load(at(I, I) + stride * c);
    for (int J = first(I); J < I; ++J) {
      T* const entries = at(I, J);
      T const* const d = inverse(J);
      columns a[N];
      for (int c = 0; c < N; ++c) a[c] = columns::load(entries + stride * c);
      unrolled<N>([&](auto c) __attribute__((always_inline)) {
        columns l = columns::zero();
        unrolled<N>([&](auto k) __attribute__((always_inline)) { l.add(a[k], d[stride * k + c]); });
        l.store_padded(entries + stride * c);
      });
      unrolled<N>([&](auto c) __attribute__((always_inline)) {
        columns t = columns::zero();
        unrolled<N>([&](auto k)
                        __attribute__((always_inline)) { t.add(a[k], entries[stride * k + c]); });
        s[c] -= t;
      });
    }
    for (int c = 0; c < N; ++c) s[c].store_padded(at(I, I) + stride * c);
  }

  envelope envelope_;
  std::vector<T> blocks_;    // L_IJ, m_I ≤ J ≤ I, by rows; columns of `stride` numbers
  std::vector<T> inverses_;  // D_I⁻¹
};

}  // namespace slant::detail
