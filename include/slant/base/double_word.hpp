// SPDX-License-Identifier: MIT
//
// Double-word arithmetic: an unevaluated sum hi + lo of two numbers of the same type, which carries
// about twice the digits. The sets use it where a difference cancels, so that a projection is as
// accurate as its data and not as accurate as the intermediate results.
//
// Source: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of
// double-word arithmetic", ACM TOMS 44 (2017); Dekker, Numer. Math. 18 (1971). The relative error
// of one operation is below 20 u², u half the machine epsilon, for binary rounding to nearest and
// as long as nothing leaves the range of normal numbers. (Needs a compiler that does not
// reassociate: -ffast-math would optimise the low words away.)
#pragma once

#include <slant/base/scaling.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace slant::detail {

template <class S>
struct double_word {
  S hi{0};
  S lo{0};

  double_word() = default;
  double_word(S const& value) : hi(value) {}  // NOLINT: a number is a double word, implicitly
  double_word(S const& high, S const& low) : hi(high), lo(low) {}
};

/// a + b exactly, provided |a| >= |b| or a = 0.
template <class S>
[[nodiscard]] double_word<S> ordered_sum(S const& a, S const& b) {
  S const s = a + b;
  return {s, b - (s - a)};
}

/// a + b exactly, for any a and b.
///
/// Types that are not built in: Boost's cpp_bin_float rounds a − b to the wrong neighbour when the
/// leading digit of b comes just after the last digit of a, so that sum is not formed at all.
template <class S>
[[nodiscard]] double_word<S> exact_sum(S const& a, S const& b) {
  if constexpr (!std::is_floating_point_v<S>) {
    using std::abs;
    if (abs(a) < abs(b)) return exact_sum(b, a);
    if (binary_exponent(a) - binary_exponent(b) > std::numeric_limits<S>::digits) return {a, b};
    return ordered_sum(a, b);
  }
  S const s = a + b;
  S const a_part = s - b;
  S const b_part = s - a_part;
  return {s, (a - a_part) + (b - b_part)};
}

/// Upper half of the digits of a (Veltkamp's splitting).
template <class S>
[[nodiscard]] S upper_half(S const& a) {
  S const factor = power_of_two<S>((std::numeric_limits<S>::digits + 1) / 2) + S(1);
  S const c = factor * a;
  return c - (c - a);
}

/// a b exactly. Hardware fused multiplication is used where the compiler promises it; then, and
/// only then, a compiler may contract products and sums, which would spoil Veltkamp's splitting.
template <class S>
[[nodiscard]] double_word<S> exact_product(S const& a, S const& b) {
  S const p = a * b;
#ifdef __FP_FAST_FMA
  if constexpr (std::is_same_v<S, double>) return {p, std::fma(a, b, -p)};
#endif
#ifdef __FP_FAST_FMAF
  if constexpr (std::is_same_v<S, float>) return {p, std::fma(a, b, -p)};
#endif
  S const a1 = upper_half(a), a2 = a - a1;
  S const b1 = upper_half(b), b2 = b - b1;
  return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

template <class S>
[[nodiscard]] double_word<S> operator-(double_word<S> const& a) {
  return {S(-a.hi), S(-a.lo)};
}

template <class S>
[[nodiscard]] double_word<S> operator+(double_word<S> const& a, double_word<S> const& b) {
  auto const s = exact_sum(a.hi, b.hi);
  auto const t = exact_sum(a.lo, b.lo);
  auto const v = ordered_sum(s.hi, S(s.lo + t.hi));
  return ordered_sum(v.hi, S(t.lo + v.lo));
}

template <class S>
[[nodiscard]] double_word<S> operator-(double_word<S> const& a, double_word<S> const& b) {
  return a + (-b);
}

template <class S>
[[nodiscard]] double_word<S> operator*(double_word<S> const& a, double_word<S> const& b) {
  auto const p = exact_product(a.hi, b.hi);
  return ordered_sum(p.hi, S(p.lo + (a.hi * b.lo + a.lo * b.hi)));
}

template <class S>
[[nodiscard]] double_word<S> operator/(double_word<S> const& a, double_word<S> const& b) {
  S const q = a.hi / b.hi;
  auto const remainder = a - b * double_word<S>(q);
  return ordered_sum(q, S(remainder.hi / b.hi));
}

/// a · 2^e.
template <class S>
[[nodiscard]] double_word<S> times_power_of_two(double_word<S> const& a, int e) {
  return {times_power_of_two<S>(a.hi, e), times_power_of_two<S>(a.lo, e)};
}

/// Square root of a >= 0.
template <class S>
[[nodiscard]] double_word<S> square_root(double_word<S> const& a) {
  using std::sqrt;
  S const r = sqrt(a.hi);
  if (!(r > S(0))) return r;
  auto const remainder = a - exact_product(r, r);
  return ordered_sum(r, S(remainder.hi / (r + r)));
}

/// Σ aᵢ bᵢ over two vectors of the same size.
template <class S, class Vector>
[[nodiscard]] double_word<S> precise_dot(Vector const& a, Vector const& b) {
  double_word<S> sum;
  for (auto i = a.size() - a.size(); i < a.size(); ++i) sum = sum + exact_product<S>(a(i), b(i));
  return sum;
}

// --- exact squares -------------------------------------------------------------------------------
//
// Sums and differences of squares of products, Σ ± (m v)², to about four times the digits of the
// format relative to the largest term: all products are split without error, and three sweeps of
// exact sums move the value to the last place before the rest is added (SumK with K = 4: Ogita,
// Rump, Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26, 2005).

/// At most N terms.
template <class S, int N>
class exact_squares {
 public:
  /// + (m v)².
  void add(S const& m, S const& v) { put(m, v, S(1)); }
  /// − (m v)².
  void subtract(S const& m, S const& v) { put(m, v, S(-1)); }

  /// Uses the terms up.
  [[nodiscard]] double_word<S> sum() {
    for (int sweep = 0; sweep < 3; ++sweep) {
      for (std::size_t i = 1; i < count_; ++i) {
        auto const s = exact_sum(terms_[i - 1], terms_[i]);
        terms_[i - 1] = s.lo;
        terms_[i] = s.hi;
      }
    }
    double_word<S> value;
    for (std::size_t i = 0; i < count_; ++i) value = value + double_word<S>(terms_[i]);
    return value;
  }

 private:
  void put(S const& m, S const& v, S const& sign) {
    auto const mm = exact_product(m, m);
    auto const vv = exact_product(v, v);
    for (S const& a : {mm.lo, mm.hi}) {
      for (S const& b : {vv.lo, vv.hi}) {
        auto const product = exact_product<S>(a, b);
        terms_[count_++] = sign * product.lo;
        terms_[count_++] = sign * product.hi;
      }
    }
  }

  std::array<S, 8 * N> terms_;
  std::size_t count_ = 0;
};

}  // namespace slant::detail
