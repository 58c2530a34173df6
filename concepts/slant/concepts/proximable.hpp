// SPDX-License-Identifier: MIT
//
// Closed convex functions φ : Rⁿ → (−∞, ∞], described by their proximal maps
//
//     prox_{ρφ}(z) = argmin_w  φ(w) + ‖w − z‖² / (2ρ),       ρ > 0               [Moreau 1965]
//
// Intuition. A convex set is the function that is 0 on it and ∞ elsewhere, its indicator; the
// proximal map is then the projection, whatever ρ is. So every convex set is a model, and needs
// nothing of what follows.
//
// Minimal definition.
//     dimension (static) or size()     number of components
//     prox(ρ, z) → value, or prox(ρ, z, x) in place (x may alias z)
//     value(x)                         φ(x), ∞ where φ is
//
// Capabilities, each where it exists:
//     conjugate(v)              φ*(v) = sup { vᵀx − φ(x) }
//     slant(ρ, z)               a slanting operator G of prox_{ρφ} at z, symmetric, 0 ⪯ G ⪯ I
//     state(ρ, z)               a block: what prox_{ρφ} leaves of a motion of z. free: all of it;
//                               fixed: nothing, z is at a kink of φ; sliding: what is in between
//     visit(f)                  separable functions: f(block, place) for each block
//
// Laws.   with x = prox_{ρφ}(z) and v = (z − x)/ρ:
//         φ(w) ≥ φ(x) + vᵀ(w − x)                       v is a subgradient at x
//         φ(x) + φ*(v) = vᵀx                            [Fenchel, Young; Moreau's identity]
//         ‖x − y‖² ≤ ⟨z − w, x − y⟩,  y = prox_{ρφ}(w)  firmly nonexpansive
//         ‖prox(z+h) − prox(z) − G(z+h) h‖ = o(‖h‖)
//
// Models. every convex set; slant::support(Λ), slant::power(φ, m), slant::separable_sum(φ, ψ, …).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/vector.hpp>

#include <concepts>
#include <limits>

namespace slant {

/// A proximal map of its own, which a set has not.
template <class F, class V>
concept has_prox = requires(F const& φ, scalar_t<V> const& ρ, V const& z) {
  φ.prox(ρ, z);
} || requires(F const& φ, scalar_t<V> const& ρ, V const& z, V& x) { φ.prox(ρ, z, x); };

template <class F, class V>
concept has_function_value = requires(F const& φ, V const& x) {
  { φ.value(x) } -> std::convertible_to<scalar_t<V>>;
};
template <class F, class V>
concept has_conjugate = requires(F const& φ, V const& v) {
  { φ.conjugate(v) } -> std::convertible_to<scalar_t<V>>;
};
template <class F, class V>
concept has_prox_slant = requires(F const& φ, scalar_t<V> const& ρ, V const& z) { φ.slant(ρ, z); };
template <class F, class V>
concept has_prox_state = requires(F const& φ, scalar_t<V> const& ρ, V const& z) {
  { φ.state(ρ, z) } -> std::same_as<block_state>;
};

/// See the top of this file.
template <class F, class V>
concept proximable =
    convex_set<F, V> ||
    ((has_static_dimension<F> || has_size<F>)&&has_prox<F, V> && has_function_value<F, V>);

namespace detail {

struct prox_fn {
  /// x = prox_{ρφ}(z); x may alias z.
  template <class F, class S, class Z, class X>
  void operator()(F const& φ, S const& ρ, Z const& z, X& x) const {
    check_rows("z", z, index(slant::dimension_of(φ)), "the dimension of the function");
    check_rows("x", x, index(slant::dimension_of(φ)), "the dimension of the function");
    if constexpr (requires { φ.prox(ρ, z, x); }) {
      φ.prox(ρ, z, x);
    } else if constexpr (requires { φ.prox(ρ, slant::local(z)); }) {
      slant::local(x) = φ.prox(ρ, slant::local(z));
    } else {
      slant::project(φ, z, x);
    }
  }
  template <class F, class S, class Z>
  [[nodiscard]] auto operator()(F const& φ, S const& ρ, Z const& z) const {
    check_rows("z", z, index(slant::dimension_of(φ)), "the dimension of the function");
    if constexpr (requires { φ.prox(ρ, z); }) {
      return φ.prox(ρ, z);
    } else if constexpr (!has_prox<F, plain_t<Z>> && requires { φ.project(z); }) {
      return φ.project(z);
    } else {
      auto x = slant::like(z, slant::dimension_of(φ));
      (*this)(φ, ρ, z, x);
      return x;
    }
  }
};

struct function_value_fn {
  template <class F, class X>
  [[nodiscard]] scalar_t<X> operator()(F const& φ, X const& x) const {
    check_rows("x", x, index(slant::dimension_of(φ)), "the dimension of the function");
    if constexpr (has_function_value<F, X>) {
      return φ.value(x);
    } else {
      return φ.contains(x) ? scalar_t<X>(0) : std::numeric_limits<scalar_t<X>>::infinity();
    }
  }
};

}  // namespace detail

/// The proximal map: prox(φ, ρ, z) by value, prox(φ, ρ, z, x) in place; of a set the projection.
/// Throws bad_input if z or x has a wrong size.
inline constexpr detail::prox_fn prox{};

/// φ(x); of a set 0 or ∞. Throws bad_input if x has a wrong size.
inline constexpr detail::function_value_fn function_value{};

}  // namespace slant
