// SPDX-License-Identifier: MIT
//
// The secular equations of the elliptic cone { (n, x₁, x₂) : (x₁/μ₁)² + (x₂/μ₂)² <= n² }, x₁, x₂ >=
// 0.
//
// Outside the cone and its polar, μ₁²x₁² + μ₂²x₂² <= n² with n <= 0, the foot p satisfies
// p_n (1 − t) = n and p_i (1 + t/μ_i²) = x_i with some t > 0. So, with q_i = p_i/μ_i and N = ‖q‖,
// p_n = N = n/(1 − t), which is an equation for t. To keep every digit it is written twice.
//
// n >= 0, 0 < t <= 1: with t = μ₁μ₂τ as for the ellipse (ellipse_secular.hpp), D_i = μ_i + μ_jτ,
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
// the numerator of Σ to any precision. Newton's method from the left of the root (secular_root.hpp)
// rises to it in both cases, and ends in double words.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/exact_squares.hpp>
#include <slant/sets/detail/secular_root.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>

namespace slant::detail {

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

}  // namespace slant::detail
