// SPDX-License-Identifier: MIT
//
// The Lorentz cone L = {x : ‖x_t‖ <= x_0} in N dimensions as interior-point methods see it: its
// Jordan algebra, and the scaling of Nesterov and Todd ("Self-scaled barriers and interior-point
// methods for convex programming", 1997) for a pair x, s inside of it,
//
//     T x = T⁻ᵀ s = λ,    T L = L,    xᵀs = λᵀλ.
//
// Near the boundary x_0 − ‖x_t‖ has no digits left. So x and s are no data here, but T⁻¹λ and Tᵀλ:
// a step is made from λ, which is well inside, and T is multiplied by the scaling of what the step
// has made of λ (Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010, §5).
// T is kept by its singular values, which are known in closed form: its smallest would be lost
// beside its largest, and T⁻¹ no longer be its inverse.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace slant::contact::detail {

/// The algebra of L: e = (1, 0) is its unit, L the squares in it.
template <int N, class S>
struct lorentz {
  using part = Eigen::Matrix<S, N, 1>;
  using block = Eigen::Matrix<S, N, N>;

  /// x_0² − ‖x_t‖².
  [[nodiscard]] static S determinant(part const& x) {
    S const t = x.template tail<N - 1>().norm();
    return (x[0] - t) * (x[0] + t);
  }
  /// x ∘ y = (xᵀy, x_0 y_t + y_0 x_t).
  [[nodiscard]] static part product(part const& x, part const& y) {
    part z = x[0] * y + y[0] * x;
    z[0] = x.dot(y);
    return z;
  }
  /// y with x ∘ y = z.
  [[nodiscard]] static part quotient(part const& z, part const& x) {
    S const tangential = x.template tail<N - 1>().dot(z.template tail<N - 1>());
    S const y0 = (x[0] * z[0] - tangential) / determinant(x);
    part y = (z - y0 * x) / x[0];
    y[0] = y0;
    return y;
  }
  /// J x = (x_0, −x_t).
  [[nodiscard]] static part reflected(part const& x) {
    part y = -x;
    y[0] = x[0];
    return y;
  }
  /// 2 v vᵀ − J.
  [[nodiscard]] static block hyperbolic(part const& v) {
    block h = S(2) * v * v.transpose();
    h(0, 0) -= S(1);
    for (int k = 1; k < N; ++k) h(k, k) += S(1);
    return h;
  }
};

/// A pair x, s as λ and T = U diag(Σ) Vᵀ.
template <int N, class S>
class lorentz_scaling {
 public:
  using cone = lorentz<N, S>;
  using part = typename cone::part;
  using block = typename cone::block;

  /// x = x0 e, s = s0 e; x0, s0 > 0.
  lorentz_scaling(S const& x0, S const& s0) : η_(s0 / x0) {
    using std::sqrt;
    λ_ = sqrt(x0 * s0) * part::Unit(0);
    factor(sqrt(η_) * block::Identity());
  }

  [[nodiscard]] part const& λ() const { return λ_; }
  [[nodiscard]] part x() const { return V_ * (U_.transpose() * λ_).cwiseQuotient(Σ_); }
  [[nodiscard]] part s() const { return adjoint(λ_); }
  /// Tᵀ y.
  [[nodiscard]] part adjoint(part const& y) const {
    return V_ * (U_.transpose() * y).cwiseProduct(Σ_);
  }
  [[nodiscard]] block const& U() const { return U_; }
  [[nodiscard]] block const& V() const { return V_; }
  [[nodiscard]] part const& Σ() const { return Σ_; }

  /// How far λ + t dx and λ + t ds are both in the cone.
  [[nodiscard]] S length(part const& dx, part const& ds) const {
    second_order_cone<N, S> const L(S(1));
    return std::min(L.step_to_boundary(λ_, dx), L.step_to_boundary(λ_, ds));
  }
  /// x and s move by T⁻¹dx and Tᵀds; both stay inside of the cone.
  void move(part const& dx, part const& ds) {
    using std::sqrt;
    part const x = λ_ + dx, s = λ_ + ds;
    S const x_length = sqrt(cone::determinant(x)), s_length = sqrt(cone::determinant(s));
    part const x1 = x / x_length, s1 = s / s_length;
    part const w = (s1 + cone::reflected(x1)) / sqrt(S(2) * (S(1) + x1.dot(s1)));
    part v = w;
    v[0] += S(1);
    v /= sqrt(S(2) * (w[0] + S(1)));
    S const β = sqrt(s_length / x_length);
    block const step = β * cone::hyperbolic(v);
    λ_ = step * x;
    η_ *= β * β;
    factor(step * U_ * Σ_.asDiagonal() * V_.transpose());
  }

 private:
  /// TᵀT = η (2 w wᵀ − J) with w_0² − ‖w_t‖² = 1, so that Σ² / η is k² = (w_0 + ‖w_t‖)², 1/k² and
  /// 1: on the light rays (1, ±w_t/‖w_t‖), and across. TᵀT e has the tangential part 2 η w_0 w_t.
  void factor(block const& T) {
    using std::sqrt;
    part const z = T.transpose() * T.col(0);
    S const h = z.template tail<N - 1>().norm() / η_;
    S const k = sqrt(h + sqrt(S(1) + h * h));
    V_ = frame(z);
    U_ = frame(T * V_.col(0));
    Σ_.setConstant(sqrt(η_));
    Σ_[0] *= k;
    Σ_[1] /= k;
  }
  /// (1, d), (1, −d) over √2 and (0, d⊥), d the direction of x_t.
  [[nodiscard]] static block frame(part const& x) {
    using std::sqrt;
    using tangential = Eigen::Matrix<S, N - 1, 1>;
    tangential d = x.template tail<N - 1>();
    S const t = d.norm(), half = sqrt(S(0.5));
    d = t > S(0) ? tangential(d / t) : tangential(tangential::Unit(0));
    block f = block::Zero();
    f(0, 0) = f(0, 1) = half;
    f.col(0).template tail<N - 1>() = half * d;
    f.col(1).template tail<N - 1>() = -half * d;
    if constexpr (N == 3) f.col(2) << S(0), -d[1], d[0];
    return f;
  }

  part λ_;
  S η_;  ///< T J Tᵀ = η J
  block U_, V_;
  part Σ_;
};

}  // namespace slant::contact::detail
