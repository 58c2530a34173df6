// SPDX-License-Identifier: MIT
//
// AS and AS-S by their names in [K Ex 5]. Both are KPRGP: AS for the two-sided bounds of plane
// friction problems, close to MPRGP there; AS-S with the active sets of semismooth Newton,
//
//     F = blocks with (x − α̃ r)_i inside Λ_i
//
// instead of those with x_i inside. The decrease of q of [K Theorem 1] holds for both, for it asks
// nothing of the partition. Reported there: with steps far beyond 2/σ_max, AS-S is the stabler one.
#pragma once

#include <slant/methods/kprgp.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// AS: solve(as(qp), x0, reduced_gradient_below(1e-6) || at_most(500)).
template <class QP>
[[nodiscard]] auto as(QP&& qp,
                      kprgp_options<typename std::remove_cvref_t<QP>::scalar> options = {}) {
  return kprgp<kept_t<QP>>(std::forward<QP>(qp), std::move(options));
}

/// AS-S: solve(as_s(qp), x0, reduced_gradient_below(1e-6) || at_most(500)).
template <class QP>
[[nodiscard]] auto as_s(QP&& qp,
                        kprgp_options<typename std::remove_cvref_t<QP>::scalar> options = {}) {
  options.active_sets = active_set_rule::semismooth;
  return slant::as(std::forward<QP>(qp), std::move(options));
}

}  // namespace slant
