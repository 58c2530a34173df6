// SPDX-License-Identifier: MIT
//
// The dual of the friction cone, K_μ* = { (u_n, u_t) : μ‖u_t‖ <= u_n }: where the velocities of a
// contact with Coulomb friction are, after de Saxcé's change of variables.
//
// By Moreau's decomposition u = P_K*(u) − P_K(−u). The projection is not computed as that sum,
// which cancels near −K, but by the formula of its own that the sum gives; see
// parts/cone_projection.hpp.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>
#include <slant/sets/parts/cone_projection.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <limits>

namespace slant {

/// { u ∈ R^N : μ‖u_t‖ <= u_n }, u_n = u₀ the axis, u_t = (u₁, …); μ >= 0 is finite.
///
/// μ = 0 is the half space u_n >= 0. Every component of the projection is within 4 ulp at any scale
/// and for any μ (components below the smallest normal number excepted). "On the mantle" means
/// | μ‖u_t‖ − u_n | <= 8 ε u_n, ε the machine epsilon; a plane (μ = 0) has no band, nor has the
/// apex. NaN in, NaN out; so does an infinite component.
template <int N, scalar S = double>
  requires(N >= 2)
class dual_cone {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr int inequalities = 2;
  static constexpr bool is_cone = true;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  dual_cone() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit dual_cone(S const& mu) : primal_(mu) {}

  [[nodiscard]] dual_cone with(S const& mu) const { return dual_cone(mu); }
  [[nodiscard]] S const& mu() const { return primal_.mu(); }
  /// K_μ.
  [[nodiscard]] second_order_cone<N, S> const& dual() const { return primal_; }

  /// { diag(s) x : x in the set }, a cone of another coefficient; s > 0.
  /// @throws bad_input if the tangential factors differ.
  [[nodiscard]] dual_cone stretched(vector_type const& s) const {
    detail::require_round_stretch<S, N>(s, 1);
    return dual_cone(detail::stretched_parameter<S>(mu(), s(0), s(1)));
  }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    detail::nearest_on_dual_cone<S, N>(mu(), v).move(v);
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    return ratio_at_most(x, S(1) + detail::rounding_band<S>());
  }

  /// For x in the set: fixed at the apex, sliding on the mantle, else free. The half space μ = 0
  /// has no apex.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    if (!(v(0) > S(0))) return mu() > S(0) ? block_state::fixed : block_state::sliding;
    bool const inside = ratio_at_most(v, S(1) - detail::rounding_band<S>());
    return inside ? block_state::free : block_state::sliding;
  }

  /// Slanting operator of the projection at x, the value from inside as for all sets:
  ///
  ///     μ‖x_t‖ <= x_n         I                                (mantle and apex included)
  ///     μx_n + ‖x_t‖ <= 0     0                                (−K_μ, apex excluded)
  ///     otherwise             w wᵀ + θ (0 ⊕ (I − e eᵀ)),       e = x_t/‖x_t‖,
  ///
  /// w = (μ, e)/√(1 + μ²), θ = ‖p_t‖/‖x_t‖. For μ = 0 the second line is 0 ⊕ I, as the third. It is
  /// I − G(−x), G that of K_μ, but at x = 0, where both are the values from inside.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    auto const foot = detail::nearest_on_dual_cone<S, N>(mu(), v);
    if (foot.region == detail::cone_region::mantle) {
      return detail::mantle_slant<S, N>(S(1), mu(), foot, v);
    }
    if (foot.region == detail::cone_region::undefined) {
      return matrix_type::Constant(detail::not_a_number<S>());
    }
    matrix_type G = matrix_type::Zero();
    if (foot.region == detail::cone_region::inside) {
      G.setIdentity();
    } else if (mu() == S(0)) {
      G.template bottomRightCorner<N - 1, N - 1>().setIdentity();
    }
    return G;
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// mantle, and so does d: a direction of the cone up to the band has no end.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const v = x, w = d;
    if (detail::has_nan(v) || detail::has_nan(w)) return detail::not_a_number<S>();
    if (contains(w)) return detail::infinity<S>();
    return detail::cone_step<S, N>(S(1), mu(), v, w);
  }

  /// 0 for −y in K_μ (up to its band), otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = -y;
    if (detail::has_nan(v)) return detail::not_a_number<S>();
    return primal_.contains(v) ? S(0) : detail::infinity<S>();
  }

  /// f(x) = (μ²‖x_t‖² − x_n², −x_n) <= 0; the first accurate also near the mantle.
  [[nodiscard]] Eigen::Matrix<S, 2, 1> inequality(auto const& x) const {
    using word = detail::double_word<S>;
    vector_type const v = x;
    word f = -detail::exact_product<S>(v(0), v(0));
    for (int i = 1; i < N; ++i) {
      auto const slip = detail::exact_product<S>(mu(), v(i));
      f = f + slip * slip;
    }
    return {f.hi, S(-v(0))};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] Eigen::Matrix<S, N, 2> inequality_gradient(auto const& x) const {
    Eigen::Matrix<S, N, 2> gradient = Eigen::Matrix<S, N, 2>::Zero();
    gradient.col(0) = S(2) * mu() * (mu() * vector_type(x));
    gradient(0, 0) = S(-2) * vector_type(x)(0);
    gradient(0, 1) = S(-1);
    return gradient;
  }

  /// ν₁ ∇²f₁ = 2 ν₁ diag(−1, μ², …, μ²); f₂ is linear.
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    matrix_type hessian = S(2) * multipliers(0) * mu() * (mu() * matrix_type::Identity());
    hessian(0, 0) = S(-2) * multipliers(0);
    return hessian;
  }

  /// (x_n, μ x_t) ∈ L.
  [[nodiscard]] vector_type lorentz_point(auto const& x) const {
    vector_type const v = x;
    return detail::from_entries<vector_type>(
        [&](int i) -> S { return i == 0 ? v.data()[0] : S(mu() * v.data()[i]); });
  }
  [[nodiscard]] matrix_type lorentz_matrix() const {
    return detail::from_entries<matrix_type>([&](int i, int j) -> S {
      return i != j ? S(0) : i == 0 ? S(1) : mu();
    });
  }

 private:
  /// μ‖x_t‖ <= factor · x_n, with one unit of the smallest numbers allowed for every component:
  /// there rounding is no longer relative. None for the plane that bounds a half space.
  [[nodiscard]] bool ratio_at_most(vector_type const& v, S const& factor) const {
    if (detail::has_nan(v) || !(v(0) >= S(0))) return false;
    if (mu() == S(0)) return factor > S(1) || v(0) > S(0);
    auto const μρ = detail::scaled_slip<S, N>(mu(), v);
    S const unit = std::numeric_limits<S>::denorm_min();
    S const bound = factor * detail::times_power_of_two<S>(v(0) + S(N) * unit, -μρ.exponent);
    S const slack = detail::times_power_of_two<S>(mu() * (S(N) * unit), -μρ.exponent);
    return μρ.value <= bound + slack;
  }

  second_order_cone<N, S> primal_{};
};

/// The dual cone { u : uᵀr >= 0 for all r in the cone }.
template <int N, scalar S>
[[nodiscard]] dual_cone<N, S> dual(second_order_cone<N, S> const& cone) {
  return dual_cone<N, S>(cone.mu());
}
/// The dual of the dual is the cone itself.
template <int N, scalar S>
[[nodiscard]] second_order_cone<N, S> dual(dual_cone<N, S> const& cone) {
  return cone.dual();
}
/// The dual of a product of cones is that of their duals.
template <class Block, class Layout, class Blocks>
  requires requires(Block const& block) { dual(block); }
[[nodiscard]] auto dual(power_product<Block, Layout, Blocks> const& cones) {
  return detail::mapped_power(cones, [](Block const& block, index) { return dual(block); });
}

}  // namespace slant
