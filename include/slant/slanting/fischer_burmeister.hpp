// SPDX-License-Identifier: MIT
//
// The Fischer–Burmeister function φ(a, b) = √(a² + b²) − a − b of two slanting functions,
// componentwise. φ(a, b) = 0 means a >= 0, b >= 0, a b = 0.
//
// Accuracy. Both √(a² + b²) − a − b and a/√(a² + b²) − 1 cancel where it matters, at b ≪ a. Neither
// is computed so: with the larger argument M, the other one m, t = m/M (|m| <= M if M > 0)
//
//     φ = −2m / (√(1+t²) + 1 + t),           ∂φ/∂M = −t² / (s (1 + s)),   s = √(1+t²),
//
// so value and slopes are within 4 ulp at any scale (subnormal results excepted), and nothing
// overflows that the result does not.
//
// Kink. φ° at (0, 0) is (√½ − 1, √½ − 1), the limit along a = b > 0: symmetric in a and b, and both
// slopes are negative, so F̃° is as regular as there.
#pragma once

#include <slant/slanting/parts/pairs.hpp>

#include <cmath>
#include <utility>

namespace slant {

namespace detail {

struct fischer_burmeister_kernel {
  static constexpr bool chooses = false;

  template <class S>
  [[nodiscard]] static S value(S const& a, S const& b) {
    using std::sqrt;
    if (a == S(0) && b == S(0)) return S(0);
    S const& larger = a >= b ? a : b;
    S const& other = a >= b ? b : a;
    if (larger > S(0) && larger >= S(-other)) {
      S const t = other / larger;
      return S(-2) * (other / (sqrt(S(1) + t * t) + S(1) + t));
    }
    // a + b <= 0: with p = −other >= |larger| all terms of φ are sums of numbers >= 0.
    S const p = -other;
    S const t = larger / p;
    return p * (sqrt(S(1) + t * t) + (S(1) - t));
  }

  /// {∂φ/∂a, ∂φ/∂b}.
  template <class S>
  [[nodiscard]] static std::pair<S, S> slopes(S const& a, S const& b) {
    using std::abs;
    using std::sqrt;
    if (a == S(0) && b == S(0)) return {S(sqrt(S(0.5)) - S(1)), S(sqrt(S(0.5)) - S(1))};
    if (abs(a) >= abs(b)) {
      auto const [at_a, at_b] = ordered_slopes<S>(a, b);
      return {at_a, at_b};
    }
    auto const [at_b, at_a] = ordered_slopes<S>(b, a);
    return {at_a, at_b};
  }

 private:
  /// Slopes in (p, q) for |p| >= |q|, p ≠ 0, or with a NaN among them.
  template <class S>
  [[nodiscard]] static std::pair<S, S> ordered_slopes(S const& p, S const& q) {
    using std::abs;
    using std::sqrt;
    S const t = q / abs(p);
    S const s = sqrt(S(1) + t * t);
    S const at_p = p > S(0) ? S(-(t * t) / (s * (S(1) + s))) : S(-(S(1) + S(1) / s));
    return {at_p, S(t / s - S(1))};
  }
};

}  // namespace detail

/// √(F² + G²) − F − G componentwise. F and G are `Function const&` or function types (owned).
template <class F, class G>
using fischer_burmeister_map = detail::pointwise_pair<detail::fischer_burmeister_kernel, F, G>;

/// y ↦ √(F(y)² + G(y)²) − F(y) − G(y) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister(F&& f, G&& g) {
  return fischer_burmeister_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
