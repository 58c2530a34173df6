// SPDX-License-Identifier: MIT
//
// Scalars: the real numbers that the library computes with.
//
// Intuition. A scalar is a totally ordered field with a square root, up to rounding.
//
// Minimal definition.
//     regular type (default, copy, ==), constructible from int, index and double
//     + - * / and unary −, += −= *= /=,   < <= > >=,   std::ostream << (for bad_input)
//     abs, sqrt, ldexp, frexp, found by argument-dependent lookup
//     std::numeric_limits: digits, max_exponent; epsilon, min, max, denorm_min, infinity, quiet_NaN
// Conversions may be explicit; results of operations may be expressions that convert to the scalar.
// Lengths are scaled by powers of two where their squares would leave the range: exactly, if ldexp
// is exact. Where vectors are Eigen's, Eigen asks for its Eigen::NumTraits<S> as well; the law
// checks and progress_bar convert to double by static_cast.
//
// Laws (up to rounding).   a + b = b + a,   a (b + c) = a b + a c,   sqrt(a)² = |a| for a ≥ 0,
//                          x − x is 0 for finite x and NaN otherwise (so no -ffast-math).
//
// Models. float, double, long double, boost::multiprecision::number,
//         slant::testing::archetype::scalar.
//
// Why numeric_limits and not a tolerance argument: every threshold in the library is a multiple of
// epsilon() times a quantity of the data, so the scalar itself must be able to say what epsilon is.
#pragma once

// The compiler would then remove every check for NaN and infinity, and with them bad_input and the
// statuses of breakdown: wrong answers that look right.
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "slant needs NaN and infinity: compile without -ffast-math, -Ofast and -ffinite-math-only"
#endif

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <ostream>

namespace slant {

/// Sizes and positions; the same type as Eigen::Index.
using index = std::ptrdiff_t;

template <class S>
concept has_field_arithmetic = requires(S const a, S const b) {
  S(a + b);
  S(a - b);
  S(a * b);
  S(a / b);
  S(-a);
};

template <class S>
concept has_compound_assignment = requires(S a, S const b) {
  a += b;
  a -= b;
  a *= b;
  a /= b;
};

template <class S>
concept has_order = requires(S const a, S const b) {
  bool(a < b);
  bool(a <= b);
  bool(a > b);
  bool(a >= b);
  bool(a == b);
};

/// Numbers of the code: counts, sizes, and constants such as 1.9.
template <class S>
concept has_constants = std::constructible_from<S, int> && std::constructible_from<S, index> &&
                        std::constructible_from<S, double>;

template <class S> concept has_text = requires(S const a, std::ostream& out) { out << a; };

namespace detail::by_argument {
using std::abs;
using std::frexp;
using std::ldexp;
using std::sqrt;
template <class S>
concept has_abs_and_sqrt = requires(S const a) {
  S(abs(a));
  S(sqrt(a));
};
template <class S>
concept has_ldexp_and_frexp = requires(S const a, int e) {
  S(ldexp(a, e));
  S(frexp(a, &e));
};
}  // namespace detail::by_argument

template <class S> concept has_square_root = detail::by_argument::has_abs_and_sqrt<S>;
template <class S> concept has_binary_exponent = detail::by_argument::has_ldexp_and_frexp<S>;

template <class S>
concept has_epsilon =
    std::numeric_limits<S>::is_specialized && requires { S(std::numeric_limits<S>::epsilon()); };

/// The ends of the range of numbers, and what lies beyond.
template <class S>
concept has_range = requires {
  requires std::numeric_limits<S>::digits > 0;
  requires std::numeric_limits<S>::max_exponent > 0;
  S(std::numeric_limits<S>::min());
  S(std::numeric_limits<S>::max());
  S(std::numeric_limits<S>::denorm_min());
  S(std::numeric_limits<S>::infinity());
  S(std::numeric_limits<S>::quiet_NaN());
};

/// A real number type; see the top of this file.
template <class S>
concept scalar = std::regular<S> && has_constants<S> && has_field_arithmetic<S> &&
                 has_compound_assignment<S> && has_order<S> && has_square_root<S> &&
                 has_binary_exponent<S> && has_epsilon<S> && has_range<S> && has_text<S>;

namespace detail {

/// Neither infinite nor NaN: x − x is 0 exactly for such x, and NaN otherwise.
template <class S>
[[nodiscard]] constexpr bool is_finite(S const& x) {
  return S(x - x) == S(0);
}

/// The distance from 1 to the next number.
template <class S>
[[nodiscard]] constexpr S epsilon() {
  return std::numeric_limits<S>::epsilon();
}

template <class S>
[[nodiscard]] constexpr S infinity() {
  return std::numeric_limits<S>::infinity();
}

/// e with 2^(e-1) <= |v| < 2^e for finite v != 0, and 0 for v = 0.
template <class S>
[[nodiscard]] int binary_exponent(S const& v) {
  using std::frexp;
  int e = 0;
  static_cast<void>(frexp(v, &e));
  return e;
}

/// 2^e.
template <class S>
[[nodiscard]] S power_of_two(int e) {
  using std::ldexp;
  return ldexp(S(1), e);
}

}  // namespace detail

}  // namespace slant
