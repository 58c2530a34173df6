// SPDX-License-Identifier: MIT
//
// A step of conjugate gradients that stays in a convex set Λ [K (31), (32), CG_feas of §3.3.4]:
//
//     p ← φ − γ p;   x ← x − α p,  r ← r − α A p  with  α = rᵀp / pᵀAp     if that lies in Λ,
//     the half step  x ← x − α_f p,  α_f = sup {α : x − α p ∈ Λ} < α       otherwise.
//
// Both cost the one application that yields Ap. What the parts work on is the state of a method:
// x, r, φ, trial, directions, unit, a_workspace, work and since_refresh, as gradient_point has
// them.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <utility>

namespace slant {

/// What became of a step along −p.
enum class feasible_step_end : unsigned char {
  minimum,   ///< taken, to the minimum of q along p
  boundary,  ///< not taken yet: Λ ends first, or q has no minimum along p
  endless,   ///< not taken: q has no minimum along p and Λ no end
  broken     ///< not taken: the curvature is negative or not a number
};

/// The answer of step_within.
template <class S>
struct feasible_step {
  feasible_step_end end;
  S slope;            ///< rᵀp / unit
  S length{0};        ///< α_f in multiples of p; set if end is `boundary`
  bool flat = false;  ///< pᵀAp is no more than rounding errors
};

/// p ← φ − γ p with Ap and pᵀAp; one application of A.
void next_direction(auto const& a, auto& s) {
  s.directions.advance(s.φ);
  s.directions.image(a, s.a_workspace);
  ++s.work.operator_applications;
}

/// Takes the step along −p to the minimum of q if that lies in the set, and r with it. Otherwise x
/// and r stay, and s.trial is −p. A curvature of at most `noise` counts as zero.
template <class Set, class State, class S>
[[nodiscard]] feasible_step<S> step_within(Set const& set, State& s, S const& noise) {
  auto const& d = s.directions;
  feasible_step<S> step{feasible_step_end::broken, inner_product(s.r, d.p)};
  if (!(d.curvature >= -noise)) return step;
  step.flat = !(d.curvature > noise);
  if (!step.flat) {
    S const α = step.slope / d.curvature;
    vectors::waxpy(-(s.unit * α), d.p, s.x, s.trial);
    if (slant::everywhere(s.x, set.contains(slant::local(s.trial)))) {
      std::swap(s.x, s.trial);
      vectors::axpy(-α, d.Ap, s.r);
      ++s.since_refresh;
      step.end = feasible_step_end::minimum;
      return step;
    }
  }
  vectors::negate(d.p, s.trial);
  step.length = slant::minimum(s.x, set.step_to_boundary(slant::local(s.x), slant::local(s.trial)));
  bool const ends = step.length < detail::infinity<S>();
  step.end = ends ? feasible_step_end::boundary : feasible_step_end::endless;
  return step;
}

/// The half step that step_within has found: x onto the boundary of Λ, up to rounding, and r with it.
template <class State, class S>
void half_step(State& s, feasible_step<S> const& step) {
  vectors::axpy(step.length, s.trial, s.x);
  vectors::axpy(-(step.length / s.unit), s.directions.Ap, s.r);
  ++s.since_refresh;
}

/// The same with x in Λ. Where x was much larger than the boundary is, rounding errors of x + α_f d
/// are not small beside that: such an x is projected. (No other one, which keeps its bits.)
template <class Set, class State, class S>
void half_step_within(Set const& set, State& s, feasible_step<S> const& step) {
  half_step(s, step);
  if (!slant::everywhere(s.x, set.contains(slant::local(s.x)))) {
    slant::project(set, slant::local(s.x), slant::local(s.trial));
    std::swap(s.x, s.trial);
  }
}

}  // namespace slant
