// SPDX-License-Identifier: MIT
//
// Parts C and D of the Schur complement contact algorithm [D §5]: the residual, and what the active
// set makes of it.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/methods/schur_contact_state.hpp>

#include <limits>

namespace slant::detail {

/// (vii).
template <class P>
void compute_residual(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  slant::apply(p.k(), s.x, s.r, s.k_workspace);
  ++s.work.operator_applications;
  slant::local(s.r) = (slant::local(p.f()) - slant::local(s.r)) * (scalar(1) / s.unit);
  s.updated = false;
}
/// (vi), (vii).
template <class P>
void minimise_inside(P const& p, schur_contact_state<P>& s) {
  slant::local(s.trial) = slant::local(s.x);
  p.projection().add_minimiser(s.unit, s.r, s.x, s.q_workspace);
  ++s.projector_applications;
  compute_residual(p, s);
}
/// Throws bad_input unless B U = 0, as far as minimise_inside has just shown.
template <class P>
void check_inside(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  slant::local(s.trial) -= slant::local(s.x);
  p.rows().for_each_product(s.trial, [](index i, scalar const& value, scalar const&) {
    if (value != scalar(0)) {
      throw bad_input("projector", "one that moves row " + detail::show(i) + " of B",
                      "that of a U with B U = 0");
    }
  });
}

/// (viii), (x): φ, d, λ of r, and what follows from them for the status.
template <class P>
void note_residual(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  auto const& rows = p.rows();
  s.rows.active.project_on_kernel(rows, s.r, s.φ);
  s.rows.active.project_on_cone(rows, s.r, s.d, s.λ);
  // What both are differences of has rounding errors of this size; along such a φ, which is in no
  // kernel, a step can be long.
  scalar const zero = scalar(16) * std::numeric_limits<scalar>::epsilon() * norm(s.r);
  s.φ_norm = norm(s.φ);
  if (s.φ_norm <= zero) {
    slant::local(s.φ).setZero();
    s.φ_norm = scalar(0);
  }
  scalar const size = norm(s.d);
  s.residual_norm = s.unit * size;
  slant::local(s.trial) = slant::local(s.d) - slant::local(s.φ);
  s.β_norm = size > zero ? norm(s.trial) : scalar(0);
  if (size <= zero) s.status = status::converged;
  if (!detail::is_finite(s.residual_norm)) s.status = status::breakdown;
}
}  // namespace slant::detail
