// SPDX-License-Identifier: MIT
//
// P = (I − ω D⁻¹K) P₀, D = diag(K), ω = damping / λ_max(D⁻¹K): one step of Jacobi's method takes
// the energy out of the jumps between aggregates [Vaněk, Mandel, Brezina 1996].
//
// λ_max: a few Lanczos steps, raised by what they may have missed, or the bound of Gershgorin if
// that is smaller. A value too small would cost convergence, never definiteness.
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/krylov/spectral_bound.hpp>
#include <slant/multilevel/detail/tentative_prolongation.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::detail {

/// y = D^−½ K D^−½ x.
template <class S>
struct unit_diagonal_operator {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  row_major_sparse<S> const& k;
  vector_type root;  // D^−½

  [[nodiscard]] index rows() const { return k.rows(); }
  [[nodiscard]] index cols() const { return k.cols(); }
  struct room {
    vector_type scaled;
  };
  [[nodiscard]] room workspace(vector_type const&) const { return {vector_type(k.rows())}; }
  void apply(vector_type const& x, vector_type& y, room& w) const {
    w.scaled = root.cwiseProduct(x);
    y.noalias() = k * w.scaled;
    y.array() *= root.array();
  }
};

/// An estimate of λ_max(D⁻¹K) from above for a symmetric K with positive diagonal d.
template <class S, class V>
[[nodiscard]] S jacobi_eigenvalue(row_major_sparse<S> const& k, V const& d) {
  using std::abs;
  using std::sqrt;
  V root(d.size());
  for (index i = 0; i < d.size(); ++i) root[i] = S(1) / sqrt(d[i]);
  S gershgorin(0);
  for (index i = 0; i < k.rows(); ++i) {
    S sum(0);
    for (typename row_major_sparse<S>::InnerIterator e(k, i); e; ++e) {
      sum += abs(e.value()) * root[e.col()];
    }
    gershgorin = std::max<S>(gershgorin, sum * root[i]);
  }
  unit_diagonal_operator<S> const scaled{k, root};
  auto const lanczos = largest_eigenvalue_bound(scaled, root, {.steps = 12, .failure = 0.5});
  return std::min<S>(gershgorin, lanczos.upper);
}

/// P from P₀.
template <class S>
[[nodiscard]] row_major_sparse<S> smoothed_prolongation(row_major_sparse<S> const& k,
                                                        row_major_sparse<S> const& P0, S damping) {
  using std::sqrt;
  Eigen::Matrix<S, Eigen::Dynamic, 1> const d = k.diagonal();
  S const ω = damping / jacobi_eigenvalue(k, d);
  row_major_sparse<S> smooth = k * P0;
  for (index i = 0; i < smooth.rows(); ++i) {
    for (typename row_major_sparse<S>::InnerIterator e(smooth, i); e; ++e) {
      e.valueRef() *= -ω / d[i];
    }
  }
  row_major_sparse<S> P = P0 + smooth;
  // Of an aggregate without neighbours the damped step may leave nothing: it stays as it was.
  using columns = Eigen::Array<S, Eigen::Dynamic, 1>;
  auto const squares = [](row_major_sparse<S> const& m) {
    columns sums = columns::Zero(m.cols());
    for (index i = 0; i < m.rows(); ++i) {
      for (typename row_major_sparse<S>::InnerIterator e(m, i); e; ++e) {
        sums[e.col()] += e.value() * e.value();
      }
    }
    return sums;
  };
  S const enough = sqrt(std::numeric_limits<S>::epsilon());
  columns const keep = (squares(P) < enough * squares(P0)).template cast<S>();
  if ((keep > S(0)).any()) {
    for (index i = 0; i < smooth.rows(); ++i) {
      for (typename row_major_sparse<S>::InnerIterator e(smooth, i); e; ++e) {
        if (keep[e.col()] > S(0)) e.valueRef() = S(0);
      }
    }
    P = P0 + smooth;
  }
  P.makeCompressed();
  return P;
}

}  // namespace slant::detail
