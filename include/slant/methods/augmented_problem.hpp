// SPDX-License-Identifier: MIT
//
// The inner problems of augmented Lagrangian methods for min q(x) over x ∈ Λ, G x = e:
//
//     L(x, ν, ρ) = ½ xᵀ(P A P + ρ Q) x − (P (b − A x̄) + ρ x̄ − ν)ᵀx + const,     x ∈ Λ,
//
// P, Q and x̄ those of equality_constraints, ν = Gᵀμ. On the affine space x = P x + x̄, so A may be
// replaced by P A P there; its spectrum and that of ρ Q then do not mix: the penalty adds the one
// eigenvalue ρ, and P A P does not depend on the choice of a generalised inverse in A [K ref 44].
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/operators/congruence.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/scaled.hpp>
#include <slant/operators/sum.hpp>

#include <concepts>

namespace slant {

/// The projectors Q and P and the point x̄ of an affine space of vectors V, as equality_constraints
/// has them.
template <class C, class V>
concept affine_space = requires(C const& c, V const& v) {
  { c.size() } -> std::convertible_to<index>;
  { c.range_projector() } -> psd_operator<V>;
  { c.kernel_projector() } -> psd_operator<V>;
  { c.nearest() } -> std::convertible_to<V const&>;
};

/// P A P; refers to both arguments.
template <class A, class C>
[[nodiscard]] auto projected_hessian(A const& a, C const& constraints) {
  return congruence(constraints.kernel_projector(), a);
}

/// P A P + ρ Q; refers to both. Definite if A is. Throws bad_input unless 0 < ρ < ∞.
template <class A, class C, class S>
[[nodiscard]] auto augmented_hessian(A const& a, C const& constraints, S const& ρ) {
  auto whole =
      sum(projected_hessian(a, constraints), scaled(positive(ρ), constraints.range_projector()));
  if constexpr (declares_positive_definite<A>) {
    return declare<positive_definite>(std::move(whole));
  } else {
    return whole;
  }
}

/// P M P + Q/ρ ≈ (P A P + ρ Q)⁻¹ for M ≈ A⁻¹; refers to both. Throws bad_input unless 1/ρ is
/// finite.
template <class M, class C, class S>
[[nodiscard]] auto projected_preconditioner(M const& m, C const& constraints, S const& ρ) {
  return sum(congruence(constraints.kernel_projector(), m),
             scaled(positive(S(S(1) / ρ)), constraints.range_projector()));
}

}  // namespace slant
