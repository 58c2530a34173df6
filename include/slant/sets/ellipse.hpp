// SPDX-License-Identifier: MIT
//
// The ellipse { (x, y) : x²/a² + y²/b² <= 1 }: the friction set of an orthotropic surface [K
// §3.1.3].
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/bounds.hpp>
#include <slant/sets/detail/ellipse_foot.hpp>
#include <slant/sets/detail/ellipse_step.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace slant {

/// { (x, y) ∈ R² : x²/a² + y²/b² <= 1 } with the semi-axes a, b >= 0 along the coordinates.
///
/// An axis 0 makes a segment or a point, an infinite one a strip or the plane; all are legal and
/// treated as the boxes |x| <= a, |y| <= b that they are.
/// The projection is the root of a quartic; see detail/ellipse_secular.hpp. Each component is
/// within 2 ulp at any scale and for any aspect ratio up to 1e100 (double), components below the
/// smallest normal number excepted; thinner ellipses end, beyond 1e290, as segments. "On the
/// boundary" means | x²/a² + y²/b² − 1 | <= 16 ε, ε the machine epsilon. NaN in, NaN out; so does
/// an infinite component unless the set is one of the boxes.
template <scalar S = double>
class ellipse {
 public:
  using scalar = S;
  static constexpr int dimension = 2;
  static constexpr int inequalities = 1;
  using vector_type = Eigen::Matrix<S, 2, 1>;
  using matrix_type = Eigen::Matrix<S, 2, 2>;

  ellipse() = default;

  /// @throws bad_input if a semi-axis is NaN or negative.
  ellipse(S const& a, S const& b) : a_(a), b_(b) {
    if (!(a >= S(0))) throw bad_input("a", detail::show(a), "a number >= 0");
    if (!(b >= S(0))) throw bad_input("b", detail::show(b), "a number >= 0");
  }

  [[nodiscard]] ellipse with(S const& a, S const& b) const { return ellipse(a, b); }
  [[nodiscard]] S const& a() const { return a_; }
  [[nodiscard]] S const& b() const { return b_; }

  /// { diag(s) x : x in the set }; s > 0.
  [[nodiscard]] ellipse stretched(vector_type const& s) const {
    return ellipse(detail::support_product(a_, S(s(0))), detail::support_product(b_, S(s(1))));
  }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (detail::any_nan(v(0), v(1))) return vector_type::Constant(detail::not_a_number<S>());
    if (is_box()) {
      for (int i = 0; i < 2; ++i) v(i) = clamp(v(i), axis(i));
      return v;
    }
    if (!detail::all_finite(v)) return vector_type::Constant(detail::not_a_number<S>());
    auto const foot = first_quadrant_foot(v);
    if (foot.inside) return v;
    set_with_sign(v(major()), foot.x);
    set_with_sign(v(1 - major()), foot.y);
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    vector_type const v = x;
    if (is_box()) {
      return detail::at_most(magnitude(v(0)), a_) && detail::at_most(magnitude(v(1)), b_);
    }
    return !(detail::any_nan(v(0), v(1))) &&
           level(v, std::numeric_limits<S>::denorm_min()) <= S(1) + band();
  }

  /// For x in the set: free inside; sliding on the curve, on the lines bounding a strip and on a
  /// segment; fixed at the ends of a segment and for a single point.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    if (!is_box()) return level(v, S(0)) < S(1) - band() ? block_state::free : block_state::sliding;
    bool at_end = false;
    for (int i = 0; i < 2; ++i) {
      at_end = at_end || (axis(i) > S(0) && (detail::at_bound(magnitude(v(i)), axis(i)) ||
                                             magnitude(v(i)) > axis(i)));
    }
    if (a_ > S(0) && b_ > S(0)) return at_end ? block_state::sliding : block_state::free;
    bool const moves = (a_ > S(0) || b_ > S(0)) && !at_end;
    return moves ? block_state::sliding : block_state::fixed;
  }

  /// Slanting operator of the projection at x: I for x in the set, otherwise
  ///
  ///     G = T Tᵀ / (1 + κ δ),   T the unit tangent and κ the curvature at the foot p, δ = ‖x − p‖.
  ///
  /// Derivation: with E = diag(1/a², 1/b²) the foot satisfies x = p + t E p and pᵀE p = 1, hence
  /// dx = (I + t E) dp + E p dt and pᵀE dp = 0. So dp is a multiple of T, which is orthogonal to E
  /// p, and Tᵀdx = (1 + t TᵀE T) Tᵀdp. As κ = TᵀE T/‖E p‖ and δ = t ‖E p‖, t TᵀE T = κ δ. With T =
  /// (−aY, bX)/w, w² = a²Y² + b²X², X = p_x/a, Y = p_y/b, this is κ δ = t/w².
  ///
  /// Boxes: 1 on the diagonal for |xᵢ| <= aᵢ, 0 beyond; 0 for an axis 0.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    if (detail::any_nan(v(0), v(1))) return matrix_type::Constant(detail::not_a_number<S>());
    matrix_type G = matrix_type::Zero();
    if (is_box()) {
      for (int i = 0; i < 2; ++i) {
        if (axis(i) > S(0) && magnitude(v(i)) <= axis(i)) G(i, i) = S(1);
      }
      return G;
    }
    if (!detail::all_finite(v)) return matrix_type::Constant(detail::not_a_number<S>());
    int const e = unit();
    auto const foot = first_quadrant_foot(v);
    if (foot.inside) return matrix_type::Identity();
    int const i = major(), j = 1 - major();
    vector_type T;
    T(i) = -detail::times_power_of_two<S>(axis(i), -e) * foot.Y;
    T(j) = detail::times_power_of_two<S>(axis(j), -e) * foot.X;
    auto const length = detail::scaled_norm<S, 2>(T);
    T = detail::times_power_of_two<S, 2>(T, -length.exponent) / length.value;
    S const w = detail::times_power_of_two<S>(length.value, length.exponent);
    S const factor = S(1) / (S(1) + (foot.ab_tau / w) / w);
    if ((v(0) < S(0)) != (v(1) < S(0))) T(i) = -T(i);
    G << factor * (T(0) * T(0)), factor * (T(0) * T(1)),  //
        factor * (T(0) * T(1)), factor * (T(1) * T(1));
    return G;
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// curve.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    return detail::ellipse_step<S>({a_, b_}, vector_type(x), vector_type(d));
  }

  /// √(a² y₁² + b² y₂²), with 0 · ∞ = 0.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    auto const length = detail::scaled_norm<S, 2>(
        vector_type(detail::support_product(v(0), a_), detail::support_product(v(1), b_)));
    if (detail::any_nan(v(0), v(1))) return detail::not_a_number<S>();
    return detail::times_power_of_two<S>(length.value, length.exponent);
  }

  /// f(x) = x₁²/a² + x₂²/b² − 1 <= 0, without unit; needs a, b > 0. Accurate also near the
  /// boundary.
  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality(auto const& x) const {
    using word = detail::double_word<S>;
    vector_type const v = x;
    word f(S(-1));
    for (int i = 0; i < 2; ++i) {
      if (!detail::is_finite(axis(i))) continue;
      auto const quotient = word(v(i)) / word(axis(i));
      f = f + quotient * quotient;
    }
    return Eigen::Matrix<S, 1, 1>::Constant(f.hi);
  }

  [[nodiscard]] vector_type inequality_gradient(auto const& x) const {
    vector_type const v = x;
    return {S(2) * (v(0) / a_) / a_, S(2) * (v(1) / b_) / b_};
  }

  /// ν₁ ∇²f = 2 ν₁ diag(1/a², 1/b²).
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    S const ν = multipliers(0);
    return vector_type(S(2) * (ν / a_) / a_, S(2) * (ν / b_) / b_).asDiagonal();
  }

  /// (1, x₁/a, x₂/b) ∈ L; needs a, b > 0.
  [[nodiscard]] Eigen::Matrix<S, 3, 1> lorentz_point(auto const& x) const {
    vector_type const v = x;
    return {S(1), v(0) / a_, v(1) / b_};
  }
  [[nodiscard]] Eigen::Matrix<S, 3, 2> lorentz_matrix() const {
    return detail::from_entries<Eigen::Matrix<S, 3, 2>>(
        [&](int i, int j) -> S { return i == j + 1 ? S(S(1) / axis(j)) : S(0); });
  }

 private:
  [[nodiscard]] static S band() { return S(2) * detail::rounding_band<S>(); }
  [[nodiscard]] S const& axis(int i) const { return i == 0 ? a_ : b_; }
  [[nodiscard]] int major() const { return a_ < b_ ? 1 : 0; }
  [[nodiscard]] int unit() const { return detail::binary_exponent(axis(major())); }

  [[nodiscard]] bool is_box() const {
    return a_ == S(0) || b_ == S(0) || !detail::is_finite(a_) || !detail::is_finite(b_);
  }

  [[nodiscard]] static S magnitude(S const& v) {
    using std::abs;
    return abs(v);
  }

  [[nodiscard]] static S clamp(S const& v, S const& bound) {
    return v > bound ? bound : v < -bound ? S(-bound) : v;
  }

  /// x²/a² + y²/b² after moving each component inwards by `margin`.
  [[nodiscard]] S level(vector_type const& v, S const& margin) const {
    S sum(0);
    for (int i = 0; i < 2; ++i) {
      S const distance = magnitude(v(i)) - margin;
      S const quotient = distance > S(0) ? S(distance / axis(i)) : S(0);
      sum += quotient * quotient;
    }
    return sum;
  }

  static void set_with_sign(S& component, S const& value) {
    component = component < S(0) ? S(-value) : value;
  }

  /// Foot of the point with the long axis first; its member ab_tau is in units of 4^unit().
  [[nodiscard]] detail::ellipse_foot<S> first_quadrant_foot(vector_type const& v) const {
    int const i = major(), j = 1 - major();
    return detail::nearest_on_ellipse<S>(axis(i), axis(j), magnitude(v(i)), magnitude(v(j)),
                                         unit());
  }

  S a_{1};
  S b_{1};
};

}  // namespace slant
