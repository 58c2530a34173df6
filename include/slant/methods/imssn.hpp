// SPDX-License-Identifier: MIT
//
// IMSSN, "inexact MSSN" [K §3.3.3]: a restarted CG method,
//
//     tol^(k+1)  = min(r_tol err^(k)/err^(0), c_fact tol^(k)),   tol^(0) = r_tol/c_fact     (3.1°)
//     λᵢ^(k+1,0) = P_Λᵢ(λᵢ − ρ rᵢ), i ∉ 𝒜;  λᵢ, i ∈ 𝒜                                       (3.2°)
//     λ^(k+1)    = CG(A, b, 𝒜, λ^(k+1,0), tol^(k+1))                                        (3.3°)
//
// Nothing guarantees convergence: use gimssn where it stalls. Measured: with ρ = 1.9/σ_max it
// converges on all wires and bricks tried, with 8/σ_max in half the products on some bricks and not
// at all on others and on the wire, where active sets recur. A sliding disc moves by one fixed step
// (57) a Newton step, so the last digits cost hundreds of steps where discs slide; on half lines
// and intervals there are some ten.
#pragma once

#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/modified_newton.hpp>

#include <type_traits>

namespace slant {

template <class S>
using imssn_options = modified_newton_options<S, adaptive_precision>;

/// IMSSN for a separable_qp: solve(imssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)).
/// Iterates may leave Λ; x is P_Λ of them. Requires what kprgp does. Statuses of its own: converged
/// (r̃ = 0); stalled (neither ‖r̃‖ nor q has fallen for `patience` steps: active sets recur, or
/// rounding errors end the descent); breakdown (a number left the range of the scalar, or A is not
/// definite on a face).
template <class QP>
class imssn : public modified_newton<QP, frozen_start, unlimited_cg, adaptive_precision> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using imssn::modified_newton::modified_newton;
};

template <class QP>
imssn(QP&&) -> imssn<kept_t<QP>>;
template <class QP>
imssn(QP&&, imssn_options<typename std::remove_cvref_t<QP>::scalar>) -> imssn<kept_t<QP>>;

}  // namespace slant
