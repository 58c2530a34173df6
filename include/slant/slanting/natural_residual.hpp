// SPDX-License-Identifier: MIT
//
// The natural residual of the separable quadratic program min ½xᵀA x − bᵀx over x ∈ Λ [K (29)],
//
//     F(x) = x − P_Λ(x − ρ (A x − b)),        F(x) = 0 exactly at the solution, for every ρ > 0,
//
// and of min ½xᵀA x − bᵀx + φ(x) with prox_{ρφ} in place of P_Λ.
//
// Nothing is derived here: value, slanting operator I − P°(I − ρA), laws, renewal in place and
// `symmetrizable` all follow from the composition.
#pragma once

#include <slant/base/sizes.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <utility>

namespace slant {

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
  if (!(ρ > S(0) && detail::is_finite(ρ))) {
    throw bad_input("rho", detail::show(ρ), "a finite number > 0");
  }
  identity_map const x(n);
  return identity_map(n) -
         slant::projection(slant::at_step(std::forward<Set>(set), ρ)) *
             (identity_map(n) - slant::positive(ρ) * (std::forward<A>(a) * x - plain_t<B>(b)));
}

}  // namespace slant
