// SPDX-License-Identifier: MIT
//
// A stochastic scalar: three samples of a computation with random rounding, and from their spread
// the number of digits that rounding has left.
//
// Every operation whose result is not exact is rounded up or down, with probability 1/2 each, in
// each of the three samples; exact results stay exact. After a computation the samples differ where
// rounding has reached, and Student's test says how many digits they have in common:
//
//     digits = log₁₀( √3 |x̄| / (4.303 s) ),   x̄ the mean, s the standard deviation,
//
// with probability 95 %, as long as errors of first order dominate. The first two samples draw
// their direction, the third takes the opposite of the second: an inexact result never looks exact.
//
// Random rounding needs no rounding mode: the error of a sum, product, quotient or square root in
// round to nearest is known exactly (TwoSum; fused multiply-add), and its sign says on which side
// the other neighbour lies. Where an error underflows, the result counts as exact.
//
// Branches. Comparisons look at the means, so all samples take the same branch, and a method runs
// unchanged: slant::solve(slant::kprgp{qp}, …) with qp of stochastic<double>.
//
// Cost: an operation takes about 30 times as long as one of double.
//
// Sources: Vignes, "Discrete stochastic arithmetic for validating results of numerical software",
// Numer. Algorithms 37 (2004); Jézéquel and Chesneaux, "CADNA", Comput. Phys. Commun. 178 (2008).
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>

namespace slant::testing {

namespace detail {

/// splitmix64 of Steele, Lea and Flood; one per thread.
inline std::uint64_t& state_of_rounding() {
  thread_local std::uint64_t state = 0;
  return state;
}

inline std::uint64_t random_bits() {
  std::uint64_t z = state_of_rounding() += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// r or, if `away`, the neighbour of r on the side of the error: r + error is exact.
template <std::floating_point T>
[[nodiscard]] T rounded(T r, T error, bool away) {
  constexpr T inf = std::numeric_limits<T>::infinity();
  if (!away || !(error < 0 || error > 0) || !(std::fabs(r) < inf)) return r;
  return std::nextafter(r, error > 0 ? inf : -inf);
}

}  // namespace detail

/// Seeds the random roundings of this thread: the same seed, the same samples.
inline void seed_rounding(std::uint64_t seed) {
  detail::state_of_rounding() = seed;
}

/// A number in three samples; see the top of this file.
template <std::floating_point T = double>
class stochastic {
 public:
  constexpr stochastic() = default;
  constexpr explicit stochastic(int value) : stochastic(static_cast<T>(value)) {}
  constexpr explicit stochastic(index value) : stochastic(static_cast<T>(value)) {}
  /// An exact number.
  template <std::floating_point N>
  constexpr explicit stochastic(N value)
      : stochastic(static_cast<T>(value), static_cast<T>(value), static_cast<T>(value)) {}
  /// Three samples of one quantity.
  constexpr stochastic(T a, T b, T c) : x_{a, b, c} {}

  [[nodiscard]] constexpr T sample(int i) const { return x_[i]; }
  /// The value that comparisons see.
  [[nodiscard]] constexpr T mean() const {
    if (is_exact()) return x_[0];
    return x_[0] + ((x_[1] - x_[0]) + (x_[2] - x_[0])) / T(3);
  }
  /// The mean, in another arithmetic type; never a truth value.
  template <class N>
    requires(std::floating_point<N> || (std::integral<N> && !std::same_as<N, bool>))
  constexpr explicit operator N() const {
    return static_cast<N>(mean());
  }

  friend stochastic operator+(stochastic const& a, stochastic const& b) {
    return each(a, b, [](T x, T y, bool away) {
      T const s = x + y, x_part = s - y, y_part = s - x_part;
      return detail::rounded(s, (x - x_part) + (y - y_part), away);
    });
  }
  friend stochastic operator-(stochastic const& a, stochastic const& b) { return a + -b; }
  friend stochastic operator*(stochastic const& a, stochastic const& b) {
    return each(a, b, [](T x, T y, bool away) {
      T const p = x * y;
      return detail::rounded(p, std::fma(x, y, -p), away);
    });
  }
  friend stochastic operator/(stochastic const& a, stochastic const& b) {
    return each(a, b, [](T x, T y, bool away) {
      T const q = x / y, remainder = std::fma(-q, y, x);
      return detail::rounded(q, y < 0 ? -remainder : remainder, away);
    });
  }
  friend constexpr stochastic operator-(stochastic const& a) {
    return {-a.x_[0], -a.x_[1], -a.x_[2]};
  }
  stochastic& operator+=(stochastic const& b) { return *this = *this + b; }
  stochastic& operator-=(stochastic const& b) { return *this = *this - b; }
  stochastic& operator*=(stochastic const& b) { return *this = *this * b; }
  stochastic& operator/=(stochastic const& b) { return *this = *this / b; }
  friend constexpr bool operator==(stochastic const& a, stochastic const& b) {
    return a.mean() == b.mean();
  }
  friend constexpr auto operator<=>(stochastic const& a, stochastic const& b) {
    return a.mean() <=> b.mean();
  }

  /// All samples keep or change their sign, as the mean does: their spread stays.
  friend constexpr stochastic abs(stochastic const& a) { return a.mean() < 0 ? -a : a; }
  /// A negative sample of a number >= 0 is one of zero.
  friend stochastic sqrt(stochastic const& a) {
    if (a.mean() < 0) return stochastic(std::numeric_limits<T>::quiet_NaN());
    return each(a, a, [](T x, T, bool away) {
      T const r = std::sqrt(x < 0 ? T(0) : x);
      return detail::rounded(r, std::fma(-r, r, x), away && x > 0);
    });
  }
  friend stochastic ldexp(stochastic const& a, int exponent) {
    return {std::ldexp(a.x_[0], exponent), std::ldexp(a.x_[1], exponent),
            std::ldexp(a.x_[2], exponent)};
  }
  /// The exponent is that of the mean.
  friend stochastic frexp(stochastic const& a, int* exponent) {
    (void)std::frexp(a.mean(), exponent);
    if (*exponent < std::numeric_limits<T>::min_exponent)  // 2^-exponent may be too large
      return ldexp(ldexp(a, -*exponent / 2), -*exponent - -*exponent / 2);
    return ldexp(a, -*exponent);
  }
  friend bool isfinite(stochastic const& a) { return std::isfinite(a.mean()); }
  friend bool isnan(stochastic const& a) { return std::isnan(a.mean()); }
  friend bool isinf(stochastic const& a) { return std::isinf(a.mean()); }

  /// The samples agree in all bits: no rounding has happened, or none that mattered.
  [[nodiscard]] constexpr bool is_exact() const { return x_[0] == x_[1] && x_[1] == x_[2]; }

 private:
  template <class Operation>
  static stochastic each(stochastic const& a, stochastic const& b, Operation operation) {
    std::uint64_t const bits = detail::random_bits();
    bool const second = (bits & 2U) != 0;
    return {operation(a.x_[0], b.x_[0], (bits & 1U) != 0), operation(a.x_[1], b.x_[1], second),
            operation(a.x_[2], b.x_[2], !second)};
  }

  T x_[3] = {0, 0, 0};
};

namespace detail {

/// Decimal digits that rounding has left of x beside a length `unit` > 0: between 0 and those of T
/// (15.95 for double); 0 for NaN.
template <std::floating_point T>
[[nodiscard]] double digits_beside(stochastic<T> const& x, T unit) {
  static double const all = -std::log10(double(std::numeric_limits<T>::epsilon()) / 2);
  if (x.is_exact()) return all;
  T const mean = x.mean();
  double squares = 0;  // of numbers relative to the unit, which do not leave the range
  for (int i = 0; i < 3; ++i) {
    double const deviation = double((x.sample(i) - mean) / unit);
    squares += deviation * deviation;
  }
  double const found = std::log10(std::sqrt(3.0) / (4.303 * std::sqrt(squares / 2)));
  return found > 0 ? std::min(found, all) : 0;  // NaN too is 0
}

}  // namespace detail

/// Decimal digits that rounding has left of x, by Student's test; 0 for NaN.
template <std::floating_point T>
[[nodiscard]] double digits(stochastic<T> const& x) {
  return detail::digits_beside(x, T(std::fabs(x.mean())));
}

/// The fewest digits among the entries of a vector, beside the largest entry.
template <std::floating_point T, int N>
[[nodiscard]] double digits(Eigen::Matrix<stochastic<T>, N, 1> const& x) {
  T largest = 0;
  for (auto const& entry : x) largest = std::max(largest, T(std::fabs(entry.mean())));
  double fewest = detail::digits_beside(stochastic<T>(1), T(1));
  for (auto const& entry : x) fewest = std::min(fewest, detail::digits_beside(entry, largest));
  return fewest;
}

/// The digits that survive, and no other: "3.14159e+00"; "@.0" if there is none.
template <std::floating_point T>
[[nodiscard]] std::string to_string(stochastic<T> const& x) {
  T const mean = x.mean();
  int const count = static_cast<int>(digits(x));
  if (!(std::fabs(mean) <= std::numeric_limits<T>::max())) return std::to_string(mean);
  if (count < 1) return "@.0";
  char text[48];
  auto const end =
      std::to_chars(text, text + sizeof text, mean, std::chars_format::scientific, count - 1).ptr;
  return {text, end};
}

template <class Char, class Traits, std::floating_point T>
auto& operator<<(std::basic_ostream<Char, Traits>& out, stochastic<T> const& x) {
  return out << to_string(x).c_str();
}

}  // namespace slant::testing

template <std::floating_point T>
class std::numeric_limits<slant::testing::stochastic<T>> : public std::numeric_limits<T> {
  using scalar = slant::testing::stochastic<T>;
  using base = std::numeric_limits<T>;

 public:
  static constexpr bool is_iec559 = false;
  static constexpr scalar epsilon() { return scalar(base::epsilon()); }
  static constexpr scalar round_error() { return scalar(T(1)); }
  static constexpr scalar min() { return scalar(base::min()); }
  static constexpr scalar max() { return scalar(base::max()); }
  static constexpr scalar lowest() { return scalar(base::lowest()); }
  static constexpr scalar denorm_min() { return scalar(base::denorm_min()); }
  static constexpr scalar infinity() { return scalar(base::infinity()); }
  static constexpr scalar quiet_NaN() { return scalar(base::quiet_NaN()); }
};

/// What Eigen asks for.
template <std::floating_point T>
struct Eigen::NumTraits<slant::testing::stochastic<T>> : Eigen::GenericNumTraits<T> {
  using Real = slant::testing::stochastic<T>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  static constexpr Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static constexpr Real dummy_precision() { return Real(NumTraits<T>::dummy_precision()); }
  static constexpr Real highest() { return std::numeric_limits<Real>::max(); }
  static constexpr Real lowest() { return std::numeric_limits<Real>::lowest(); }
  static constexpr Real infinity() { return std::numeric_limits<Real>::infinity(); }
  static constexpr Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
};

namespace slant::testing {

static_assert(slant::scalar<stochastic<double>> && slant::scalar<stochastic<float>>);
static_assert(!std::convertible_to<double, stochastic<double>>);

}  // namespace slant::testing
