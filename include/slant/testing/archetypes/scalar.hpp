// SPDX-License-Identifier: MIT
//
// The least that is a scalar: a double that converts from other numbers only where the code says
// so, and to none. What compiles with it mixes no number types silently: an `int` or `double` that
// slips into an expression of scalars is an error, as it would be a loss with a multiprecision
// scalar.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <cmath>
#include <iosfwd>
#include <limits>

namespace slant::testing::archetype {

class scalar {
 public:
  constexpr scalar() = default;
  constexpr explicit scalar(int value) : value_(value) {}
  constexpr explicit scalar(index value) : value_(static_cast<double>(value)) {}
  constexpr explicit scalar(double value) : value_(value) {}
  scalar(bool) = delete;
  /// For tests to compare.
  [[nodiscard]] constexpr double value() const { return value_; }

  friend constexpr scalar operator+(scalar a, scalar b) { return scalar(a.value_ + b.value_); }
  friend constexpr scalar operator-(scalar a, scalar b) { return scalar(a.value_ - b.value_); }
  friend constexpr scalar operator*(scalar a, scalar b) { return scalar(a.value_ * b.value_); }
  friend constexpr scalar operator/(scalar a, scalar b) { return scalar(a.value_ / b.value_); }
  friend constexpr scalar operator-(scalar a) { return scalar(-a.value_); }
  constexpr scalar& operator+=(scalar b) { return *this = *this + b; }
  constexpr scalar& operator-=(scalar b) { return *this = *this - b; }
  constexpr scalar& operator*=(scalar b) { return *this = *this * b; }
  constexpr scalar& operator/=(scalar b) { return *this = *this / b; }
  friend constexpr bool operator==(scalar a, scalar b) { return a.value_ == b.value_; }
  friend constexpr auto operator<=>(scalar a, scalar b) { return a.value_ <=> b.value_; }

  friend scalar abs(scalar a) { return scalar(std::fabs(a.value_)); }
  friend scalar sqrt(scalar a) { return scalar(std::sqrt(a.value_)); }
  friend scalar ldexp(scalar a, int exponent) { return scalar(std::ldexp(a.value_, exponent)); }
  friend scalar frexp(scalar a, int* exponent) { return scalar(std::frexp(a.value_, exponent)); }
  template <class Char, class Traits>
  friend auto& operator<<(std::basic_ostream<Char, Traits>& out, scalar a) {
    return out << a.value_;
  }

 private:
  double value_ = 0;
};

}  // namespace slant::testing::archetype

template <>
class std::numeric_limits<slant::testing::archetype::scalar> {
  using scalar = slant::testing::archetype::scalar;
  using base = std::numeric_limits<double>;

 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = base::digits;
  static constexpr int max_exponent = base::max_exponent;
  static constexpr scalar epsilon() { return scalar(base::epsilon()); }
  static constexpr scalar min() { return scalar(base::min()); }
  static constexpr scalar max() { return scalar(base::max()); }
  static constexpr scalar denorm_min() { return scalar(base::denorm_min()); }
  static constexpr scalar infinity() { return scalar(base::infinity()); }
  static constexpr scalar quiet_NaN() { return scalar(base::quiet_NaN()); }
};

/// What Eigen asks for.
template <>
struct Eigen::NumTraits<slant::testing::archetype::scalar> : Eigen::GenericNumTraits<double> {
  using Real = slant::testing::archetype::scalar;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  static constexpr Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static constexpr Real dummy_precision() { return Real(1e-12); }
  static constexpr Real highest() { return std::numeric_limits<Real>::max(); }
  static constexpr Real lowest() { return -std::numeric_limits<Real>::max(); }
  static constexpr Real infinity() { return std::numeric_limits<Real>::infinity(); }
  static constexpr Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
};

namespace slant::testing::archetype {

static_assert(slant::scalar<scalar>);
static_assert(!std::convertible_to<double, scalar> && !std::convertible_to<int, scalar> &&
              !std::constructible_from<double, scalar>);

}  // namespace slant::testing::archetype
