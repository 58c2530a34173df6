// SPDX-License-Identifier: MIT
//
// Parts C and D of the Schur complement contact algorithm [D §5]: the residual, and what the active
// set makes of it.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/schur_contact_state.hpp>

#include <limits>

namespace slant::detail {

/// (vii).
template <class P>
void compute_residual(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  slant::apply(p.k(), s.x, s.r, s.k_workspace);
  ++s.work.operator_applications;
  vectors::difference(p.f(), s.r, s.r);
  vectors::scale(scalar(1) / s.unit, s.r);
}
/// (vi), (vii).
template <class P>
void minimise_inside(P const& p, schur_contact_state<P>& s) {
  p.projection().add_minimiser(s.unit, s.r, s.x, s.q_workspace);
  ++s.projector_applications;
  compute_residual(p, s);
}
/// (viii), (x): φ, d, λ of r, and what follows from them for the status.
template <class P>
void note_contact_residual(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  auto const& rows = p.rows();
  s.rows.active.project_on_kernel(rows, s.r, s.φ);
  s.rows.active.project_on_cone(rows, s.r, s.d, s.λ);
  // What both are differences of has rounding errors of this size; along such a φ, which is in no
  // kernel, a step can be long.
  scalar const zero = scalar(16) * std::numeric_limits<scalar>::epsilon() * norm(s.r);
  s.φ_norm = norm(s.φ);
  if (s.φ_norm <= zero) {
    vectors::set_zero(s.φ);
    s.φ_norm = scalar(0);
  }
  scalar const size = norm(s.d);
  s.residual_norm = s.unit * size;
  vectors::difference(s.d, s.φ, s.trial);
  s.β_norm = size > zero ? norm(s.trial) : scalar(0);
  if (size <= zero) s.status = status::converged;
  if (!detail::is_finite(s.residual_norm)) s.status = status::breakdown;
}

/// Slacks, J and r of s.x from s.x alone. What rounding errors of iterates far away have made of it
/// is put right: rows that are violated by more than those of x itself, or that have left their
/// bound while they were in J. u is minimised over U again if `inside`, and
/// where that has moved x.
template <class P>
void measure_anew(P const& p, schur_contact_state<P>& s, bool inside) {
  s.updated = false;
  s.directions.live = false;
  s.rows.forget();
  s.rows.measure(p.rows(), s.x);
  bool const sound = everywhere(s.x, s.rows.is_feasible() && s.rows.are_tight(p.rows(), s.x));
  if (!sound) {
    (void)s.rows.active.project_on_set(p.rows(), s.x, s.λ);
    s.rows.measure(p.rows(), s.x);
    s.rows.take_tight(p.rows());
    s.regular = false;
  }
  compute_residual(p, s);
  note_contact_residual(p, s);
  if (sound && !inside) return;
  minimise_inside(p, s);
  note_contact_residual(p, s);
}
}  // namespace slant::detail
