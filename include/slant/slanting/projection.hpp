// SPDX-License-Identifier: MIT
//
// The projection onto a convex set as a slanting function: P(y) and P°(y) = set.slant(y), which is
// symmetric with 0 ⪯ P° ⪯ I for every convex set, so the laws come with it. The proximal map of a
// function is one too: projection(at_step(φ, ρ)).
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/sets/slants.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace slant {

/// The set has a slanting operator for vectors like Y, or for what is local of them.
template <class C, class Y>
concept has_projection_slant = has_slant<C, local_t<Y>> || has_slant<C, Y>;

/// F(y) = P(y). C is `Set const&` (referenced) or a set type (owned).
template <class C>
class projection_map : public slanting_base {
  using set_type = std::remove_cvref_t<C>;

  /// Blocks work on Eigen vectors, products on all vectors.
  template <class Y>
  [[nodiscard]] static decltype(auto) argument(Y const& y) {
    if constexpr (has_static_dimension<set_type>) {
      return slant::local(y);
    } else {
      return (y);
    }
  }
  template <class Y>
  using set_slant_t = decltype(slant::projection_slant(
      std::declval<set_type const&>(), projection_map::argument(std::declval<Y const&>())));

 public:
  explicit projection_map(held<C> set) : set_(std::move(set)) {}

  [[nodiscard]] index rows() const { return slant::dimension_of(set()); }
  [[nodiscard]] index cols() const { return slant::dimension_of(set()); }
  [[nodiscard]] set_type const& set() const noexcept { return set_.get(); }

  template <class Y, class V>
    requires has_project<set_type, local_t<Y>> || has_project<set_type, Y>
  void value(Y const& y, V& v) const {
    slant::project(set(), y, v);
  }
  template <class Y>
    requires has_projection_slant<set_type, Y>
  [[nodiscard]] auto slant(Y const& y) const {
    return detail::derivative_operator<detail::projection_laws(false)>(
        slant::projection_slant(set(), argument(y)));
  }
  template <class Y, class G>
    requires std::same_as<G, set_slant_t<Y>>
  void slant(Y const& y, G& g) const {
    slant::projection_slant(set(), argument(y), g);
  }

  [[nodiscard]] detail::written write(detail::written const& y) const {
    return {(function_step<set_type> ? "prox(" : "P(") + y.text + ")", false};
  }

 private:
  held<C> set_;
};

/// y ↦ P(y), the nearest point of the set. An lvalue is referenced.
template <class C>
  requires has_slant_member<std::remove_cvref_t<C>> &&
           (has_static_dimension<std::remove_cvref_t<C>> || has_size<std::remove_cvref_t<C>>)
[[nodiscard]] auto projection(C&& set) {
  return projection_map<kept_t<C>>(std::forward<C>(set));
}

// --- natural residual ----------------------------------------------------------------------------
//
// The natural residual of the separable quadratic program min ½xᵀA x − bᵀx over x ∈ Λ [K (29)],
//
//     F(x) = x − P_Λ(x − ρ (A x − b)),        F(x) = 0 exactly at the solution, for every ρ > 0,
//
// and of min ½xᵀA x − bᵀx + φ(x) with prox_{ρφ} in place of P_Λ.
//
// Nothing is derived here: value, slanting operator I − P°(I − ρA), laws, renewal in place and
// `symmetrizable` all follow from the composition.

/// x ↦ x − P_Λ(x − ρ (A x − b)); of a function φ in place of the set x ↦ x − prox_{ρφ}(…). A and the
/// set are referenced if they are lvalues, b is copied.
/// ρ is in units of 1/A; 1/mean(diag A) is a good choice.
/// @throws bad_input if sizes differ, b has entries that are not finite, or not 0 < ρ < ∞.
template <operand A, class B, class Set, class S>
  requires has_projection_slant<step_t<Set, S>, plain_t<B>>
[[nodiscard]] auto natural_residual(A&& a, B const& b, Set&& set, S const& ρ) {
  index const n = slant::dimension_of(set);
  detail::require_size("A", a, n, n, "the dimension of the set");
  detail::require_offset("b", b, n);
  detail::check_positive("rho", ρ);
  identity_map const x(n);
  return identity_map(n) -
         slant::projection(slant::at_step(std::forward<Set>(set), ρ)) *
             (identity_map(n) - slant::positive(ρ) * (std::forward<A>(a) * x - plain_t<B>(b)));
}

}  // namespace slant
