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
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
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
    S const t = tangential_length(x);
    return (x[0] - t) * (x[0] + t);
  }
  [[nodiscard]] static S tangential_length(part const& x) {
    using std::sqrt;
    return sqrt(slant::detail::pairwise_squares<N - 1>(x.data() + 1));
  }
  /// x ∘ y = (xᵀy, x_0 y_t + y_0 x_t).
  [[nodiscard]] static part product(part const& x, part const& y) {
    part z = slant::detail::combination(x[0], y, y[0], x);
    z[0] = slant::detail::dot_of(x, y);
    return z;
  }
  /// y with x ∘ y = z.
  [[nodiscard]] static part quotient(part const& z, part const& x) {
    S const tangential =
        slant::detail::sum_of<N - 1>([&](int i) -> S { return x[i + 1] * z[i + 1]; });
    S const y0 = (x[0] * z[0] - tangential) / determinant(x);
    return slant::detail::from_entries<part>(
        [&](int i) -> S { return i == 0 ? y0 : S((z[i] - y0 * x[i]) / x[0]); });
  }
  /// J x = (x_0, −x_t).
  [[nodiscard]] static part reflected(part const& x) {
    return slant::detail::from_entries<part>([&](int i) -> S { return i == 0 ? x[i] : S(-x[i]); });
  }
  /// 2 v vᵀ − J.
  [[nodiscard]] static block hyperbolic(part const& v) {
    return slant::detail::from_entries<block>([&](int i, int j) -> S {
      S const J = i != j ? S(0) : i == 0 ? S(1) : S(-1);
      return S(2) * v[i] * v[j] - J;
    });
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
    using slant::detail::from_entries;
    using std::sqrt;
    S const λ = sqrt(x0 * s0), T = sqrt(η_);
    λ_ = from_entries<part>([&](int i) { return i == 0 ? λ : S(0); });
    factor(from_entries<block>([&](int i, int j) { return i == j ? T : S(0); }));
  }

  [[nodiscard]] part const& λ() const { return λ_; }
  [[nodiscard]] part x() const {
    part const y = slant::detail::transposed_product(U_, λ_);
    return slant::detail::product_of(
        V_, slant::detail::from_entries<part>([&](int i) -> S { return y[i] / Σ_[i]; }));
  }
  [[nodiscard]] part s() const { return adjoint(λ_); }
  /// Tᵀ y.
  [[nodiscard]] part adjoint(part const& y) const {
    part const z = slant::detail::transposed_product(U_, y);
    return slant::detail::product_of(
        V_, slant::detail::from_entries<part>([&](int i) -> S { return z[i] * Σ_[i]; }));
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
    using slant::detail::combination;
    using slant::detail::product_of;
    using std::sqrt;
    part const x = combination(S(1), λ_, S(1), dx), s = combination(S(1), λ_, S(1), ds);
    S const x_length = sqrt(cone::determinant(x)), s_length = sqrt(cone::determinant(s));
    part const x1 = over(x, x_length), s1 = over(s, s_length);
    part const w = over(combination(S(1), s1, S(1), cone::reflected(x1)),
                        sqrt(S(2) * (S(1) + slant::detail::dot_of(x1, s1))));
    part v = w;
    v[0] += S(1);
    v = over(v, sqrt(S(2) * (w[0] + S(1))));
    S const β = sqrt(s_length / x_length);
    block const step = slant::detail::multiple_of(β, cone::hyperbolic(v));
    λ_ = product_of(step, x);
    η_ *= β * β;
    factor(product_of(
        product_of(step, U_),
        slant::detail::from_entries<block>([&](int i, int j) -> S { return Σ_[i] * V_(j, i); })));
  }

 private:
  [[nodiscard]] static part over(part const& x, S const& a) {
    return slant::detail::from_entries<part>([&](int i) -> S { return x[i] / a; });
  }
  /// TᵀT = η (2 w wᵀ − J) with w_0² − ‖w_t‖² = 1, so that Σ² / η is k² = (w_0 + ‖w_t‖)², 1/k² and
  /// 1: on the light rays (1, ±w_t/‖w_t‖), and across. TᵀT e has the tangential part 2 η w_0 w_t.
  void factor(block const& T) {
    using slant::detail::entries_at;
    using std::sqrt;
    part const z = slant::detail::transposed_product(T, entries_at<N>(T.data()));
    S const h = cone::tangential_length(z) / η_;
    S const k = sqrt(h + sqrt(S(1) + h * h));
    V_ = frame(z);
    U_ = frame(slant::detail::product_of(T, entries_at<N>(V_.data())));
    S const middle = sqrt(η_);
    Σ_ = slant::detail::from_entries<part>([&](int i) -> S {
      return i == 0 ? middle * k : i == 1 ? middle / k : middle;
    });
  }
  /// (1, d), (1, −d) over √2 and (0, d⊥), d the direction of x_t.
  [[nodiscard]] static block frame(part const& x) {
    using std::sqrt;
    S const t = cone::tangential_length(x), half = sqrt(S(0.5));
    part const d = slant::detail::from_entries<part>([&](int i) -> S {
      if (i == 0) return S(0);
      return t > S(0) ? S(x[i] / t) : S(i == 1 ? 1 : 0);
    });
    return slant::detail::from_entries<block>([&](int i, int j) -> S {
      if (j == 2) return i == 0 ? S(0) : i == 1 ? S(-d[N - 1]) : d[1];
      if (i == 0) return half;
      return j == 0 ? half * d[i] : -half * d[i];
    });
  }

  part λ_;
  S η_;  ///< T J Tᵀ = η J
  block U_, V_;
  part Σ_;
};

}  // namespace slant::contact::detail
