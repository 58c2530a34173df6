// SPDX-License-Identifier: MIT
//
// The projection onto separable and equality constraints together,
//
//     minimise  ½ ‖y − z‖²   over   y ∈ Λ = Λ₁ × … × Λ_m,   N y = n,
//
// by its dual problem, which has as many unknowns as there are equations:
//
//     minimise  θ(m) = ½ ‖z − Nᵀm‖² − ½ dist²(z − Nᵀm, Λ) + nᵀm,     ∇θ(m) = n − N P_Λ(z − Nᵀm)
//
// θ is convex with a slanting Hessian N G Nᵀ, G the slanting operator of P_Λ. Newton's method with
// the term λ I, λ of the size of the residual: where a face leaves an equation nothing to act on,
// the step is as long as z is far from Λ, or Λ and n are large, and leaves that face. It is halved
// while it ends beyond the minimum along it, at a slope of more than half the first.
//
// Where no point of Λ satisfies N y = n, θ is unbounded and there is no result.
//
// Cost: a dense factorisation of the size of N Nᵀ a step, no operator of the problem. Hintermüller,
// Ito, Kunisch, SIAM J. Optim. 13 (2002); regularised as in Qi, Sun, SIAM J. Matrix Anal. 28
// (2006).
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace slant {

/// The projection at the top of this file, for rows of N of length 1, n = N x̄ and Eigen vectors.
template <class S>
class constrained_projection {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  vector_type point;   ///< y
  vector_type normal;  ///< Nᵀm: y = P_Λ(z − Nᵀm)
  vector_type base;    ///< z − Nᵀm

  /// Room for N; allocates.
  explicit constrained_projection(sparse_type const& N)
      : point(N.cols()),
        normal(N.cols()),
        base(N.cols()),
        hessian_(N.rows(), N.rows()),
        factors_(N.rows()),
        step_(N.rows()),
        residual_(N.rows()),
        along_(N.cols()),
        trial_(N.cols()) {}

  /// point, normal and base for z. False if none was found. Allocates nothing but what a large
  /// dense factorisation needs for itself.
  template <class Set>
  [[nodiscard]] bool compute(Set const& set, sparse_type const& N, vector_type const& nearest,
                             vector_type const& z) {
    using std::sqrt;
    S const ε = std::numeric_limits<S>::epsilon();
    S const room = S(4) * ε * sqrt(S(z.size()));
    S const of_nearest = slant::norm(nearest);
    base = z;
    evaluate(set, N, nearest, base);
    S violation = slant::norm(residual_), size(0);
    for (int k = 0; k < most_steps; ++k) {
      size = std::max<S>(slant::norm(point), of_nearest);
      if (!detail::is_finite(violation)) return false;
      if (violation <= room * size) break;
      add_up_hessian(set, N);
      trial_ = base - point;
      S const reach = std::max<S>(size, slant::norm(trial_));
      if (!factor(S(1e-3) * (violation / std::max<S>(reach, violation)))) return false;
      step_ = residual_ / violation;
      factors_.solveInPlace(step_);
      step_ *= violation;
      if (!search(set, N, nearest)) break;
      S const left = slant::norm(residual_);
      bool const is_slow = !(left < violation / S(2));
      violation = left;
      if (is_slow && violation <= S(8) * room * size) break;
    }
    normal = z - base;
    return violation <= S(8) * room * size;
  }

 private:
  static constexpr int most_steps = 100;

  /// y = P_Λ(base) and residual = N y − n.
  template <class Set>
  void evaluate(Set const& set, sparse_type const& N, vector_type const& nearest,
                vector_type const& at) {
    slant::project(set, at, point);
    normal = point - nearest;
    residual_.noalias() = N * normal;
  }

  /// The base along the step; false, and unchanged, if no length will do. The base itself is kept,
  /// not m: so rounding errors of z and Nᵀm, which may be large, do not enter the equations.
  template <class Set>
  bool search(Set const& set, sparse_type const& N, vector_type const& nearest) {
    // In units of both, so that no product leaves the range.
    S const unit = slant::norm(residual_), length = slant::norm(step_);
    auto const slope = [&] { return S((residual_ / unit).dot(step_ / length)); };
    S const first = slope();
    along_.noalias() = N.transpose() * step_;
    S β(1);
    for (int j = 0; first > S(0) && j < 60; ++j, β /= S(2)) {
      trial_ = base - β * along_;
      evaluate(set, N, nearest, trial_);
      if (slope() >= -first / S(2)) {
        base = trial_;
        return true;
      }
    }
    evaluate(set, N, nearest, base);
    return false;
  }

  /// N G Nᵀ + λ I, with a larger λ where that is not definite up to rounding.
  [[nodiscard]] bool factor(S λ) {
    λ = std::max<S>(λ, S(4) * std::numeric_limits<S>::epsilon());
    for (; λ < S(1); λ *= S(16)) {
      hessian_.diagonal().array() += λ;
      factors_.compute(hessian_);
      if (factors_.info() == Eigen::Success) return true;
    }
    return false;
  }

  /// N G Nᵀ at the base.
  template <class Set>
  void add_up_hessian(Set const& set, sparse_type const& N) {
    hessian_.setZero();
    auto const add = [&](index i, index j, S const& value) {
      for (typename sparse_type::InnerIterator a(N, i); a; ++a) {
        for (typename sparse_type::InnerIterator b(N, j); b; ++b) {
          hessian_(a.row(), b.row()) += value * a.value() * b.value();
        }
      }
    };
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (whole_space<block_type>) {
        for (index j = 0; j < p.size(); ++j) add(p.component(j), p.component(j), S(1));
      } else {
        Eigen::Matrix<S, block_type::dimension, block_type::dimension> const g =
            block.slant(p.value(base));
        for (index j = 0; j < p.size(); ++j) {
          for (index l = 0; l < p.size(); ++l) {
            if (g(j, l) != S(0)) add(p.component(j), p.component(l), g(j, l));
          }
        }
      }
    });
  }

  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  dense_type hessian_;
  Eigen::LLT<dense_type> factors_;
  vector_type step_, residual_, along_, trial_;
};

}  // namespace slant
