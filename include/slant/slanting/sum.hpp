// SPDX-License-Identifier: MIT
//
// The sum of two slanting functions: (F + G)° = F° + G°.
#pragma once

#include <slant/operators/sum.hpp>
#include <slant/slanting/detail/two_terms.hpp>

#include <utility>

namespace slant {

namespace detail {

struct sum_rule {
  template <class V, class T>
  static void combine(V&& v, T const& other) {
    v += other;
  }
  template <class A, class B>
  [[nodiscard]] sum_operator<A const&, B const&> operator()(A const& a, B const& b) const {
    return sum_operator<A const&, B const&>(a, b);
  }
};

}  // namespace detail

/// F(y) + G(y). F and G are `Function const&` (referenced) or function types (owned).
template <class F, class G>
using sum_map = detail::two_terms<detail::sum_rule, F, G>;

/// y ↦ F(y) + G(y), also spelled f + g. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto add(F&& f, G&& g) {
  return sum_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
