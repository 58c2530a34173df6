// SPDX-License-Identifier: MIT
//
// Scalars: the real numbers that the library computes with.
//
// Intuition. A scalar is a totally ordered field with a square root, up to rounding.
//
// Minimal definition. Regular type with + - * / and < <= ==, constructible from int, for which
// std::numeric_limits is specialised and abs, sqrt, ldexp, frexp are found by argument-dependent
// lookup. (Lengths are scaled by powers of two where their squares would leave the range: exact.)
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
concept has_order = requires(S const a, S const b) {
  bool(a < b);
  bool(a <= b);
  bool(a == b);
};

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
concept has_epsilon = std::numeric_limits<S>::is_specialized && requires {
  S(std::numeric_limits<S>::epsilon());
  S(std::numeric_limits<S>::infinity());
};

/// A real number type; see the top of this file.
template <class S>
concept scalar = std::regular<S> && std::constructible_from<S, int> && has_field_arithmetic<S> &&
                 has_order<S> && has_square_root<S> && has_binary_exponent<S> && has_epsilon<S>;

namespace detail {

/// Neither infinite nor NaN: x − x is 0 exactly for such x, and NaN otherwise.
template <class S>
[[nodiscard]] constexpr bool is_finite(S const& x) {
  return S(x - x) == S(0);
}

}  // namespace detail

}  // namespace slant
