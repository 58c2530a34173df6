// SPDX-License-Identifier: MIT
//
// The elliptic cone { (x_n, x₁, x₂) : (x₁/μ₁)² + (x₂/μ₂)² <= x_n² }, x_n >= 0: normal pressure and
// friction on an orthotropic surface, which holds better along one axis than along the other.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/elliptic_cone_foot.hpp>
#include <slant/sets/detail/elliptic_cone_slant.hpp>
#include <slant/sets/detail/elliptic_cone_step.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>
#include <slant/sets/detail/stretch.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace slant {

/// { x ∈ R³ : (x₁/μ₁)² + (x₂/μ₂)² <= x_n², x_n >= 0 }, x_n = x₀ the axis; μ₁, μ₂ are 0 or in the
/// sixth part of the exponent range of S: 1e±51 for double, 1e±6 for float.
///
/// A coefficient 0 makes it flat: a plane cone, for two the ray; all are legal. The projection is
/// the root of a quartic, see detail/elliptic_cone_secular.hpp. Each component is within 2 ulp at
/// any scale of x, for aspect ratios μ₁/μ₂ up to 1e8 and coefficients of 1e±10 (double; components
/// below the smallest normal number excepted). "On the mantle" means that (x_i/μ_i) has the length
/// x_n within 16 ε, ε the machine epsilon. NaN in, NaN out; so does an infinite component.
template <scalar S = double>
class elliptic_cone {
 public:
  using scalar = S;
  static constexpr int dimension = 3;
  static constexpr int inequalities = 2;
  static constexpr bool is_cone = true;
  using vector_type = Eigen::Matrix<S, 3, 1>;
  using matrix_type = Eigen::Matrix<S, 3, 3>;

  elliptic_cone() = default;

  /// @throws bad_input if a coefficient is NaN, negative or outside of that range.
  elliptic_cone(S const& mu1, S const& mu2) : mu_{mu1, mu2} {
    require("mu1", mu1);
    require("mu2", mu2);
  }

  [[nodiscard]] elliptic_cone with(S const& mu1, S const& mu2) const {
    return elliptic_cone(mu1, mu2);
  }
  /// μ_{i+1}.
  [[nodiscard]] S const& mu(int i) const { return mu_(i); }

  /// { diag(s) x : x in the set }; s > 0.
  [[nodiscard]] elliptic_cone stretched(vector_type const& s) const {
    return elliptic_cone(detail::stretched_parameter<S>(mu_(0), s(1), s(0)),
                         detail::stretched_parameter<S>(mu_(1), s(2), s(0)));
  }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (!detail::all_finite(v)) return vector_type::Constant(detail::not_a_number<S>());
    if (flat()) return lifted(in_its_plane().project(in_plane(v)));
    auto const found = detail::nearest_on_elliptic_cone<S>(mu_, v);
    if (found.region == detail::cone_region::apex) v.setZero();
    if (found.region == detail::cone_region::mantle) {
      v(0) = detail::times_power_of_two<S>(found.foot.normal, found.exponent);
      for (int i = 0; i < 2; ++i) v(1 + i) *= found.foot.ratio(i);
    }
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    vector_type const v = x;
    if (detail::has_nan(v)) return false;
    if (flat()) return v(minor()) == S(0) && in_its_plane().contains(in_plane(v));
    return length_at_most(v, S(1) + band());
  }

  /// For x in the set: fixed at the apex, sliding on the mantle (everywhere else if the cone is
  /// flat), else free.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    if (!(v(0) > S(0))) return block_state::fixed;
    bool const inside = !flat() && length_at_most(v, S(1) - band());
    return inside ? block_state::free : block_state::sliding;
  }

  /// Slanting operator of the projection at x: I in the cone (mantle and apex included), 0 in the
  /// polar cone (apex excluded), otherwise that of detail/elliptic_cone_slant.hpp. A flat cone has
  /// that of the plane one, and 0 across it.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    if (!detail::all_finite(v)) return matrix_type::Constant(detail::not_a_number<S>());
    matrix_type G = matrix_type::Zero();
    if (flat()) {
      auto const g = in_its_plane().slant(in_plane(v));
      int const at[] = {0, major()};
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) G(at[i], at[j]) = g(i, j);
      }
      return G;
    }
    auto const found = detail::nearest_on_elliptic_cone<S>(mu_, v);
    if (found.region == detail::cone_region::inside) G.setIdentity();
    if (found.region == detail::cone_region::mantle) {
      G = detail::elliptic_mantle_slant<S>(mu_, found.foot, v);
    }
    return G;
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// mantle, and so does d: a direction of the cone up to the band has no end.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const v = x, w = d;
    if (detail::has_nan(v) || detail::has_nan(w)) return detail::not_a_number<S>();
    if (contains(w)) return detail::infinity<S>();
    if (!flat()) return detail::elliptic_cone_step<S>(mu_, v, w);
    return w(minor()) != S(0) ? S(0) : in_its_plane().step_to_boundary(in_plane(v), in_plane(w));
  }

  /// 0 for y in the polar cone y_n + ‖(μ₁y₁, μ₂y₂)‖ <= 0 (up to 16 ε |y_n|), otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    if (detail::has_nan(v)) return detail::not_a_number<S>();
    if (v(0) > S(0)) return detail::infinity<S>();
    auto const slip = detail::elliptic_length<S>(mu_, v, false);
    S const depth = detail::times_power_of_two<S>(-v(0) * (S(1) + band()), -slip.exponent);
    return slip.value <= depth ? S(0) : detail::infinity<S>();
  }

  /// f(x) = (μ₂/μ₁ x₁² + μ₁/μ₂ x₂² − μ₁μ₂ x_n², −x_n) <= 0, for μ₁ = μ₂ that of the round cone;
  /// needs μ₁, μ₂ > 0. The first is accurate also near the mantle.
  [[nodiscard]] Eigen::Matrix<S, 2, 1> inequality(auto const& x) const {
    using word = detail::double_word<S>;
    vector_type const v = x;
    word const ratio = word(mu_(1)) / word(mu_(0));
    auto const f = detail::exact_product<S>(v(1), v(1)) * ratio +
                   detail::exact_product<S>(v(2), v(2)) / ratio -
                   detail::exact_product<S>(v(0), v(0)) * detail::exact_product<S>(mu_(0), mu_(1));
    return {f.hi, S(-v(0))};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] Eigen::Matrix<S, 3, 2> inequality_gradient(auto const& x) const {
    Eigen::Matrix<S, 3, 2> gradient = Eigen::Matrix<S, 3, 2>::Zero();
    gradient.col(0) = S(2) * weights().cwiseProduct(vector_type(x));
    gradient(0, 1) = S(-1);
    return gradient;
  }

  /// ν₁ ∇²f₁ = 2 ν₁ diag(−μ₁μ₂, μ₂/μ₁, μ₁/μ₂); f₂ is linear.
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    return vector_type(S(2) * multipliers(0) * weights()).asDiagonal();
  }

  /// (√(μ₁μ₂) x_n, √(μ₂/μ₁) x₁, √(μ₁/μ₂) x₂) ∈ L; needs μ₁, μ₂ > 0.
  [[nodiscard]] vector_type lorentz_point(auto const& x) const {
    vector_type v = x;
    vector_type const factors = lorentz_factors();
    for (int i = 0; i < 3; ++i) v.data()[i] *= factors.data()[i];
    return v;
  }
  [[nodiscard]] matrix_type lorentz_matrix() const {
    vector_type const factors = lorentz_factors();
    return detail::from_entries<matrix_type>(
        [&](int i, int j) -> S { return i == j ? factors.data()[i] : S(0); });
  }

 private:
  static void require(char const* name, S const& mu) {
    // Beyond, powers of μ that the projection needs are no numbers of the format.
    int const most = std::numeric_limits<S>::max_exponent / 6;
    S const largest = detail::times_power_of_two<S>(S(1), most);
    bool const legal = mu == S(0) || (mu >= S(1) / largest && mu <= largest);
    if (!legal) {
      throw bad_input(name, detail::show(mu),
                      "0 or a number in [2^-" + detail::show(index(most)) + ", 2^" +
                          detail::show(index(most)) + "]");
    }
  }
  [[nodiscard]] static S band() { return S(2) * detail::rounding_band<S>(); }
  [[nodiscard]] vector_type weights() const {
    return {-(mu_(0) * mu_(1)), mu_(1) / mu_(0), mu_(0) / mu_(1)};
  }

  [[nodiscard]] vector_type lorentz_factors() const {
    using std::sqrt;
    return {S(sqrt(mu_(0)) * sqrt(mu_(1))), S(sqrt(S(mu_(1) / mu_(0)))),
            S(sqrt(S(mu_(0) / mu_(1))))};
  }

  [[nodiscard]] bool flat() const { return mu_(0) == S(0) || mu_(1) == S(0); }
  /// Component of the larger coefficient, and of the other one.
  [[nodiscard]] int major() const { return mu_(0) < mu_(1) ? 2 : 1; }
  [[nodiscard]] int minor() const { return 3 - major(); }
  /// The flat cone in its plane.
  [[nodiscard]] second_order_cone<2, S> in_its_plane() const {
    return second_order_cone<2, S>(mu_(major() - 1));
  }
  [[nodiscard]] Eigen::Matrix<S, 2, 1> in_plane(vector_type const& x) const {
    return {x(0), x(major())};
  }
  [[nodiscard]] vector_type lifted(Eigen::Matrix<S, 2, 1> const& p) const {
    vector_type v;
    v(0) = p(0);
    v(major()) = p(1);
    v(minor()) = S(0);
    return v;
  }

  /// ‖(x₁/μ₁, x₂/μ₂)‖ <= factor · x_n, with one unit of the smallest numbers allowed for every
  /// component: there rounding is no longer relative.
  [[nodiscard]] bool length_at_most(vector_type v, S const& factor) const {
    if (!(v(0) >= S(0))) return false;
    using std::abs;
    S const unit = std::numeric_limits<S>::denorm_min();
    for (int i = 1; i < 3; ++i) v(i) = abs(v(i)) > unit ? S(abs(v(i)) - unit) : S(0);
    auto const slip = detail::elliptic_length<S>(mu_, v, true);
    return slip.value <= factor * detail::times_power_of_two<S>(v(0) + unit, -slip.exponent);
  }

  Eigen::Matrix<S, 2, 1> mu_{S(1), S(1)};
};

}  // namespace slant
