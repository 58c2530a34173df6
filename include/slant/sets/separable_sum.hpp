// SPDX-License-Identifier: MIT
//
// Functions of the parts of a vector, added up:
//
//     φ(x) = φ₁(x₁) + … + φ_k(x_k),      x = (x₁, …, x_k).
//
// A part that is a convex set stands for its indicator: separable_sum(half_lines(m), support(
// discs(g))) is what contact with friction adds to the energy, the sum over half lines alone is
// their product.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/proximal_step.hpp>

#include <utility>

namespace slant {

/// φ₁ + … + φ_k. Made by `separable_sum`.
template <class... Parts>
class function_sum : public detail::part_sequence<Parts...> {
  using base = detail::part_sequence<Parts...>;

 public:
  using scalar = set_scalar_t<typename base::template part_type<0>>;

  using base::base;

  /// Number of components.
  [[nodiscard]] index size() const { return this->template offset<sizeof...(Parts)>(); }

  /// x = prox_{ρφ}(z), ρ > 0; x may be z.
  template <class S, class Z, class X>
  void prox(S const& ρ, Z const& z, X&& x) const {
    this->for_each_part([&](auto const& part, auto const& p) {
      auto&& step = slant::at_step(part, ρ);
      detail::project_part(step, p, z, x);
    });
  }

  /// φ(x), ∞ where a part is.
  template <class X>
  [[nodiscard]] scalar_t<X> value(X const& x) const {
    scalar_t<X> sum(0);
    this->for_each_part([&](auto const& part, auto const& p) {
      sum += slant::function_value(part, detail::argument_of(part, p, x));
    });
    return sum;
  }
  /// φ*(v), the sum of the conjugates: of a set its support function.
  template <class V>
  [[nodiscard]] scalar_t<V> conjugate(V const& v) const {
    scalar_t<V> sum(0);
    this->for_each_part([&](auto const& part, auto const& p) {
      auto const own = detail::argument_of(part, p, v);
      if constexpr (requires { part.conjugate(own); }) {
        sum += part.conjugate(own);
      } else {
        sum += part.support(own);
      }
    });
    return sum;
  }

  /// The slanting operator of the proximal map at z, one part after the other.
  template <class S, class Z>
  [[nodiscard]] auto slant(S const& ρ, Z const& z) const {
    detail::check_rows("z", z, size(), "the dimension of the function");
    return this->slants_at(
        z, [&](auto const& part) -> decltype(auto) { return slant::at_step(part, ρ); });
  }
  /// The same into an operator made earlier.
  template <class S, class Z, class... Slants>
  void slant(S const& ρ, Z const& z, direct_sum_slant<Slants...>& g) const {
    detail::check_rows("z", z, size(), "the dimension of the function");
    this->renew_slants(z, g,
                       [&](auto const& part) -> decltype(auto) { return slant::at_step(part, ρ); });
  }
};

/// φ₁(x₁) + … + φ_k(x_k) of functions and sets, which are kept as cartesian keeps its parts.
template <class... Parts>
  requires(sizeof...(Parts) > 0 && (proximable<std::remove_cvref_t<Parts>, point_t<Parts>> && ...))
[[nodiscard]] auto separable_sum(Parts&&... parts) {
  return function_sum<detail::kept_part_t<Parts>...>(
      held<detail::kept_part_t<Parts>>(std::forward<Parts>(parts))...);
}

}  // namespace slant
