// SPDX-License-Identifier: MIT
//
// Schur complements of block systems, applied and never formed:
//
//     [ K  B₁ᵀ ; B₂  −D ]   →   S = D + B₂ K⁻¹ B₁ᵀ        [T (3.3)]
//
// The general one has no laws. With B₁ = B₂ = B the closures of sum and congruence apply:
// self-adjoint and semidefinite if K⁻¹ and D are; definite if also D is, or if K⁻¹ is and the rows
// of B are asserted to be independent: schur_complement(Kinv, full_row_rank(B), D).
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <utility>

namespace slant {

namespace detail {

/// K⁻¹ as an operator, or a factorisation of K.
template <class K>
concept inverse_operand = factorization_like<std::remove_cvref_t<K>> || operand<K>;

/// K⁻¹ as an operator, from the operator itself or from a factorisation of K.
template <class K>
[[nodiscard]] decltype(auto) as_inverse(K&& k) {
  if constexpr (factorization_like<std::remove_cvref_t<K>>) {
    return slant::inverse(std::forward<K>(k));
  } else {
    return slant::as_operator(std::forward<K>(k));
  }
}

/// Three overloads that each explain why they do not fit would hide this one sentence.
template <class B>
[[nodiscard]] stand_in refuse_factor() {
  static_assert(adjoint_operand<B>, "schur_complement: B must have apply_adjoint(x, y)");
  return {};
}

}  // namespace detail

/// S = D + B₂ K⁻¹ B₁ᵀ. The first argument is K⁻¹ or a factorisation of K; B₁ needs an adjoint.
/// Throws bad_input naming the argument whose size does not fit.
template <detail::inverse_operand K, operand B1, operand B2, operand D>
[[nodiscard]] auto schur_complement(K&& k_inverse, B1&& b1, B2&& b2, D&& d) {
  if constexpr (!adjoint_operand<B1>) {
    return detail::refuse_factor<B1>();
  } else {
    index const n = k_inverse.rows();
    detail::require_cols("B1", b1, n, "the size of K");
    detail::require_cols("B2", b2, n, "the size of K");
    detail::require_size("D", d, b2.rows(), b1.rows(), "the rows of B2 and of B1");
    return slant::sum(
        std::forward<D>(d),
        slant::product(std::forward<B2>(b2), detail::as_inverse(std::forward<K>(k_inverse)),
                       slant::adjoint(std::forward<B1>(b1))));
  }
}

/// S = D + B K⁻¹ Bᵀ. The first argument is K⁻¹ or a factorisation of K.
template <detail::inverse_operand K, operand B, operand D>
[[nodiscard]] auto schur_complement(K&& k_inverse, B&& b, D&& d) {
  if constexpr (!adjoint_operand<B>) {
    return detail::refuse_factor<B>();
  } else {
    detail::require_cols("B", b, k_inverse.rows(), "the size of K");
    detail::require_size("D", d, b.rows(), b.rows(), "the rows of B");
    return slant::sum(
        std::forward<D>(d),
        slant::congruence(std::forward<B>(b), detail::as_inverse(std::forward<K>(k_inverse))));
  }
}

}  // namespace slant
