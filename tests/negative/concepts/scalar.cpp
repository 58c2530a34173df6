// SPDX-License-Identifier: MIT
// case WITHOUT_COMPOUND_ASSIGNMENT: satisfaction of 'has_compound_assignment<S>' .with S = fixed_point.
// case WITHOUT_COMPOUND_ASSIGNMENT, clang: 'fixed_point' does not satisfy 'has_compound_assignment'
// case WITHOUT_SQUARE_ROOT: satisfaction of 'has_square_root<S>' .with S = fixed_point.
// case WITHOUT_SQUARE_ROOT, clang: 'fixed_point' does not satisfy 'has_square_root'
// case WITHOUT_EPSILON: satisfaction of 'has_epsilon<S>' .with S = fixed_point.
// case WITHOUT_EPSILON, clang: 'fixed_point' does not satisfy 'has_epsilon'
// case WITHOUT_RANGE: satisfaction of 'has_range<S>' .with S = fixed_point.
// case WITHOUT_RANGE, clang: 'fixed_point' does not satisfy 'has_range'
// max-lines-gcc: 20
// max-lines-clang: 20
//
// A complete scalar minus the assignments that add to it, subtract from it, …, its square root, what
// it knows of its own precision, std::numeric_limits, or its largest number: norms could not be
// scaled into its range.
#include <slant/concepts/scalar.hpp>

#include <ostream>

struct fixed_point {
  fixed_point() = default;
  fixed_point(int v) : value(v) {}
  friend fixed_point operator+(fixed_point, fixed_point) { return {}; }
  friend fixed_point operator-(fixed_point, fixed_point) { return {}; }
  friend fixed_point operator*(fixed_point, fixed_point) { return {}; }
  friend fixed_point operator/(fixed_point, fixed_point) { return {}; }
  friend fixed_point operator-(fixed_point a) { return a; }
  friend fixed_point abs(fixed_point a) { return a; }
  friend fixed_point ldexp(fixed_point a, int) { return a; }
  friend fixed_point frexp(fixed_point a, int*) { return a; }
#ifndef WITHOUT_SQUARE_ROOT
  friend fixed_point sqrt(fixed_point a) { return a; }
#endif
#ifndef WITHOUT_COMPOUND_ASSIGNMENT
  fixed_point& operator+=(fixed_point) { return *this; }
  fixed_point& operator-=(fixed_point) { return *this; }
  fixed_point& operator*=(fixed_point) { return *this; }
  fixed_point& operator/=(fixed_point) { return *this; }
#endif
  friend std::ostream& operator<<(std::ostream& out, fixed_point a) { return out << a.value; }
  friend auto operator<=>(fixed_point const&, fixed_point const&) = default;
  int value = 0;
};

#ifndef WITHOUT_EPSILON
template <>
struct std::numeric_limits<fixed_point> {
  static constexpr bool is_specialized = true;
  static fixed_point epsilon() { return 1; }
  static constexpr int digits = 1;
  static constexpr int max_exponent = 1;
  static fixed_point min() { return 1; }
#ifndef WITHOUT_RANGE
  static fixed_point max() { return 1; }
#endif
  static fixed_point denorm_min() { return 1; }
  static fixed_point infinity() { return 1; }
  static fixed_point quiet_NaN() { return 1; }
};
#endif

static_assert(slant::scalar<fixed_point>);
