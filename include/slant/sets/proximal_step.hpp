// SPDX-License-Identifier: MIT
//
// The map z ↦ prox_{ρφ}(z) for one ρ, with the members of a set that methods use: project(z),
// slant(z), visit(f). What is written for projections takes it as it is, and a set, whose proximal
// map does not depend on ρ, passes through untouched.
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// A function that is no set, for points of its own kind.
template <class F> concept function_part = has_prox<F, point_t<F>>;

/// prox_{ρφ}. F is `Function const&` (referenced) or a function type (owned).
template <class F, class S>
class proximal_step : public detail::static_size<static_dimension_of<F>> {
  using function_type = std::remove_cvref_t<F>;

 public:
  using scalar = S;

  proximal_step(held<F> φ, S const& ρ) : φ_(std::move(φ)), ρ_(ρ) {}

  [[nodiscard]] index size() const { return slant::dimension_of(φ_.get()); }
  [[nodiscard]] index block_count() const { return slant::block_count(φ_.get()); }

  template <class Z>
    requires has_static_dimension<function_type>
  [[nodiscard]] auto project(Z const& z) const {
    return slant::prox(φ_.get(), ρ_, z);
  }
  /// x may be z.
  template <class Z, class X>
    requires(!has_static_dimension<function_type>)
  void project(Z const& z, X&& x) const {
    φ_.get().prox(ρ_, z, x);
  }

  template <class Z>
    requires has_prox_slant<function_type, Z>
  [[nodiscard]] auto slant(Z const& z) const {
    return φ_.get().slant(ρ_, z);
  }
  template <class Z, class G>
    requires requires(function_type const& φ, S const& ρ, Z const& z, G& g) { φ.slant(ρ, z, g); }
  void slant(Z const& z, G& g) const {
    φ_.get().slant(ρ_, z, g);
  }

  /// f(block, place) for every block, a proximal step or a set.
  template <class V>
    requires has_visit<function_type>
  void visit(V&& f) const {
    φ_.get().visit([&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (function_part<block_type>) {
        f(proximal_step<block_type const&, S>(held<block_type const&>(block), ρ_), p);
      } else {
        f(block, p);
      }
    });
  }

 private:
  held<F> φ_;
  S ρ_;
};

/// A proximal step that is no projection.
template <class C>
inline constexpr bool function_step = false;
template <class F, class S>
inline constexpr bool function_step<proximal_step<F, S>> = true;

/// z ↦ prox_{ρφ}(z) of a function, which is kept like any part; a set comes back as it is.
template <class F, class S>
[[nodiscard]] decltype(auto) at_step(F&& φ, S const& ρ) {
  if constexpr (function_part<std::remove_cvref_t<F>>) {
    return proximal_step<kept_t<F>, S>(held<kept_t<F>>(std::forward<F>(φ)), ρ);
  } else {
    static_cast<void>(ρ);
    return F(std::forward<F>(φ));
  }
}

/// What at_step makes of F, references dropped.
template <class F, class S>
using step_t =
    std::remove_cvref_t<decltype(slant::at_step(std::declval<F>(), std::declval<S const&>()))>;

}  // namespace slant
