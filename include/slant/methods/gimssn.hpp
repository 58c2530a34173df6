// SPDX-License-Identifier: MIT
//
// GIMSSN, "globally convergent IMSSN" [K §3.3.4]: every step begins with a projected gradient step
// on all blocks and ends in Λ,
//
//     tol^(k+1)   = min(r_tol err^(k)/err^(0), c_fact tol^(k)),   tol^(0) = r_tol/c_fact    (3.1°)
//     λ^(k+1,0)   = P_Λ(λ^(k) − ρ r^(k)),   ρ ∈ (0, 2/σ_max)                                (3.2°)
//     λ^(k+1)     = CG_feas(A, b, 𝒜, λ^(k+1,0), tol^(k+1))                                  (3.3°)
//
// where CG_feas ends with a half step to the boundary when it would leave Λ. q falls in every step,
// by the factor η = 1 − min(ρ, 2/σ_max − ρ) σ_min at least, and
// ‖λ^(k) − λ*‖² ≤ 2 (q(λ^(0)) − q(λ*)) η^k / σ_min for subsymmetric sets [K Theorem 7].
//
// Known weakness: on a curved boundary a sliding block moves only by the gradient steps (3.2°).
#pragma once

#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/modified_newton.hpp>

#include <type_traits>

namespace slant {

template <class S>
using gimssn_options = modified_newton_options<S, adaptive_precision>;

/// GIMSSN for a separable_qp: solve(gimssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// All iterates are in Λ. Requires what kprgp does. ρ < 2/σ_max is insisted on, unless step_length
/// is given. Statuses of its own: converged (r̃ = 0); unbounded (q decreases for ever along
/// −state.directions.p); stalled (neither ‖r̃‖ nor q has fallen for `patience` steps); breakdown (a
/// number left the range of the scalar, or A was seen not to be semidefinite).
template <class QP>
class gimssn : public modified_newton<QP, projected_start, feasible_cg, adaptive_precision> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using gimssn::modified_newton::modified_newton;
};

template <class QP>
gimssn(QP&&) -> gimssn<kept_t<QP>>;
template <class QP>
gimssn(QP&&, gimssn_options<typename std::remove_cvref_t<QP>::scalar>) -> gimssn<kept_t<QP>>;

}  // namespace slant
