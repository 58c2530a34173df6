// SPDX-License-Identifier: MIT
//
// More than one row at a time [D §6; Calamai, Moré 1987]: where the step α to the minimum along q
// leaves B u ≤ c, the points
//
//     P(u + t q),   t = α, α/2, … > α₁,     P onto { B u ≤ c },
//
// are tried before the step α₁ to the first constraint. P changes no unknown of U, which follow by
// Q: with e = P(u + t q) − (u + t q) the trial point is u + t q + Q e, and its residual r − t K q −
// K Q e is again orthogonal to U. It is taken if j falls by as much as it would with α₁, and if no
// row of J has left its bound: J then grows, as it does with α₁, and what is known of the finite
// termination remains. One product and one application of Q for each. Directions that are flat to
// half of the digits are not followed so far.
#pragma once

#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/schur_contact_state.hpp>

namespace slant {

/// Moves s to the first trial point that is good enough, with its r and J; false if there is none.
template <class P>
[[nodiscard]] bool projected_search(P const& p, schur_contact_state<P>& s, index trials,
                                    typename P::scalar const& α, typename P::scalar const& α1) {
  using scalar = typename P::scalar;
  auto const& q = s.directions;
  if (trials == 0 || s.flat.is_nearly_flat(q)) return false;
  scalar const gain = α1 * (inner_product(s.r, q.q) - α1 * q.curvature / scalar(2));
  scalar t = α;
  for (index i = 0; i < trials && t > α1; ++i, t /= scalar(2)) {
    vectors::waxpy(s.unit * t, q.q, s.x, s.trial);
    vectors::copy(s.trial, s.d);
    s.rows.note_sizes(p.rows(), s.trial);
    (void)s.rows.active.project_on_set(p.rows(), s.trial, s.λ);
    if (!everywhere(s.x, s.rows.are_tight(p.rows(), s.trial))) continue;
    vectors::difference(s.trial, s.d, s.d);
    vectors::scale(scalar(1) / s.unit, s.d);
    slant::apply(p.projection(), s.d, s.correction, s.q_workspace);
    slant::apply(p.k(), s.correction, s.d, s.k_workspace);
    ++s.work.operator_applications;
    ++s.projector_applications;
    vectors::axpy(t, q.q, s.correction);
    vectors::difference(s.r, s.d, s.d);
    vectors::axpy(-t, q.Ap, s.d);
    vectors::sum(s.r, s.d, s.trial);
    if (!(inner_product(s.correction, s.trial) / scalar(2) >= gain)) continue;
    vectors::axpy(s.unit, s.correction, s.x);
    vectors::copy(s.d, s.r);
    s.updated = true;
    s.rows.measure(p.rows(), s.x);
    s.rows.take_tight(p.rows());
    s.directions.live = false;
    s.last_step = schur_contact_step::projected;
    return true;
  }
  return false;
}

}  // namespace slant
