// SPDX-License-Identifier: MIT
//
// Modified semismooth Newton methods: mssn, imssn, gimssn.
#pragma once

#include <slant/methods/modified_newton.hpp>
#include <slant/problems/quadratic_program.hpp>

#include <type_traits>

namespace slant {

// --- mssn ----------------------------------------------------------------------------------------
//
// MSSN, "modified semismooth Newton" [K §3.3.3]: every step freezes the blocks outside 𝒜,
//
//     λᵢ^(k+1) = P_Λᵢ(λᵢ − ρ rᵢ),  i ∉ 𝒜                                                 (57)
//     λ^(k+1)  = arg min q  subject to (57)
//
// If it converges, then to the solution [K Theorem 6]. It need not: active sets can recur, and a
// sliding disc moves only by the fixed steps of (57).

template <class S>
using mssn_options = modified_newton_options<S, fixed_forcing>;

/// MSSN for a separable_qp: solve(mssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)). The
/// minimum on a face is computed to a fraction of err^(k), by default 1e-8. Iterates may leave Λ; x
/// is P_Λ of them. Requires what kprgp does. Statuses of its own: see imssn.
template <class QP>
class mssn : public modified_newton<QP, frozen_start, unlimited_cg, fixed_forcing> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using mssn::modified_newton::modified_newton;
};

template <class QP>
mssn(QP&&) -> mssn<kept_t<QP>>;
template <class QP>
mssn(QP&&, mssn_options<typename std::remove_cvref_t<QP>::scalar>) -> mssn<kept_t<QP>>;

// --- imssn ---------------------------------------------------------------------------------------
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

template <class S>
using imssn_options = modified_newton_options<S, adaptive_precision>;

/// IMSSN for a separable_qp: solve(imssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)).
/// Iterates may leave Λ; x is P_Λ of them. Requires what kprgp does. Statuses of its own: converged
/// (r̃ = 0); stalled (neither ‖r̃‖ nor q has fallen for `patience` steps: active sets recur, or
/// rounding errors end the descent); breakdown (a number left the range of the scalar, or A is not
/// definite on a face).
template <class QP>
class imssn : public modified_newton<QP, frozen_start, unlimited_cg, adaptive_precision> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using imssn::modified_newton::modified_newton;
};

template <class QP>
imssn(QP&&) -> imssn<kept_t<QP>>;
template <class QP>
imssn(QP&&, imssn_options<typename std::remove_cvref_t<QP>::scalar>) -> imssn<kept_t<QP>>;

// --- gimssn --------------------------------------------------------------------------------------
//
// GIMSSN, "globally convergent IMSSN" [K §3.3.4]: every step begins with a projected gradient step
// on all blocks and ends in Λ,
//
//     tol^(k+1)   as IMSSN has it                                                           (3.1°)
//     λ^(k+1,0)   = P_Λ(λ^(k) − ρ r^(k)),   ρ ∈ (0, 2/σ_max)                                (3.2°)
//     λ^(k+1)     = CG_feas(A, b, 𝒜, λ^(k+1,0), tol^(k+1))                                  (3.3°)
//
// where CG_feas ends with a half step to the boundary when it would leave Λ. q falls in every step,
// by the factor η = 1 − min(ρ, 2/σ_max − ρ) σ_min at least, and
// ‖λ^(k) − λ*‖² ≤ 2 (q(λ^(0)) − q(λ*)) η^k / σ_min for subsymmetric sets [K Theorem 7].
//
// Known weakness: on a curved boundary a sliding block moves only by the gradient steps (3.2°).

template <class S>
using gimssn_options = modified_newton_options<S, adaptive_precision>;

/// GIMSSN for a separable_qp: solve(gimssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// All iterates are in Λ. Requires what kprgp does. ρ < 2/σ_max is insisted on, unless step_length
/// is given. Statuses of its own: those of imssn, and unbounded (q decreases for ever along
/// −state.directions.p); breakdown where A was seen not to be semidefinite.
template <class QP>
class gimssn : public modified_newton<QP, projected_start, feasible_cg, adaptive_precision> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using gimssn::modified_newton::modified_newton;
};

template <class QP>
gimssn(QP&&) -> gimssn<kept_t<QP>>;
template <class QP>
gimssn(QP&&, gimssn_options<typename std::remove_cvref_t<QP>::scalar>) -> gimssn<kept_t<QP>>;

}  // namespace slant
