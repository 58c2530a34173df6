// SPDX-License-Identifier: MIT
//
// The ellipse { (x, y) : x²/a² + y²/b² <= 1 }: the friction set of an orthotropic surface [K
// §3.1.3].
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::detail {

// --- secular -------------------------------------------------------------------------------------
//
// Nearest point of an ellipse, in the first quadrant.
//
// With semi-axes a >= b > 0 the foot p of a point (x, y) outside satisfies x − p_x = t p_x/a²,
// y − p_y = t p_y/b² with t > 0. In terms of τ = t/(ab):
//
//     X = p_x/a = x/(a + bτ),   Y = p_y/b = y/(b + aτ),   G(τ) = X² + Y² − 1 = 0.
//
// This form of the secular equation (compare D. Eberly, "Distance from a point to an ellipse",
// 2013) contains neither squares of the axes nor their ratio. Three things make it accurate:
//
// (1) G is evaluated as (X − 1)(X + 1) + Y² with X − 1 = ((x − a) − bτ)/(a + bτ). Near the ends of
//     the long axis a small τ is determined by 1 − X², and no digit of x − a is lost; at a/b = 1e8
//     the plain form would lose all of them.
// (2) 1/√(X² + Y²) is concave in τ and almost linear, so Newton's method for 1/√(X² + Y²) = 1 rises
//     monotonically to the root from any start on its left. Halving on a logarithmic scale first
//     brings the start within a factor 4 in b + aτ. So the number of steps is bounded: at most 17
//     evaluations of G were seen up to a/b = 1e100, four on average.
// (3) One last Newton step takes G in double-word arithmetic; so do the components of the foot.
//
// Both components then have full relative accuracy: an error of τ by a rounding of b/a + τ moves
// neither by more, and G′(τ)/2 = −(X² b/(a + bτ) + Y² a/(b + aτ)) is large enough to yield that τ
// from the form (1).

/// Foot of the perpendicular, and what the slanting operator needs to know about it.
template <class S>
struct ellipse_foot {
  bool inside;               ///< the point is its own foot, the other members are not set
  S x{0}, y{0};              ///< the foot
  S X{0}, Y{0};              ///< (x/a, y/b), a unit vector
  S ab_tau{0};               ///< a b τ = t
  S x_ratio{0}, y_ratio{0};  ///< what the components of the point are multiplied with
};

template <class S>
class ellipse_secular_equation {
 public:
  /// 0 < b <= a, x, y >= 0, all finite and scaled such that a is of the order of one.
  ellipse_secular_equation(S const& a, S const& b, S const& x, S const& y)
      : a_(a), b_(b), x_(x), y_(y) {}

  /// G(0) <= 0, decided in double-word arithmetic where rounding could matter.
  [[nodiscard]] bool inside() const {
    S const X = x_ / a_, Y = y_ / b_;
    S const estimate = X * X + Y * Y;
    if (estimate < S(1) - S(2) * rounding_band<S>()) return true;
    return estimate < S(2) && residual(S(0)).hi <= S(0);
  }

  [[nodiscard]] ellipse_foot<S> foot() const {
    S const τ = working_precision_root();
    auto const G = residual(τ);
    auto const τ2 = ordered_sum(τ, S(G.hi / (S(2) * slope(τ))));
    auto const Dx = word(a_) + word(b_) * τ2, Dy = word(b_) + word(a_) * τ2;
    auto const X = word(x_) / Dx, Y = word(y_) / Dy;
    S const ab_tau = std::max<S>(S(0), a_ * (b_ * τ2.hi));
    return {false,  (word(a_) * X).hi,  (word(b_) * Y).hi, X.hi, Y.hi,
            ab_tau, (word(a_) / Dx).hi, (word(b_) / Dy).hi};
  }

 private:
  using word = double_word<S>;

  [[nodiscard]] S excess(S const& τ) const {  // G in working precision
    S const Dx = a_ + b_ * τ;
    S const Y = y_ / (b_ + a_ * τ);
    return (((x_ - a_) - b_ * τ) / Dx) * (x_ / Dx + S(1)) + Y * Y;
  }

  /// −G′(τ)/2 = X² b/(a + bτ) + Y² a/(b + aτ).
  [[nodiscard]] S slope(S const& τ) const {
    S const Dx = a_ + b_ * τ, Dy = b_ + a_ * τ;
    S const X = x_ / Dx, Y = y_ / Dy;
    return X * X * (b_ / Dx) + Y * Y * (a_ / Dy);
  }

  [[nodiscard]] word residual(S const& τ) const {  // G in double-word arithmetic
    auto const bτ = exact_product(b_, τ);
    auto const Dx = word(a_) + bτ;
    auto const Y = word(y_) / (word(b_) + exact_product(a_, τ));
    return (((word(x_) - word(a_)) - bτ) / Dx) * (word(x_) / Dx + word(S(1))) + Y * Y;
  }

  [[nodiscard]] S working_precision_root() const {
    using std::sqrt;
    S const root2 = sqrt(S(2));
    // X or Y is 1: G >= 0; X², Y² <= 1/2: G <= 0.
    S lower = std::max({S(0), S((x_ - a_) / b_), S((y_ - b_) / a_)});
    S upper = std::max({lower, S((root2 * x_ - a_) / b_), S((root2 * y_ - b_) / a_)});
    while (b_ + a_ * upper > S(4) * (b_ + a_ * lower)) {
      S const middle = (sqrt(b_ + a_ * upper) * sqrt(b_ + a_ * lower) - b_) / a_;
      if (!(middle > lower && middle < upper)) break;
      (excess(middle) > S(0) ? lower : upper) = middle;
    }
    using std::abs;
    S const tolerance = sqrt(std::numeric_limits<S>::epsilon()) / S(16);
    S τ = lower;
    for (int i = 0; i < 64; ++i) {  // the bound only excludes a hang
      S const G = excess(τ);
      S const n = sqrt(G + S(1));
      S const step = (G + S(1)) * G / ((n + S(1)) * slope(τ));
      τ = std::max<S>(S(0), τ + step);
      if (!(S(abs(step)) * a_ > tolerance * (b_ + a_ * τ))) break;
    }
    return τ;
  }

  S a_, b_, x_, y_;
};

// --- foot ----------------------------------------------------------------------------------------
//
// Nearest point of an ellipse for axes and points of any size: picks the units and leaves the root
// of the secular equation only the cases that are neither very far out nor thinner than the
// exponent range.

/// Foot of a point so far out that a is negligible against bτ (and b against aτ): then (X, Y) has
/// the direction of (ax, by). Lengths of any size; a b τ comes in units of 4^e, e =
/// binary_exponent(a).
template <class S>
[[nodiscard]] ellipse_foot<S> far_ellipse_foot(S const& a, S const& b, S const& x, S const& y,
                                               int e) {
  using word = double_word<S>;
  int const x_exponent = binary_exponent(x), y_exponent = binary_exponent(y);
  int const b_exponent = binary_exponent(b);
  S const as = times_power_of_two<S>(a, -e), bs = times_power_of_two<S>(b, -b_exponent);
  auto const u = exact_product<S>(as, times_power_of_two<S>(x, -x_exponent));
  auto const v = exact_product<S>(bs, times_power_of_two<S>(y, -y_exponent));
  int u_exponent = e + x_exponent, v_exponent = b_exponent + y_exponent;
  if (x == S(0)) u_exponent = v_exponent;
  if (y == S(0)) v_exponent = u_exponent;
  int const f = u_exponent < v_exponent ? v_exponent : u_exponent;
  u_exponent -= f;
  v_exponent -= f;
  auto const us = times_power_of_two(u, u_exponent), vs = times_power_of_two(v, v_exponent);
  auto const n = square_root(us * us + vs * vs);
  return {false,
          times_power_of_two<S>((word(as) * (u / n)).hi, e + u_exponent),
          times_power_of_two<S>((word(bs) * (v / n)).hi, b_exponent + v_exponent),
          (us / n).hi,
          (vs / n).hi,
          times_power_of_two<S>(n.hi, f - 2 * e)};
}

/// Foot on an ellipse so thin that b is not a normal number in units of a: that of the long axis,
/// lifted to the boundary. Lengths of any size; a b τ comes in units of 4^e.
template <class S>
[[nodiscard]] ellipse_foot<S> thin_ellipse_foot(S const& a, S const& b, S const& x, S const& y,
                                                int e) {
  using std::sqrt;
  S const X = x < a ? S(x / a) : S(1);
  S const Y = sqrt((S(1) - X) * (S(1) + X));
  if (x <= a && y <= b * Y) return {true, x, y};
  S const ab_tau = times_power_of_two<S>(b, -e) * (times_power_of_two<S>(y, -e) / Y);
  return {false, x < a ? x : a, y < b * Y ? y : S(b * Y), X, Y, Y > S(0) ? ab_tau : infinity<S>()};
}

/// Foot of (x, y) in the first quadrant for 0 < b <= a, all finite. `e` is binary_exponent(a); a b
/// τ comes in units of 4^e, everything else in the units of the data.
template <class S>
[[nodiscard]] ellipse_foot<S> nearest_on_ellipse(S const& a, S const& b, S const& x, S const& y,
                                                 int e) {
  S const as = times_power_of_two<S>(a, -e), bs = times_power_of_two<S>(b, -e);
  S const xs = times_power_of_two<S>(x, -e), ys = times_power_of_two<S>(y, -e);
  S const ε = std::numeric_limits<S>::epsilon();
  // 2 xs/bs is finite otherwise.
  if (bs < S(32) * (std::numeric_limits<S>::min)() / ε) {
    return thin_ellipse_foot<S>(a, b, x, y, e);
  }
  if (xs >= S(16) / ε || bs * ys >= S(16) / ε) {  // then a/(bτ) is below ε/8
    return far_ellipse_foot<S>(a, b, x, y, e);
  }
  ellipse_secular_equation<S> const secular(as, bs, xs, ys);
  if (secular.inside()) return {true, x, y};
  auto foot = secular.foot();
  // A component that is no normal number in these units has had no influence on τ.
  S const least = (std::numeric_limits<S>::min)() / ε;
  foot.x = foot.x < least ? S(x * foot.x_ratio) : times_power_of_two<S>(foot.x, e);
  foot.y = foot.y < least ? S(y * foot.y_ratio) : times_power_of_two<S>(foot.y, e);
  return foot;
}

// --- step ----------------------------------------------------------------------------------------

/// sup{α >= 0 : Σ (xᵢ + α dᵢ)²/aᵢ² <= 1}: the unit disc after division by the axes, in double
/// words. Each quotient is formed from numbers of order one, with its exponent apart.
template <class S>
[[nodiscard]] S ellipse_step(Eigen::Matrix<S, 2, 1> const& axes, Eigen::Matrix<S, 2, 1> const& x,
                             Eigen::Matrix<S, 2, 1> const& d) {
  if (has_nan(x) || has_nan(d)) return not_a_number<S>();
  double_word<S> v[2];
  int exponent[2] = {0, 0};
  int f = 0;
  bool moves = false;
  double_word<S> C(S(1));
  double_word<S> u[2];
  for (int i = 0; i < 2; ++i) {
    if (d(i) != S(0) && axes(i) == S(0)) return S(0);
    if (axes(i) == S(0) || !is_finite<S>(axes(i))) continue;
    int const e = binary_exponent<S>(axes(i));
    double_word<S> const axis(times_power_of_two<S>(axes(i), -e));
    u[i] = double_word<S>(times_power_of_two<S>(x(i), -e)) / axis;
    C = C - u[i] * u[i];
    if (d(i) == S(0)) continue;
    int const k = binary_exponent<S>(d(i));
    v[i] = double_word<S>(times_power_of_two<S>(d(i), -k)) / axis;
    exponent[i] = k - e;
    if (!moves || exponent[i] > f) f = exponent[i];
    moves = true;
  }
  if (!moves) return infinity<S>();
  double_word<S> A, B;
  for (int i = 0; i < 2; ++i) {
    auto const w = times_power_of_two(v[i], exponent[i] - f);
    A = A + w * w;
    B = B + u[i] * w;
  }
  return times_power_of_two<S>(exit_root<S>(A, B, C), -f);
}

}  // namespace slant::detail

namespace slant {

// --- ellipse -------------------------------------------------------------------------------------

/// { (x, y) ∈ R² : x²/a² + y²/b² <= 1 } with the semi-axes a, b >= 0 along the coordinates.
///
/// An axis 0 makes a segment or a point, an infinite one a strip or the plane; all are legal and
/// treated as the boxes |x| <= a, |y| <= b that they are.
/// The projection is the root of a quartic; see ellipse_secular_equation. Each component is
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

  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (detail::any_nan(v(0), v(1))) return vector_type::Constant(detail::not_a_number<S>());
    if (is_box()) {
      for (int i = 0; i < 2; ++i) v(i) = std::clamp<S>(v(i), -axis(i), axis(i));
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
    if (!(length.value > S(0))) return matrix_type::Zero();  // a tip too sharp for the numbers
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
