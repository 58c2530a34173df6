// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/sets/detail/double_word.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <cmath>
#include <limits>

namespace slant::detail {

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
    S const ab_tau = largest(S(0), a_ * (b_ * τ2.hi), S(0));
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
    S lower = largest(S(0), (x_ - a_) / b_, (y_ - b_) / a_);  // X or Y is 1: G >= 0
    S upper =
        largest(lower, (root2 * x_ - a_) / b_, (root2 * y_ - b_) / a_);  // X², Y² <= 1/2: G <= 0
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
      τ = largest(S(0), τ + step, S(0));
      if (!(S(abs(step)) * a_ > tolerance * (b_ + a_ * τ))) break;
    }
    return τ;
  }

  [[nodiscard]] static S largest(S const& u, S const& v, S const& w) {
    S const m = u < v ? v : u;
    return m < w ? w : m;
  }

  S a_, b_, x_, y_;
};

}  // namespace slant::detail
