// SPDX-License-Identifier: MIT
//
// Small vectors and matrices of fixed size, entry by entry. For Eigen every expression is a type of
// its own with all the members of a matrix, and one of two or three entries costs the compiler as
// much as one of a thousand. What is written here costs a function, and runs as fast: the loops are
// unrolled.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// The vector with the entries f(i), the matrix with the entries f(i, j). M is stored by columns.
template <class M, class F>
[[nodiscard]] M from_entries(F const& f) {
  constexpr int rows = M::RowsAtCompileTime;
  M m;
  auto* const entry = m.data();
  [&]<int... k>(std::integer_sequence<int, k...>) {
    if constexpr (std::is_invocable_v<F const&, int>) {
      ((entry[k] = f(k)), ...);
    } else {
      ((entry[k] = f(k % rows, k / rows)), ...);
    }
  }(std::make_integer_sequence<int, M::SizeAtCompileTime>{});
  return m;
}

/// f(0) + … + f(N − 1).
template <int N, class F>
[[nodiscard]] auto sum_of(F const& f) {
  using S = std::remove_cvref_t<decltype(f(0))>;
  return [&]<int... k>(std::integer_sequence<int, k...>) -> S {
    return (f(k) + ...);
  }(std::make_integer_sequence<int, N>{});
}

/// N entries from x on.
template <int N, class S>
[[nodiscard]] Eigen::Matrix<S, N, 1> entries_at(S const* x) {
  return from_entries<Eigen::Matrix<S, N, 1>>([&](int i) -> S const& { return x[i]; });
}
/// The entries of v to x and on.
template <class S, int N>
void put_entries(Eigen::Matrix<S, N, 1> const& v, S* x) {
  for (int i = 0; i < N; ++i) x[i] = v.data()[i];
}
/// Without the first entry.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N - 1, 1> tail_of(Eigen::Matrix<S, N, 1> const& v) {
  return entries_at<N - 1>(v.data() + 1);
}

/// a x, for a vector or matrix x.
template <class S, int R, int C>
  requires(R > 0 && C > 0)
[[nodiscard]] Eigen::Matrix<S, R, C> multiple_of(std::type_identity_t<S> const& a,
                                                 Eigen::Matrix<S, R, C> const& x) {
  Eigen::Matrix<S, R, C> product;
  for (int i = 0; i < R * C; ++i) product.data()[i] = a * x.data()[i];
  return product;
}
/// x / a.
template <class S, int R, int C>
  requires(R > 0 && C > 0)
[[nodiscard]] Eigen::Matrix<S, R, C> over(Eigen::Matrix<S, R, C> const& x,
                                          std::type_identity_t<S> const& a) {
  Eigen::Matrix<S, R, C> quotient;
  for (int i = 0; i < R * C; ++i) quotient.data()[i] = x.data()[i] / a;
  return quotient;
}
/// a x + b y.
template <class M>
  requires(M::SizeAtCompileTime > 0)
[[nodiscard]] M combination(typename M::Scalar const& a, M const& x, typename M::Scalar const& b,
                            M const& y) {
  using S = typename M::Scalar;
  M sum;
  for (int i = 0; i < M::SizeAtCompileTime; ++i)
    sum.data()[i] = S(a * x.data()[i] + b * y.data()[i]);
  return sum;
}
template <class S, int R, int C>
[[nodiscard]] bool all_zero(Eigen::Matrix<S, R, C> const& m) {
  return std::all_of(m.data(), m.data() + m.size(), [](S const& x) { return x == S(0); });
}
template <class S, int R, int C>
[[nodiscard]] bool all_finite(Eigen::Matrix<S, R, C> const& m) {
  return std::all_of(m.data(), m.data() + m.size(), is_finite<S>);
}
template <class S, int R, int C>
[[nodiscard]] bool has_nan(Eigen::Matrix<S, R, C> const& m) {
  return std::any_of(m.data(), m.data() + m.size(), [](S const& x) { return x != x; });
}

/// aᵀb.
template <class S, int N>
[[nodiscard]] S dot_of(Eigen::Matrix<S, N, 1> const& a, Eigen::Matrix<S, N, 1> const& b) {
  return sum_of<N>([&](int i) -> S { return a.data()[i] * b.data()[i]; });
}
/// max |a|, of a vector or matrix; NaN entries do not count.
template <class S, int R, int C>
[[nodiscard]] S largest_of(Eigen::Matrix<S, R, C> const& a) {
  S most(0);
  for (index i = 0; i < a.size(); ++i) {
    S const& entry = a.data()[i];
    S const size = entry < S(0) ? S(-entry) : entry;
    if (size > most) most = size;
  }
  return most;
}

/// A B, of which B may be a vector.
template <class S, int R, int K, int C>
[[nodiscard]] Eigen::Matrix<S, R, C> product_of(Eigen::Matrix<S, R, K> const& A,
                                                Eigen::Matrix<S, K, C> const& B) {
  S const* const a = A.data();
  S const* const b = B.data();
  Eigen::Matrix<S, R, C> product;
  for (int j = 0; j < C; ++j) {
    for (int i = 0; i < R; ++i) {
      product.data()[i + R * j] =
          sum_of<K>([&](int k) -> S { return a[i + R * k] * b[k + K * j]; });
    }
  }
  return product;
}
/// y += A x, x the entries from there on.
template <class S, int R, int K>
void add_product(Eigen::Matrix<S, R, K> const& A, S const* x, Eigen::Matrix<S, R, 1>& y) {
  S const* const a = A.data();
  [&]<int... i>(std::integer_sequence<int, i...>) {
    ((y.data()[i] += sum_of<K>([&](int k) -> S { return a[i + R * k] * x[k]; })), ...);
  }(std::make_integer_sequence<int, R>{});
}
/// Aᵀ x.
template <class S, int R, int C>
[[nodiscard]] Eigen::Matrix<S, C, 1> transposed_product(Eigen::Matrix<S, R, C> const& A,
                                                        Eigen::Matrix<S, R, 1> const& x) {
  return from_entries<Eigen::Matrix<S, C, 1>>([&](int j) -> S {
    return sum_of<R>([&](int i) -> S { return A.data()[i + R * j] * x.data()[i]; });
  });
}

// --- symmetric eigen -----------------------------------------------------------------------------
//
// Eigenvalues and eigenvectors of a small symmetric matrix by Jacobi's rotations: accurate to the
// last digits of each eigenvalue where Eigen's solver is so only to those of the largest, for any
// scalar, and quick to compile. One rotation does all for 2 × 2.

/// G = V diag(values) Vᵀ, the columns of V orthonormal. N may be Eigen::Dynamic.
template <class S, int N>
struct symmetric_eigen {
  Eigen::Matrix<S, N, 1> values;
  Eigen::Matrix<S, N, N> vectors;

  /// Of a symmetric g with finite entries. Does not allocate where N is a number.
  explicit symmetric_eigen(Eigen::Matrix<S, N, N> g) {
    index const n = g.rows();
    values.resize(n);
    vectors.resize(n, n);
    for (index k = 0; k < n * n; ++k) vectors.data()[k] = S(k % (n + 1) == 0 ? 1 : 0);
    for (int sweep = 0; sweep < 60 && rotate_all(g); ++sweep) {
    }
    for (index k = 0; k < n; ++k) values[k] = g.coeff(k, k);
  }

 private:
  /// One rotation for each pair whose entry is felt; false if there was none.
  bool rotate_all(Eigen::Matrix<S, N, N>& g) {
    using std::abs;
    using std::sqrt;
    index const n = g.rows();
    bool rotated = false;
    for (index p = 0; p < n; ++p) {
      for (index q = p + 1; q < n; ++q) {
        S const off = g.coeffRef(p, q);
        S const size = sqrt(S(abs(g.coeffRef(p, p)))) * sqrt(S(abs(g.coeffRef(q, q))));
        if (!(S(abs(off)) > std::numeric_limits<S>::epsilon() * size)) continue;
        rotated = true;
        S const θ = (g.coeffRef(q, q) - g.coeffRef(p, p)) / (S(2) * off);
        S const tangent = (θ < S(0) ? S(-1) : S(1)) / (S(abs(θ)) + S(sqrt(S(θ * θ + S(1)))));
        S const c = S(1) / S(sqrt(S(tangent * tangent + S(1))));
        S const s = tangent * c;
        auto const rotate = [&](S& a, S& b) {
          S const old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (index k = 0; k < n; ++k) rotate(g.coeffRef(k, p), g.coeffRef(k, q));
        for (index k = 0; k < n; ++k) rotate(g.coeffRef(p, k), g.coeffRef(q, k));
        for (index k = 0; k < n; ++k) rotate(vectors.coeffRef(k, p), vectors.coeffRef(k, q));
        g.coeffRef(p, q) = g.coeffRef(q, p) = S(0);
      }
    }
    return rotated;
  }
};

}  // namespace slant::detail
