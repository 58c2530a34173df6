// SPDX-License-Identifier: MIT
//
// Where the Schur complement contact algorithm cannot go on by conjugate gradients: directions of
// the kernel of K, and progress that has ended.
#pragma once

#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/methods/active_rows.hpp>
#include <slant/methods/schur_contact_state.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace slant::detail {

/// Replaces q by a direction of the kernel near it in which j falls, if there is one.
template <class P>
bool finds_kernel(P const& p, schur_contact_state<P>& s) {
  using scalar = typename P::scalar;
  auto& q = s.directions;
  kernel_projector<scalar> const c(p.rows(), s.rows.active);
  no_workspace none;
  auto const search = s.flat.split(q, p.k(), s.k_workspace, c, none, p.projection(), s.q_workspace,
                                   global_size(s.x));
  s.work.operator_applications += search.products;
  s.projector_applications += search.projections;
  s.regular = true;  // until a row leaves
  if (!search.found) return false;
  scalar const slope = inner_product(s.r, q.q);
  scalar const size = (s.residual_scale + s.flat.force(s.x)) / s.unit;
  using std::abs;
  if (!is_descent(scalar(abs(slope)), q.q, size)) {
    s.flat.restore(q);
    return false;
  }
  q.live = false;
  s.regular = false;
  if (slope >= scalar(0)) return true;
  vectors::scale(scalar(-1), q.q);
  vectors::scale(scalar(-1), q.Ap);
  return true;
}

/// Stalled if neither the residual nor the energy has fallen for `patience` steps.
template <class P>
void note_progress(P const& p, schur_contact_state<P>& s, index patience) {
  using scalar = typename P::scalar;
  auto const energy = [&] {
    scalar const of_load = inner_product(p.f(), s.x);
    scalar const of_rest = s.unit * inner_product(s.r, s.x);
    using std::abs;
    return std::pair(
        scalar(-(of_load + of_rest) / scalar(2)),
        scalar(scalar(8) * std::numeric_limits<scalar>::epsilon() * (abs(of_load) + abs(of_rest))));
  };
  if (s.progress.stalled(s.iteration, s.residual_norm, patience, energy)) {
    s.trouble = schur_contact_trouble::patience;
    s.status = status::stalled;
  }
}

}  // namespace slant::detail
