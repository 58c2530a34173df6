// SPDX-License-Identifier: MIT
//
// Which generalised Newton operators can be symmetrised: M = I − G (I − ρ A) with G self-adjoint,
// 0 ⪯ G ⪯ I, A self-adjoint positive definite, ρ > 0. Known from the types alone: the chain rule
// has assembled M out of parts that carry their laws.
//
// Why it can be. M dx = −F says dx = −F + G s with s = (I − ρA) dx. Insert dx, multiply by G:
//
//     H s = −G (I − ρA) F,      H = G (I − G) + ρ G A G.
//
// H is self-adjoint and semidefinite, definite on range(G), where the right-hand side lies. On that
// range H = G [G⁻¹ − I + ρA] G: the shift (G⁻¹ − I)/ρ of A is the curvature of the set's boundary.
// So conjugate gradients solve the Newton system, with one product by A each and no BiCGSTAB.
#pragma once

#include <slant/operators/identity.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/difference.hpp>
#include <slant/slanting/scaled.hpp>

#include <type_traits>

namespace slant {

namespace detail {

template <class M>
struct newton_parts {
  static constexpr bool known = false;
};

/// I − G (I − ρ A), ρ marked as positive.
template <class G, class A, class S>
struct newton_parts<assembled_operator<
    difference_rule, identity_operator,
    assembled_operator<product_rule, G,
                       assembled_operator<difference_rule, identity_operator,
                                          assembled_operator<scaled_rule<S, true>, A>>>>> {
  static constexpr bool known = true;
  using slant_type = G;
  using operator_type = A;

  template <class M>
  static auto const& slant_part(M const& m) {
    return m.template part<1>().template part<0>();
  }
  template <class M>
  static auto const& scaled_part(M const& m) {
    return m.template part<1>().template part<1>().template part<1>();
  }
};

template <class M> concept newton_operator = newton_parts<M>::known;

template <newton_operator M>
using slant_part_t = typename newton_parts<M>::slant_type;
template <newton_operator M>
using matrix_part_t = typename newton_parts<M>::operator_type;

}  // namespace detail

/// An operator I − G (I − ρ A) whose parts promise what the top of this file asks for.
template <class M>
concept symmetrizable =
    detail::newton_operator<std::remove_cvref_t<M>> &&
    declares_self_adjoint<detail::slant_part_t<std::remove_cvref_t<M>>> &&
    declares_firmly_nonexpansive<detail::slant_part_t<std::remove_cvref_t<M>>> &&
    declares_self_adjoint<detail::matrix_part_t<std::remove_cvref_t<M>>> &&
    declares_positive_definite<detail::matrix_part_t<std::remove_cvref_t<M>>>;

/// A slanting function whose F°(y) is symmetrizable, as that of a natural residual with definite A.
template <class F, class V>
concept symmetrizable_function = slanting_function<F, V> && symmetrizable<slant_operator_t<F, V>>;

/// G of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto const& slant_of_projection(M const& m) {
  return detail::newton_parts<M>::slant_part(m);
}

/// ρ of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto const& step_length(M const& m) {
  return detail::newton_parts<M>::scaled_part(m).rule().factor;
}

/// A of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto const& hessian(M const& m) {
  return detail::newton_parts<M>::scaled_part(m).template part<0>();
}

}  // namespace slant
