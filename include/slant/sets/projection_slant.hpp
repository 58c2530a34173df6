// SPDX-License-Identifier: MIT
//
// The slanting operator of the projection onto any set, as an operator: blocks give a small matrix,
// products give an operator, methods want the latter from both.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/block_diagonal_slant.hpp>
#include <slant/sets/blocks.hpp>

namespace slant {

namespace detail {

struct projection_slant_fn {
  /// A new operator; allocates.
  template <class C, class X>
    requires has_slant<C, X>
  [[nodiscard]] auto operator()(C const& c, X const& x) const {
    if constexpr (has_static_dimension<C>) {
      power_slant<scalar_t<X>, C> g(1);
      (*this)(c, x, g);
      return g;
    } else {
      return c.slant(x);
    }
  }
  /// Into an operator made earlier for the same set; no allocation if the set can do without.
  template <class C, class X, class G>
    requires has_slant<C, X>
  void operator()(C const& c, X const& x, G& g) const {
    if constexpr (has_static_dimension<C>) {
      if constexpr (!whole_space<C>) g.assign(0, c.slant(slant::local(x)));
    } else if constexpr (requires { c.slant(x, g); }) {
      c.slant(x, g);
    } else {
      g = c.slant(x);
    }
  }
};

}  // namespace detail

/// P_Λ°(x) as an operator: projection_slant(set, x), or projection_slant(set, x, g) in place.
inline constexpr detail::projection_slant_fn projection_slant{};

}  // namespace slant
