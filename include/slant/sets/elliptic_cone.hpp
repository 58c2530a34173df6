// SPDX-License-Identifier: MIT
//
// The elliptic cone { (x_n, x₁, x₂) : (x₁/μ₁)² + (x₂/μ₂)² <= x_n² }, x_n >= 0: normal pressure and
// friction on an orthotropic surface, which holds better along one axis than along the other.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>
#include <slant/sets/parts/cone_projection.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- step ----------------------------------------------------------------------------------------
//
// Lengths and longest steps in the elliptic cone.

/// ‖(x₁/μ₁, x₂/μ₂)‖, or ‖(μ₁x₁, μ₂x₂)‖, with its exponent apart.
template <class S>
[[nodiscard]] scaled_number<S> elliptic_length(Eigen::Matrix<S, 2, 1> const& μ,
                                               Eigen::Matrix<S, 3, 1> const& x, bool divide) {
  Eigen::Matrix<S, 2, 1> u;
  int exponent[2];
  int largest = 0;
  bool any = false;
  for (int i = 0; i < 2; ++i) {
    int const e = binary_exponent<S>(x(1 + i)), k = binary_exponent<S>(μ(i));
    S const a = times_power_of_two<S>(x(1 + i), -e), m = times_power_of_two<S>(μ(i), -k);
    u(i) = divide ? S(a / m) : S(a * m);
    exponent[i] = divide ? e - k : e + k;
    if (u(i) != S(0) && (!any || exponent[i] > largest)) {
      largest = exponent[i];
      any = true;
    }
  }
  for (int i = 0; i < 2; ++i) u(i) = times_power_of_two<S>(u(i), exponent[i] - largest);
  auto const length = scaled_norm<S, 2>(u);
  return {length.value, length.exponent + largest};
}

/// (n, x₁/μ₁, x₂/μ₂) in double words and in units of 2^exponent, of order one at most.
template <class S>
struct elliptic_coordinates {
  double_word<S> axis, u[2];
  int exponent = 0;

  elliptic_coordinates(Eigen::Matrix<S, 2, 1> const& μ, Eigen::Matrix<S, 3, 1> const& x) {
    int own[3];
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      own[i] = binary_exponent<S>(x(i)) - (i > 0 ? binary_exponent<S>(μ(i - 1)) : 0);
      if (x(i) != S(0) && (!any || own[i] > exponent)) {
        exponent = own[i];
        any = true;
      }
    }
    axis = times_power_of_two<S>(x(0), -exponent);
    for (int i = 0; i < 2; ++i) {
      double_word<S> const m(times_power_of_two<S>(μ(i), -binary_exponent<S>(μ(i))));
      double_word<S> const v(times_power_of_two<S>(x(1 + i), -binary_exponent<S>(x(1 + i))));
      u[i] = times_power_of_two(v / m, own[1 + i] - exponent);
    }
  }
};

/// sup{α >= 0 : x + α d in the cone} for x in the cone and d not in it; see
/// parts/cone_projection.hpp.
template <class S>
[[nodiscard]] S elliptic_cone_step(Eigen::Matrix<S, 2, 1> const& μ, Eigen::Matrix<S, 3, 1> const& x,
                                   Eigen::Matrix<S, 3, 1> const& d) {
  S const to_apex = d(0) < S(0) ? S(-(x(0) < S(0) ? S(0) : x(0)) / d(0)) : infinity<S>();
  elliptic_coordinates<S> const u(μ, x), v(μ, d);
  auto const form = [](elliptic_coordinates<S> const& a, elliptic_coordinates<S> const& b) {
    return a.u[0] * b.u[0] + a.u[1] * b.u[1] - a.axis * b.axis;
  };
  S const to_quadric = times_power_of_two<S>(exit_root<S>(form(v, v), form(u, v), -form(u, u)),
                                             u.exponent - v.exponent);
  return to_apex < to_quadric ? to_apex : to_quadric;
}

// --- secular root --------------------------------------------------------------------------------
//
// Root of a secular equation: of a function on [0, ∞) that is positive on the left of its only root
// and negative on the right, for which Newton's method (perhaps for another form of it) from the
// left rises monotonically to the root. Halving on a logarithmic scale first brings the start near,
// so the number of steps is bounded; the last ones are corrections with the residual in double
// words.

/// A number in working precision, whether it comes as one or as a double word.
template <class S>
[[nodiscard]] S value_of(double_word<S> const& v) {
  return v.hi;
}
template <class S>
[[nodiscard]] S value_of(S const& v) {
  return v;
}

/// A double word as T, itself or its upper part.
template <class T, class S>
[[nodiscard]] T narrow(double_word<S> const& v) {
  if constexpr (std::is_same_v<T, S>) {
    return v.hi;
  } else {
    return v;
  }
}

template <class S>
[[nodiscard]] double_word<S> root(double_word<S> const& v) {
  return square_root(v);
}
template <class S>
[[nodiscard]] S root(S const& v) {
  using std::sqrt;
  return sqrt(v);
}

/// Equation has residual<T>(z), gain(z) = −step per residual, lower(), upper() bounds of the root,
/// threshold() below which z changes little, and scale(z), what an error of z is measured by.
template <class S, class Equation>
[[nodiscard]] double_word<S> secular_root(Equation const& equation) {
  using std::abs;
  using std::sqrt;
  S const δ = equation.threshold();
  S lower = equation.lower(), upper = equation.upper();
  while (δ + upper > S(4) * (δ + lower)) {
    S const middle = sqrt(δ + upper) * sqrt(δ + lower) - δ;
    if (!(middle > lower && middle < upper)) break;
    (equation.template residual<S>(middle) > S(0) ? lower : upper) = middle;
  }
  S const enough = sqrt(std::numeric_limits<S>::epsilon()) / S(16);
  S z = lower;
  for (int i = 0; i < 64; ++i) {  // the bound only excludes a hang
    S const step = equation.template residual<S>(z) * equation.gain(z);
    S const next = z + step;
    z = next > S(0) ? next : S(0);
    if (!(S(abs(step)) > enough * equation.scale(z))) break;
  }
  for (int i = 0; i < 8; ++i) {
    S const step =
        equation.template residual<double_word<S>>(double_word<S>(z)).hi * equation.gain(z);
    auto const sum = exact_sum(z, step);
    if (!(sum.hi > S(0))) return double_word<S>(z);
    if (!(S(abs(step)) > enough * equation.scale(sum.hi))) return sum;
    z = sum.hi;
  }
  return double_word<S>(z);
}

// --- secular -------------------------------------------------------------------------------------
//
// The secular equations of the elliptic cone { (n, x₁, x₂) : (x₁/μ₁)² + (x₂/μ₂)² <= n² }, x₁, x₂ >=
// 0.
//
// Outside the cone and its polar, μ₁²x₁² + μ₂²x₂² <= n² with n <= 0, the foot p satisfies
// p_n (1 − t) = n and p_i (1 + t/μ_i²) = x_i with some t > 0. So, with q_i = p_i/μ_i and N = ‖q‖,
// p_n = N = n/(1 − t), which is an equation for t. To keep every digit it is written twice.
//
// n >= 0, 0 < t <= 1: with t = μ₁μ₂τ as for the ellipse (ellipse.hpp), D_i = μ_i + μ_jτ,
//
//     q_i = x_i/D_i,    H(τ) = (1 − t) N − n = (A − τ μ₂ B)/D₁ + (1 − t) q₂²/(N + q₁) = 0,
//     A = x₁ − μ₁n,  B = μ₁x₁ + n.
//
// The last form has no cancellation that is not in the data; n/N − (1 − t) is concave and rises.
//
// n < 0, t > 1: with s = 1/(1 + t) in (0, ½), ν = −n, D_i = 1 − s + μ_i²s,
//
//     q_i = μ_ix_i/D_i,    p_i = s μ_i q_i,    p_n = s N,    R(s) = (1 − 2s) N − ν = 0,
//
// convex and falling. Near the polar cone, where s and p vanish together, R = Σ − D with
//
//     Σ = N(0) − ν = (μ₁²x₁² + μ₂²x₂² − ν²)/(N(0) + ν),
//     D = N(0) − (1 − 2s) N = s (2N + Σ q_i² (μ_i² − 1)(2 + s(μ_i² − 1))/(N(0) + N)),
//
// the numerator of Σ to any precision. Newton's method from the left of the root (section secular
// root) rises to it in both cases, and ends in double words.

/// The foot in terms of the point: p_i = ratio_i x_i.
template <class S>
struct elliptic_foot {
  S normal;                     ///< p_n
  Eigen::Array<S, 2, 1> ratio;  ///< p_i/x_i, in [0, 1]
  Eigen::Array<S, 2, 1> unit;   ///< p_i/(μ_i p_n), a unit vector
  S t, one;                     ///< the multiplier is t/one
};

/// n >= 0: the equation for τ. All of order one, μ₁ >= μ₂ > 0.
template <class S>
class upper_cone_equation {
 public:
  upper_cone_equation(std::array<S, 2> const& μ, S const& n, std::array<S, 2> const& x)
      : μ_(μ),
        x_(x),
        n_(n),
        A_(word(x[0]) - exact_product(μ[0], n)),
        B_(exact_product(μ[0], x[0]) + word(n)) {}

  /// The point is in the cone.
  [[nodiscard]] bool inside() const { return residual<word>(word(S(0))).hi <= S(0); }

  /// H(τ); T is S or a double word of it.
  template <class T>
  [[nodiscard]] T residual(T const& τ) const {
    auto const [D1, D2] = denominators(τ);
    T const q1 = T(x_[0]) / D1, q2 = T(x_[1]) / D2;
    T const N = root(q1 * q1 + q2 * q2);
    T const flat = (narrow<T>(A_) - τ * (T(μ_[1]) * narrow<T>(B_))) / D1;
    if (!(value_of(q2) > S(0))) return flat;
    T const t = T(μ_[0]) * (T(μ_[1]) * τ);
    return flat + (T(S(1)) - t) * (q2 * (q2 / (N + q1)));
  }
  /// −τ-step per unit of H: Newton's for n/N − (1 − t).
  [[nodiscard]] S gain(S const& τ) const {
    using std::sqrt;
    auto const [D1, D2] = denominators(τ);
    S const q1 = x_[0] / D1, q2 = x_[1] / D2, N = sqrt(q1 * q1 + q2 * q2);
    S const c = q1 / N, d = q2 / N;
    return S(1) / (n_ * (c * c * (μ_[1] / D1) + d * d * (μ_[0] / D2)) + N * (μ_[0] * μ_[1]));
  }
  [[nodiscard]] S lower() const { return bound(S(1)); }
  [[nodiscard]] S upper() const {
    using std::sqrt;
    return bound(S(sqrt(S(2))));
  }
  /// τ changes nothing below this size.
  [[nodiscard]] S threshold() const { return μ_[1] / μ_[0]; }
  [[nodiscard]] S scale(S const& τ) const { return threshold() + τ; }

  [[nodiscard]] elliptic_foot<S> foot(double_word<S> const& τ) const {
    auto const [D1, D2] = denominators(τ);
    auto const q1 = word(x_[0]) / D1, q2 = word(x_[1]) / D2;
    auto const N = square_root(q1 * q1 + q2 * q2);
    return {N.hi,
            {(word(μ_[0]) / D1).hi, (word(μ_[1]) / D2).hi},
            {(q1 / N).hi, (q2 / N).hi},
            μ_[0] * (μ_[1] * τ.hi),
            S(1)};
  }

 private:
  using word = double_word<S>;

  template <class T>
  [[nodiscard]] std::array<T, 2> denominators(T const& τ) const {
    return {T(μ_[0]) + T(μ_[1]) * τ, T(μ_[1]) + T(μ_[0]) * τ};
  }
  /// N is between the larger |q_i| and √2 times that, so τ between the roots that these have.
  [[nodiscard]] S bound(S const& factor) const {
    S largest(0);
    for (std::size_t i = 0; i < 2; ++i) {
      S const x = factor * x_[i];
      S const τ = (x - n_ * μ_[i]) / (μ_[1 - i] * (μ_[i] * x + n_));
      if (x > S(0) && τ > largest) largest = τ;
    }
    return largest;
  }

  std::array<S, 2> μ_, x_;
  S n_;
  word A_, B_;
};

/// n = −ν < 0: the equation for s. All of order one, μ₁ >= μ₂ > 0.
template <class S>
class lower_cone_equation {
 public:
  lower_cone_equation(std::array<S, 2> const& μ, S const& ν, std::array<S, 2> const& x)
      : μ_(μ), x_(x), ν_(ν) {
    auto const a = exact_product(μ[0], x[0]), b = exact_product(μ[1], x[1]);
    N0_ = square_root(a * a + b * b);
    excess_ = N0_ - word(ν);
    using std::abs;
    if (S(abs(excess_.hi)) * S(1024) < ν) {
      exact_squares<S, 3> squares;
      squares.add(μ[0], x[0]);
      squares.add(μ[1], x[1]);
      squares.subtract(S(1), ν);
      excess_ = squares.sum() / (N0_ + word(ν));
    }
    near_polar_ = excess_.hi < ν;
  }

  /// The point is in the polar cone.
  [[nodiscard]] bool polar() const { return excess_.hi <= S(0); }

  /// R(s); T is S or a double word of it.
  template <class T>
  [[nodiscard]] T residual(T const& s) const {
    auto const q = generator(s);
    T const N = root(q[0] * q[0] + q[1] * q[1]);
    if (!near_polar_) return (T(S(1)) - (s + s)) * N - T(ν_);
    T sum = T(S(0));
    for (std::size_t i = 0; i < 2; ++i) {
      T const c = T(μ_[i]) * T(μ_[i]) - T(S(1));
      sum = sum + q[i] * (q[i] * (c * (T(S(2)) + s * c)));
    }
    return narrow<T>(excess_) - s * (N + N + sum / (narrow<T>(N0_) + N));
  }
  /// 1/(−R′).
  [[nodiscard]] S gain(S const& s) const {
    using std::sqrt;
    auto const q = generator(s);
    S const N = sqrt(q[0] * q[0] + q[1] * q[1]);
    S slope(2);
    for (std::size_t i = 0; i < 2; ++i) {
      S const w = q[i] / N, c = (μ_[i] - S(1)) * (μ_[i] + S(1));
      slope += (S(1) - S(2) * s) * (w * w * (c / (S(1) + s * c)));
    }
    return S(1) / (N * slope);
  }
  [[nodiscard]] S lower() const { return bound(S(1)); }
  [[nodiscard]] S upper() const {
    using std::sqrt;
    return bound(S(sqrt(S(2))));
  }
  [[nodiscard]] S threshold() const { return μ_[0] > S(1) ? S(S(1) / μ_[0] / μ_[0]) : S(1); }
  [[nodiscard]] S scale(S const& s) const { return s; }

  [[nodiscard]] elliptic_foot<S> foot(double_word<S> const& s) const {
    auto const q = generator(s);
    auto const N = square_root(q[0] * q[0] + q[1] * q[1]);
    elliptic_foot<S> result{(s * N).hi, {}, {(q[0] / N).hi, (q[1] / N).hi}, S(1) - s.hi, s.hi};
    for (std::size_t i = 0; i < 2; ++i) {
      auto const m = exact_product(μ_[i], μ_[i]);
      result.ratio(index(i)) = (s * m / denominator(m, s)).hi;
    }
    return result;
  }

 private:
  using word = double_word<S>;

  template <class T>
  [[nodiscard]] static T denominator(T const& square, T const& s) {
    return (T(S(1)) - s) + square * s;
  }
  template <class T>
  [[nodiscard]] std::array<T, 2> generator(T const& s) const {
    std::array<T, 2> q;
    for (std::size_t i = 0; i < 2; ++i) {
      T const m = T(μ_[i]);
      q[i] = m * T(x_[i]) / denominator<T>(m * m, s);
    }
    return q;
  }
  [[nodiscard]] S bound(S const& factor) const {
    S largest(0);
    for (std::size_t i = 0; i < 2; ++i) {
      S const m = factor * (μ_[i] * x_[i]);
      if (!(m > ν_)) continue;
      S const s = (m - ν_) / ((m - ν_) + m + ν_ * μ_[i] * μ_[i]);
      if (s > largest) largest = s;
    }
    return largest < S(0.5) ? largest : S(0.5);
  }

  std::array<S, 2> μ_, x_;
  S ν_;
  word N0_, excess_;
  bool near_polar_ = false;
};

// --- foot ----------------------------------------------------------------------------------------
//
// Nearest point of the elliptic cone: picks the units and the equation.

/// The region of a point, and its foot if that is on the mantle: of |x|, in units of 2^exponent.
template <class S>
struct elliptic_cone_point {
  cone_region region;
  elliptic_foot<S> foot{};
  int exponent = 0;
};

/// Nearest point for finite x and μ > 0 in any order.
template <class S>
[[nodiscard]] elliptic_cone_point<S> nearest_on_elliptic_cone(Eigen::Matrix<S, 2, 1> const& mu,
                                                              Eigen::Matrix<S, 3, 1> const& point) {
  using std::abs;
  if (point(1) == S(0) && point(2) == S(0)) {
    return {point(0) >= S(0) ? cone_region::inside : cone_region::apex};
  }
  int const e = binary_exponent(point);
  Eigen::Matrix<S, 3, 1> const v = times_power_of_two<S, 3>(point, -e);
  int const i = mu(0) < mu(1) ? 1 : 0, j = 1 - i;
  std::array<S, 2> const μ{mu(i), mu(j)}, x{S(abs(v(1 + i))), S(abs(v(1 + j)))};
  elliptic_cone_point<S> found{cone_region::mantle, {}, e};
  if (v(0) >= S(0)) {
    upper_cone_equation<S> const equation(μ, v(0), x);
    if (equation.inside()) return {cone_region::inside};
    found.foot = equation.foot(secular_root<S>(equation));
  } else {
    lower_cone_equation<S> const equation(μ, S(-v(0)), x);
    if (equation.polar()) return {cone_region::apex};
    found.foot = equation.foot(secular_root<S>(equation));
  }
  if (i == 1) {
    std::swap(found.foot.ratio(0), found.foot.ratio(1));
    std::swap(found.foot.unit(0), found.foot.unit(1));
  }
  return found;
}

// --- slant ---------------------------------------------------------------------------------------
//
// Derivative of the projection onto the elliptic cone where it lands on the mantle, at the foot p.
//
// With E = diag(−1, 1/μ₁², 1/μ₂²) the foot satisfies x = p + t E p and pᵀE p = 0. So G is 0 along
// the normal E p, 1 along p, which is orthogonal to it, and for the third direction T
//
//     G = p pᵀ/‖p‖² + θ T Tᵀ,     θ = 1/(1 + t TᵀE T)      (T of length 1, T ⟂ p, E p).
//
// In terms of the unit vector Y = (p₁/μ₁, p₂/μ₂)/p_n and α = 1 + μ₁², β = 1 + μ₂² the direction is
//
//     V = p × E p ~ ((1/β − 1/α) Y₁Y₂, −(μ₁/α) Y₂, (μ₂/β) Y₁),    VᵀE V = (Y₁²/β + Y₂²/α)²,
//
// sums of terms of one sign; the curvature of a round cone is 1/μ².

/// G at x, with the foot of |x|.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 3, 3> elliptic_mantle_slant(Eigen::Matrix<S, 2, 1> const& μ,
                                                           elliptic_foot<S> const& foot,
                                                           Eigen::Matrix<S, 3, 1> const& x) {
  using vector = Eigen::Matrix<S, 3, 1>;
  S const Y1 = x(1) < S(0) ? S(-foot.unit(0)) : foot.unit(0);
  S const Y2 = x(2) < S(0) ? S(-foot.unit(1)) : foot.unit(1);
  S const α = S(1) + μ(0) * μ(0), β = S(1) + μ(1) * μ(1);
  auto const normalised = [](vector const& v, S& length) -> vector {
    auto const l = scaled_norm<S, 3>(v);
    length = times_power_of_two<S>(l.value, l.exponent);
    return times_power_of_two<S, 3>(v, -l.exponent) / l.value;
  };
  S length(0);
  vector const w = normalised(vector(S(1), μ(0) * Y1, μ(1) * Y2), length);
  vector const T = normalised(vector((μ(0) - μ(1)) * ((μ(0) + μ(1)) / (α * β)) * (Y1 * Y2),
                                     -(μ(0) / α) * Y2, (μ(1) / β) * Y1),
                              length);
  S const curvature = (Y1 * Y1 / β + Y2 * Y2 / α) / length;
  S const θ = foot.one / (foot.one + foot.t * curvature * curvature);
  Eigen::Matrix<S, 3, 3> G;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) G(i, j) = w(i) * w(j) + θ * (T(i) * T(j));
  }
  return G;
}

}  // namespace slant::detail

namespace slant {

// --- elliptic cone -------------------------------------------------------------------------------

/// { x ∈ R³ : (x₁/μ₁)² + (x₂/μ₂)² <= x_n², x_n >= 0 }, x_n = x₀ the axis; μ₁, μ₂ are 0 or in the
/// sixth part of the exponent range of S: 1e±51 for double, 1e±6 for float.
///
/// A coefficient 0 makes it flat: a plane cone, for two the ray; all are legal. The projection is
/// the root of a quartic, see section secular. Each component is within 2 ulp at
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
  /// polar cone (apex excluded), otherwise that of section slant. A flat cone has
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
