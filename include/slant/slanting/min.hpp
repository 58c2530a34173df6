// SPDX-License-Identifier: MIT
//
// Componentwise minimum min(F(y), G(y)), the classical complementarity function: min(x, r) = 0
// means x >= 0, r >= 0, xᵀr = 0.
//
// Kinks. min(F, G) = F − max(0, F − G) with max(0,·)° = 1 for arguments >= 0 [K (49)]: where
// F(y)_i = G(y)_i the row is that of G°. So min(x, ρ r(x)) has the same slanting operator as the
// natural residual x − P₊(x − ρ r(x)).
#pragma once

#include <slant/slanting/detail/pointwise_pair.hpp>

#include <utility>

namespace slant {

namespace detail {

struct min_kernel {
  static constexpr bool chooses = true;

  /// The smaller one; NaN if either is.
  template <class S>
  [[nodiscard]] static S value(S const& a, S const& b) {
    if (a >= b) return b;
    return a < b ? a : S(a + b);
  }
  template <class S>
  [[nodiscard]] static std::pair<S, S> slopes(S const& a, S const& b) {
    if (a >= b) return {S(0), S(1)};
    return a < b ? std::pair<S, S>(S(1), S(0)) : std::pair<S, S>(S(a + b), S(a + b));
  }
};

}  // namespace detail

/// min(F(y), G(y)) componentwise. F and G are `Function const&` or function types (owned).
template <class F, class G>
using min_map = detail::pointwise_pair<detail::min_kernel, F, G>;

/// y ↦ min(F(y), G(y)) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto min(F&& f, G&& g) {
  return min_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
