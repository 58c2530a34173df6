// SPDX-License-Identifier: MIT
//
// Smoothed aggregation [Vaněk, Mandel, Brezina 1996]: a coarse level from the entries of a matrix.
// Nodes that are strongly coupled become one node of the coarse level (Algorithm 2),
//
//     1  a node whose strong neighbours are all unassigned becomes, with them, an aggregate
//     2  what is left joins the aggregate of step 1 that it is coupled to most strongly
//     3  what is left still becomes aggregates of neighbours
//
// on each of which the near kernel B of the matrix is made orthonormal, B = Q R (Algorithm 1). Q is
// what the coarse unknowns of the aggregate stand for, R the near kernel of the coarse level. One
// step of Jacobi's method takes the energy out of the jumps between aggregates,
//
//     P = (I − ω D⁻¹A) Q,     ω = damping / λ_max(D⁻¹A),     D the diagonal blocks.
//
// Nodes i and j are strongly coupled if ‖A_ij‖² > θ² ‖A_ii‖ ‖A_jj‖ in the norm of Frobenius: what is
// coupled weakly, as across a soft layer, cannot be corrected by one coarse unknown. A node without
// strong neighbours takes those with θ = 0.02; one that has none of these either has no part in the
// coarse level, because sweeps of Gauss–Seidel reach it.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/lanes.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant {

/// Which aggregate each node belongs to.
struct aggregation {
  std::vector<int> of;  ///< one entry per node; −1: none
  index count = 0;      ///< number of aggregates
};

/// Aggregates of the nodes of A; θ ≥ 0 as at the top of this file.
template <int N, class T>
[[nodiscard]] aggregation aggregate(block_matrix<N, T> const& A, double θ) {
  auto const n = static_cast<std::size_t>(A.nodes());
  // In units of the row: bodies may be 1e-20 times as stiff as others.
  auto const square = [](T const* block, T const& unit) {
    T s(0);
    for (int k = 0; k < N * N; ++k) s += (block[k] * unit) * (block[k] * unit);
    return s;
  };
  std::vector<T> unit(n), size(n);  // 1/‖A_ii‖, about; ‖A_ii‖
  for (int i = 0; i < A.nodes(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    T const* const D = A.diagonal(i);
    T most(0);
    for (int c = 0; c < N; ++c) most = std::max<T>(most, D[(N + 1) * c]);
    using std::sqrt;
    unit[at] = T(1) / unit_near(most);
    size[at] = T(sqrt(square(D, unit[at]))) / unit[at];
  }
  // Strong neighbours and ‖A_ij‖²/‖A_jj‖, in that unit.
  std::vector<int> first{0}, neighbour;
  std::vector<T> strength;
  neighbour.reserve(static_cast<std::size_t>(A.blocks()));
  strength.reserve(static_cast<std::size_t>(A.blocks()));
  for (int i = 0; i < A.nodes(); ++i) {
    auto const gather = [&](double least) {
      T const u = unit[static_cast<std::size_t>(i)];
      T const limit = T(least) * T(least) * (size[static_cast<std::size_t>(i)] * u);
      A.for_each_in_row(i, [&](int j, T const* block) {
        T const other = size[static_cast<std::size_t>(j)] * u;
        T const s = square(block, u);
        if (j == i || !(s > limit * other)) return;
        neighbour.push_back(j);
        strength.push_back(s / other);
      });
    };
    gather(θ);
    // A sweep divides errors by 50 where couplings are below 0.02; others need a coarse level.
    if (static_cast<int>(neighbour.size()) == first.back() && θ > 0.02) gather(0.02);
    first.push_back(static_cast<int>(neighbour.size()));
  }
  auto const neighbours = [&](std::size_t i, auto f) {
    for (int e = first[i]; e < first[i + 1]; ++e) {
      f(neighbour[static_cast<std::size_t>(e)], strength[static_cast<std::size_t>(e)]);
    }
  };
  aggregation a{std::vector<int>(n, -1), 0};
  auto const open = [&](std::size_t i) {
    a.of[i] = static_cast<int>(a.count);
    neighbours(i, [&](int j, T) {
      int& of = a.of[static_cast<std::size_t>(j)];
      if (of < 0) of = static_cast<int>(a.count);
    });
    ++a.count;
  };
  for (std::size_t i = 0; i < n; ++i) {
    bool free = a.of[i] < 0 && first[i] < first[i + 1];
    for (int e = first[i]; free && e < first[i + 1]; ++e) {
      free = a.of[static_cast<std::size_t>(neighbour[static_cast<std::size_t>(e)])] < 0;
    }
    if (free) open(i);
  }
  std::vector<int> const seeds = a.of;
  for (std::size_t i = 0; i < n; ++i) {
    if (a.of[i] >= 0) continue;
    T strongest(0);
    neighbours(i, [&](int j, T s) {
      int const there = seeds[static_cast<std::size_t>(j)];
      if (there < 0 || !(s > strongest)) return;
      strongest = s;
      a.of[i] = there;
    });
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (a.of[i] < 0 && first[i] < first[i + 1]) open(i);
  }
  return a;
}

}  // namespace slant

namespace slant::detail {

/// To which coarse node each node owes most, the first one of several; −1 for a row without entries.
template <int N, class T>
[[nodiscard]] aggregation heaviest_parents(prolongation<N, N, T> const& P) {
  aggregation a{std::vector<int>(static_cast<std::size_t>(P.nodes()), -1), P.coarse_nodes};
  for (int i = 0; i < P.nodes(); ++i) {
    T most(0);
    for (int e = P.begin(i); e < P.end(i); ++e) {
      T size(0);
      for (int k = 0; k < (P.weights ? 1 : N * N); ++k) {
        T const entry = P.weights ? P.weight(e) : P.block(e)[k];
        size += entry * entry;
      }
      if (!(size > T(1.001) * most)) continue;  // rounding breaks no ties
      most = size;
      a.of[static_cast<std::size_t>(i)] = P.at(e);
    }
  }
  return a;
}

/// The motions of rigid bodies, n × 3 in the plane and n × 6 in space, of unknowns that are
/// components axis(j) of the nodes node(j), columns of `nodes`: translations, and rotations about the
/// centre of the nodes in units of their extent.
template <class S, class M, class Node, class Axis>
[[nodiscard]] Eigen::MatrixX<S> rigid_motions(Eigen::MatrixBase<M> const& nodes, index n, Node node,
                                              Axis axis) {
  using scalar = typename M::Scalar;
  index const D = nodes.rows();
  Eigen::VectorX<scalar> const most = nodes.rowwise().maxCoeff();
  Eigen::VectorX<scalar> const least = nodes.rowwise().minCoeff();
  scalar const extent = unit_near((most / 2 - least / 2).maxCoeff());
  Eigen::MatrixX<S> R = Eigen::MatrixX<S>::Zero(n, D == 2 ? 3 : 6);
  for (index j = 0; j < n; ++j) {
    auto const x = [&](index c) {
      return S(scalar(scalar(nodes(c, node(j)) - least[c] / 2 - most[c] / 2) / extent));
    };
    R(j, axis(j)) = S(1);
    index mode = D;
    for (index a = 0; a < D; ++a) {  // the rotation in the plane of the axes a and b
      for (index b = a + 1; b < D; ++b, ++mode) {
        if (axis(j) == a) R(j, mode) = -x(b);
        if (axis(j) == b) R(j, mode) = x(a);
      }
    }
  }
  return R;
}

/// Candidates of the near kernel: M motions of nodes of N unknowns, an N × M block by rows for each
/// node. In double, because rotations about a point far away differ little from translations.
template <int N, int M>
struct near_kernel {
  std::vector<double> blocks;

  [[nodiscard]] double const* at(int i) const {
    return blocks.data() + static_cast<std::size_t>(i) * (N * M);
  }
};

/// A := LLᵀ = RᵀR, a (M × M by columns) becomes R by rows, with a zero row for a candidate that
/// depends on those before it; `inverse` R⁻¹ by rows, without those rows and columns.
template <int M>
void cholesky_of_candidates(double* a, double* inverse) {
  // A candidate keeps some 1e-16 of its square when what it has in common with others is taken out.
  double const least = 4096 * std::numeric_limits<double>::epsilon();
  double R[M * M] = {}, X[M * M] = {};
  for (int c = 0; c < M; ++c) {
    double d = a[M * c + c];
    for (int k = 0; k < c; ++k) d -= R[M * k + c] * R[M * k + c];
    if (!(d > least * a[M * c + c])) continue;
    double const root = std::sqrt(d);
    R[M * c + c] = root;
    for (int j = c + 1; j < M; ++j) {
      double s = a[M * j + c];
      for (int k = 0; k < c; ++k) s -= R[M * k + c] * R[M * k + j];
      R[M * c + j] = s / root;
    }
  }
  for (int j = 0; j < M; ++j) {
    if (R[M * j + j] == 0) continue;
    X[M * j + j] = 1 / R[M * j + j];
    for (int i = j - 1; i >= 0; --i) {
      if (R[M * i + i] == 0) continue;
      double s = 0;
      for (int k = i + 1; k <= j; ++k) s += R[M * i + k] * X[M * k + j];
      X[M * i + j] = -s / R[M * i + i];
    }
  }
  std::copy(R, R + M * M, a);
  std::copy(X, X + M * M, inverse);
}

/// Q of all nodes, N × M blocks by rows, and the near kernel R of the aggregates.
template <int N, int M, class T>
[[nodiscard]] std::vector<T> orthonormal_candidates(aggregation const& a,
                                                    near_kernel<N, M> const& B,
                                                    near_kernel<M, M>& R) {
  auto const n = a.of.size();
  R.blocks.assign(static_cast<std::size_t>(a.count) * M * M, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (a.of[i] < 0) continue;
    double const* const b = B.at(static_cast<int>(i));
    double* const gram = R.blocks.data() + static_cast<std::size_t>(a.of[i]) * (M * M);
    for (int c = 0; c < M; ++c) {
      for (int k = c; k < M; ++k) {
        double s = 0;
        for (int q = 0; q < N; ++q) s += b[M * q + c] * b[M * q + k];
        gram[M * k + c] += s;
      }
    }
  }
  std::vector<double> inverses(R.blocks.size());
  for (index g = 0; g < a.count; ++g) {
    auto const at = static_cast<std::size_t>(g) * (M * M);
    cholesky_of_candidates<M>(R.blocks.data() + at, inverses.data() + at);
  }
  std::vector<T> Q(n * N * M + prolongation<N, M, T>::beyond, T(0));
  for (std::size_t i = 0; i < n; ++i) {
    if (a.of[i] < 0) continue;
    double const* const b = B.at(static_cast<int>(i));
    double const* const x = inverses.data() + static_cast<std::size_t>(a.of[i]) * (M * M);
    for (int q = 0; q < N; ++q) {
      for (int c = 0; c < M; ++c) {
        double s = 0;
        for (int k = 0; k <= c; ++k) s += b[M * q + k] * x[M * k + c];
        Q[(i * N + static_cast<std::size_t>(q)) * M + static_cast<std::size_t>(c)] = T(s);
      }
    }
  }
  return Q;
}

/// λ_max(D⁻¹A) within a few percent, by the power method and the quotient of Rayleigh; D given by
/// its inverses as for the sweeps. At least 1, the mean of the eigenvalues. The start is random as a
/// vector; in_any_units: about as random in √D x, so that soft bodies are seen beside stiff ones. x,
/// y: scratch, block vectors.
template <int N, class T>
[[nodiscard]] T largest_jacobi_eigenvalue(block_matrix<N, T> const& A, T const* inverses,
                                          std::vector<T>& x, std::vector<T>& y, bool in_any_units) {
  constexpr int stride = block_matrix<N, T>::stride;
  constexpr int steps = 8;
  unsigned random = 1;
  for (std::size_t k = 0; k < x.size(); ++k) {
    random = random * 1664525u + 1013904223u;  // [Knuth 1997, 3.3.4, table 1]
    x[k] = static_cast<int>(k % stride) < N ? T(random >> 8) / T(1 << 23) - T(1) : T(0);
  }
  for (std::size_t i = 0; in_any_units && i < x.size(); i += stride) {
    for (std::size_t c = 0; c < N; ++c) {
      x[i + c] *= T(std::sqrt(static_cast<double>(inverses[i * N + stride * c + c])));
    }
  }
  T λ(1);
  for (int step = 0; step < steps; ++step) {
    // y holds D x from the second step on.
    auto const dot = [&] {
      double sum = 0;
      for (int i = 0; i < A.nodes(); ++i) {
        T s(0);
        for (int c = 0; c < N; ++c) {
          auto const k = static_cast<std::size_t>(i) * stride + static_cast<std::size_t>(c);
          s += x[k] * y[k];
        }
        sum += static_cast<double>(s);
      }
      return sum;
    };
    double const xDx = step == 0 ? 0.0 : dot();
    A.multiply(x.data(), y.data());
    double const xAx = dot();
    if (step > 0 && xDx > 0) λ = std::max<T>(T(1), T(xAx / xDx));
    if (!(xAx > 0)) return λ;
    T const scale = T(1 / std::sqrt(xAx));
    for (int i = 0; i < A.nodes(); ++i) {
      auto const k = static_cast<std::size_t>(i) * stride;
      using columns = lanes<T, N>;
      columns z = columns::zero(), image = columns::zero();
      image.add(y.data() + k, scale);
      image.store_padded(y.data() + k);
      unrolled<N>([&](auto c) __attribute__((always_inline)) {
        z.add(inverses + k * N + stride * c, image[c]);
      });
      z.store_padded(x.data() + k);
    }
  }
  return λ;
}

/// P = (I − ω D⁻¹A) Q for the candidates Q of aggregates; ω = 0: P = Q.
template <int N, int M, class T>
[[nodiscard]] prolongation<N, M, T> smoothed_prolongation(block_matrix<N, T> const& A,
                                                          T const* inverses, aggregation const& a,
                                                          std::vector<T> const& Q, T ω) {
  using wide = lanes<T, M>;
  constexpr int stride = block_matrix<N, T>::stride;
  constexpr std::size_t size = N * M;
  prolongation<N, M, T> P;
  P.coarse_nodes = static_cast<int>(a.count);
  P.first.reserve(a.of.size() + 1);
  P.column.reserve(a.of.size() * 4);
  P.entries.reserve(a.of.size() * 4 * size);
  std::vector<int> place(static_cast<std::size_t>(a.count), -1), list;
  std::vector<wide> sums;  // −ω (A Q)_iJ, N lanes for each J
  for (int i = 0; i < A.nodes(); ++i) {
    int const own = a.of[static_cast<std::size_t>(i)];
    if (own >= 0) {
      list.clear();
      A.for_each_in_row(i, [&](int j, T const* block) {
        int const J = a.of[static_cast<std::size_t>(j)];
        if (J < 0 || (J != own && ω == T(0))) return;
        int& at = place[static_cast<std::size_t>(J)];
        if (at < 0) {
          at = static_cast<int>(list.size()) * N;
          list.push_back(J);
          if (sums.size() < list.size() * N) sums.resize(list.size() * N);
          for (int q = 0; q < N; ++q) sums[static_cast<std::size_t>(at + q)] = wide::zero();
        }
        wide* const to = sums.data() + at;
        T const* const from = Q.data() + static_cast<std::size_t>(j) * size;
        unrolled<N>([&](auto k) __attribute__((always_inline)) {
          wide const row = wide::load(from + M * k);
          unrolled<N>([&](auto q) __attribute__((always_inline)) {
            to[q].add(row, -ω * block[N * k + q]);
          });
        });
      });
      std::sort(list.begin(), list.end());
      T const* const inverse = inverses + static_cast<std::size_t>(i) * (N * stride);
      for (int const J : list) {
        wide const* const from = sums.data() + place[static_cast<std::size_t>(J)];
        std::size_t const at = P.entries.size();
        P.column.push_back(J);
        P.entries.resize(at + size);
        for (int q = 0; q < N; ++q) {
          wide s = wide::zero();
          if (J == own) {
            s = wide::load(Q.data() + static_cast<std::size_t>(i) * size +
                           static_cast<std::size_t>(M * q));
          }
          for (int k = 0; k < N; ++k) s.add(from[k], inverse[stride * k + q]);
          s.store(P.entries.data() + at + static_cast<std::size_t>(M * q));
        }
        place[static_cast<std::size_t>(J)] = -1;
      }
    }
    P.first.push_back(static_cast<int>(P.column.size()));
  }
  P.entries.resize(P.entries.size() + prolongation<N, M, T>::beyond, T(0));
  return P;
}

}  // namespace slant::detail
