// SPDX-License-Identifier: MIT
//
// MSSN, "modified semismooth Newton" [K §3.3.3]: every step freezes the blocks outside 𝒜,
//
//     λᵢ^(k+1) = P_Λᵢ(λᵢ − ρ rᵢ),  i ∉ 𝒜                                                 (57)
//     λ^(k+1)  = arg min q  subject to (57)
//
// If it converges, then to the solution [K Theorem 6]. It need not: active sets can recur, and a
// sliding disc moves only by the fixed steps of (57).
#pragma once

#include <slant/methods/detail/active_set_complaint.hpp>
#include <slant/methods/modified_newton.hpp>

#include <type_traits>

namespace slant {

template <class S>
using mssn_options = modified_newton_options<S, fixed_forcing>;

/// MSSN for a separable_qp: solve(mssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)). The
/// minimum on a face is computed to a fraction of err^(k), by default 1e-8. Iterates may leave Λ; x
/// is P_Λ of them. Requires what kprgp does. Statuses of its own: see imssn.
template <class QP>
class mssn : public modified_newton<QP, frozen_start, unlimited_cg, fixed_forcing> {
  static_assert(detail::active_set_complaint<std::remove_cvref_t<QP>>::made);

 public:
  using mssn::modified_newton::modified_newton;
};

template <class QP>
mssn(QP&&) -> mssn<kept_t<QP>>;
template <class QP>
mssn(QP&&, mssn_options<typename std::remove_cvref_t<QP>::scalar>) -> mssn<kept_t<QP>>;

}  // namespace slant
