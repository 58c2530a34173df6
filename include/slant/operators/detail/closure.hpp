// SPDX-License-Identifier: MIT
//
// Which laws survive which composition. Each function states the closure of one composition and
// nothing more; the operators call it on the laws of their parts.
#pragma once

#include <slant/concepts/laws.hpp>

#include <initializer_list>

namespace slant::detail {

/// A₁ + A₂ + …: self-adjoint if all are; semidefinite if all are, and then definite if one is.
[[nodiscard]] constexpr law_set sum_laws(std::initializer_list<law_set> terms) {
  bool definite = false;
  law_set common = slant::laws<law::self_adjoint, law::positive_semidefinite>;
  for (law_set const& term : terms) {
    definite = definite || term.contains(law::positive_definite);
    common = common & term;
  }
  definite = definite && common.contains(law::positive_semidefinite);
  return common | slant::laws<law::positive_definite>.when(definite);
}

/// A − B: self-adjoint if both are.
[[nodiscard]] constexpr law_set difference_laws(law_set a, law_set b) {
  return a & b & slant::laws<law::self_adjoint>;
}

/// c A: self-adjoint if A is; (semi)definite if A is and c > 0.
[[nodiscard]] constexpr law_set scaled_laws(law_set a, bool positive_factor) {
  return (a & slant::laws<law::self_adjoint>) |
         (a & slant::laws<law::positive_semidefinite, law::positive_definite>)
             .when(positive_factor);
}

/// A⁻¹: self-adjoint if A is; definite if A is, since ⟨A⁻¹y, y⟩ = ⟨x, Ax⟩ for y = Ax.
[[nodiscard]] constexpr law_set inverse_laws(law_set a) {
  return a & slant::laws<law::self_adjoint, law::positive_semidefinite, law::positive_definite>;
}

/// B A Bᵀ: self-adjoint and semidefinite if A is; definite if A is and the rows of B are
/// independent.
[[nodiscard]] constexpr law_set congruence_laws(law_set a, bool full_row_rank) {
  return (a & slant::laws<law::self_adjoint, law::positive_semidefinite>) |
         (a & slant::laws<law::positive_definite>).when(full_row_rank);
}

/// R A Rᵀ with R a choice of different components: as for congruence with independent rows, and
/// ⟨RARᵀx, x⟩ ≥ ‖ARᵀx‖² ≥ ‖RARᵀx‖² keeps firm nonexpansiveness. A projector does not stay one.
[[nodiscard]] constexpr law_set restricted_laws(law_set a) {
  return congruence_laws(a, true) | (a & slant::laws<law::firmly_nonexpansive>);
}

/// diag(A₁, A₂, …): every law that all blocks have holds for the whole.
[[nodiscard]] constexpr law_set block_diagonal_laws(std::initializer_list<law_set> blocks) {
  law_set common = slant::laws<law::self_adjoint, law::positive_definite, law::projector,
                               law::firmly_nonexpansive>;
  for (law_set const& block : blocks) common = common & block;
  return common;
}

}  // namespace slant::detail
