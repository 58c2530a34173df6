// SPDX-License-Identifier: MIT
//
// The second-order cone { (x_n, x_t) : ‖x_t‖ <= μ x_n }: normal pressure and Coulomb friction
// together.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>
#include <slant/sets/parts/cone_projection.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace slant {

/// { x ∈ R^N : ‖x_t‖ <= μ x_n }, x_n = x₀ the axis, x_t = (x₁, …); μ >= 0 is finite.
///
/// μ = 0 is the ray along the axis. Every component of the projection is within 4 ulp at any scale
/// and for any μ (components below the smallest normal number excepted); see
/// parts/cone_projection.hpp. "On the mantle" means | ‖x_t‖ − μ x_n | <= 8 ε μ x_n, ε the machine
/// epsilon. The apex is 0 only: a cone has no length with which "nearly 0" could be measured. NaN
/// in, NaN out; so does an infinite component.
template <int N, scalar S = double>
  requires(N >= 2)
class second_order_cone {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr int inequalities = 2;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  second_order_cone() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit second_order_cone(S const& mu) : mu_(mu) {
    if (!(mu >= S(0) && detail::is_finite(mu))) {
      throw bad_input("mu", detail::show(mu), "a finite number >= 0");
    }
  }

  [[nodiscard]] second_order_cone with(S const& mu) const { return second_order_cone(mu); }
  [[nodiscard]] S const& mu() const { return mu_; }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    detail::nearest_on_cone<S, N>(mu_, v).move(v);
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    return ratio_at_most(x, S(1) + detail::rounding_band<S>());
  }

  /// For x in the set: fixed at the apex, sliding on the mantle (for μ = 0 on the ray), else free.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    if (!(v(0) > S(0))) return block_state::fixed;
    bool const inside = mu_ > S(0) && ratio_at_most(v, S(1) - detail::rounding_band<S>());
    return inside ? block_state::free : block_state::sliding;
  }

  /// Slanting operator of the projection at x.
  ///
  ///     ‖x_t‖ <= μ x_n        I                                (mantle and apex included)
  ///     x_n + μ‖x_t‖ <= 0     0                                (the polar cone, apex excluded)
  ///     otherwise             w wᵀ + θ (0 ⊕ (I − e eᵀ)),       e = x_t/‖x_t‖,
  ///
  /// where w = (1, μe)/√(1 + μ²) is the generator through p and θ = μ p_n/‖x_t‖ ∈ [0, 1]:
  /// differentiate p = w wᵀx with de = (I − eeᵀ) dx_t/‖x_t‖. For μ = 0, where there is no interior,
  /// the derivative e₀e₀ᵀ of the projection to the ray stands for I.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    auto const foot = detail::nearest_on_cone<S, N>(mu_, v);
    if (foot.region == detail::cone_region::mantle) {
      return detail::mantle_slant<S, N>(mu_, foot, v);
    }
    matrix_type G = matrix_type::Zero();
    if (foot.region == detail::cone_region::undefined) G.setConstant(detail::not_a_number<S>());
    if (foot.region == detail::cone_region::inside) {
      if (mu_ > S(0)) G.setIdentity();
      G(0, 0) = S(1);
    }
    return G;
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// mantle, and so does d: a direction of the cone up to the band has no end.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const v = x, w = d;
    if (detail::has_nan(v) || detail::has_nan(w)) return detail::not_a_number<S>();
    if (contains(w)) return detail::infinity<S>();
    return detail::cone_step<S, N>(mu_, v, w);
  }

  /// 0 for y in the polar cone y_n + μ‖y_t‖ <= 0 (up to 8 ε |y_n|), otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    if (detail::has_nan(v)) return detail::not_a_number<S>();
    if (v(0) > S(0)) return detail::infinity<S>();
    S const depth = -v(0) * (S(1) + detail::rounding_band<S>());
    auto const μρ = detail::scaled_slip<S, N>(mu_, v);
    return detail::times_power_of_two<S>(μρ.value, μρ.exponent) <= depth ? S(0)
                                                                         : detail::infinity<S>();
  }

  /// f(x) = (‖x_t‖² − μ²x_n², −x_n) <= 0; the first accurate also near the mantle.
  [[nodiscard]] Eigen::Matrix<S, 2, 1> inequality(auto const& x) const {
    using word = detail::double_word<S>;
    vector_type const v = x;
    auto const t = detail::tail_of(v);
    auto const bound = detail::exact_product<S>(mu_, v(0));
    auto const squares = detail::precise_dot<S>(t, t);
    return {(squares - bound * word(bound)).hi, S(-v(0))};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] Eigen::Matrix<S, N, 2> inequality_gradient(auto const& x) const {
    vector_type const v = x;
    return detail::from_entries<Eigen::Matrix<S, N, 2>>([&](int i, int j) -> S {
      if (j == 1) return S(i == 0 ? -1 : 0);
      return i == 0 ? S(-2) * mu_ * (mu_ * v[0]) : S(2) * v[i];
    });
  }

  /// ν₁ ∇²f₁ = 2 ν₁ diag(−μ², 1, …, 1); f₂ is linear.
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    S const twice = S(2) * multipliers(0);
    return detail::from_entries<matrix_type>([&](int i, int j) -> S {
      if (i != j) return S(0);
      return i == 0 ? twice * (-mu_ * mu_) : twice;
    });
  }

  /// (μ x_n, x_t) ∈ L; needs μ > 0.
  [[nodiscard]] vector_type lorentz_point(auto const& x) const {
    vector_type v = x;
    v.data()[0] *= mu_;
    return v;
  }
  [[nodiscard]] matrix_type lorentz_matrix() const {
    return detail::from_entries<matrix_type>([&](int i, int j) -> S {
      return i != j ? S(0) : i == 0 ? mu_ : S(1);
    });
  }

 private:
  /// ‖x_t‖ <= factor · μ x_n and x_n >= 0, with one unit of the smallest numbers allowed for every
  /// component: there rounding is no longer relative.
  [[nodiscard]] bool ratio_at_most(vector_type const& v, S const& factor) const {
    if (!(v(0) >= S(0))) return false;
    auto const ρ = detail::scaled_norm<S, N - 1>(detail::tail_of(v));
    int const k = detail::binary_exponent(mu_);
    S const unit = std::numeric_limits<S>::denorm_min();
    S const bound = factor * detail::times_power_of_two<S>(mu_, -k) *
                    detail::times_power_of_two<S>(v(0) + unit, k - ρ.exponent);
    return ρ.value <= bound + detail::times_power_of_two<S>(S(N) * unit, -ρ.exponent);
  }

  S mu_{1};
};

// --- plane cone ----------------------------------------------------------------------------------
//
// The friction cone of a plane problem, { (x_n, x_t) : |x_t| <= μ x_n }, as the polyhedron that it
// is: the same set as second_order_cone<2>, with linear inequalities in place of the quadratic one.
// An interior-point method has nothing to curve around then.

/// { x ∈ R² : |x_t| <= μ x_n }, μ >= 0 finite. All but the inequality form is that of
/// second_order_cone<2>.
template <scalar S = double>
class plane_cone : public second_order_cone<2, S> {
  using base = second_order_cone<2, S>;

 public:
  using typename base::matrix_type;
  using typename base::vector_type;

  plane_cone() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit plane_cone(S const& mu) : base(mu) {}

  [[nodiscard]] plane_cone with(S const& mu) const { return plane_cone(mu); }

  /// f(x) = (x_t − μ x_n, −x_t − μ x_n) <= 0, each within an ulp.
  [[nodiscard]] vector_type inequality(auto const& x) const {
    vector_type const v = x;
    detail::double_word<S> const bound = detail::exact_product<S>(this->mu(), v(0));
    detail::double_word<S> const slip(v(1));
    return {(slip - bound).hi, (-slip - bound).hi};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] matrix_type inequality_gradient(auto const&) const {
    matrix_type gradient;
    gradient << -this->mu(), -this->mu(), S(1), S(-1);
    return gradient;
  }

  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }

  /// It has flat sides, and f is linear.
  void lorentz_point(auto const& x) const = delete;
};

}  // namespace slant
