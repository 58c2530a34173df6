// SPDX-License-Identifier: MIT
//
// What distinguishes MSSN, IMSSN and GIMSSN [K §3.3.3, §3.3.4]: where a step starts, which
// conjugate gradients minimise q on the face, and how accurately (newton/forcing.hpp).
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/methods/recession.hpp>
#include <slant/newton/forcing.hpp>

#include <type_traits>

namespace slant {

/// Step (3.2°) of IMSSN, (57): the blocks off the face are frozen at P(λ − ρ r), the others stay.
struct frozen_start {
  /// s.trial becomes λ^(k+1,0); s.φ is scratch.
  template <class State>
  static void place(State& s) {
    s.face.keep(s.x, s.φ);
    s.face.keep_complement(s.projected, s.trial);
    vectors::add(s.φ, s.trial);
  }
};

/// Step (3.2°) of GIMSSN, (63) on all blocks: λ^(k+1,0) = P_Λ(λ − ρ r), a projected gradient step.
struct projected_start {
  /// s.trial becomes λ^(k+1,0).
  template <class State>
  static void place(State& s) {
    vectors::copy(s.projected, s.trial);
  }
};

/// How the inner iterations of a step ended.
enum class inner_end : unsigned char {
  going_on,  ///< not yet
  accurate,  ///< to the accuracy asked for
  boundary,  ///< at the boundary of Λ, by a half step
  limit,     ///< after max_inner iterations
  endless,   ///< q has no minimum along p in floating point, and −p does not leave Λ
  broken     ///< A is not positive definite on the face, or a number is not finite
};

/// CG [K (62)]: to the minimum on the face, in Λ or not.
struct unlimited_cg {
  static constexpr bool stays_inside = false;

  /// One step along −p.
  template <class Set, class State, class S>
  static inner_end advance(Set const&, State& s, S const& noise) {
    auto const& d = s.directions;
    S const slope = inner_product(s.r, d.p);
    if (!(d.curvature > noise)) {
      bool const flat = d.curvature >= -noise;
      bool const minimal = flat && !is_descent(slope, d.p, S(s.size_of_b + norm(s.r)));
      return minimal ? inner_end::accurate : inner_end::broken;
    }
    S const α = slope / d.curvature;
    vectors::axpy(-(s.unit * α), d.p, s.x);
    vectors::axpy(-α, d.Ap, s.r);
    ++s.since_refresh;
    return inner_end::going_on;
  }
};

/// CG_feas [K §3.3.4 (ii)]: ends where it would leave Λ, with a half step to the boundary.
struct feasible_cg {
  static constexpr bool stays_inside = true;

  /// One step along −p.
  template <class Set, class State, class S>
  static inner_end advance(Set const& set, State& s, S const& noise) {
    auto const step = step_within(set, s, noise);
    if (step.end == feasible_step_end::minimum) return inner_end::going_on;
    if (step.end == feasible_step_end::broken) return inner_end::broken;
    bool const descent = is_descent(step.slope, s.directions.p, S(s.size_of_b + norm(s.r)));
    if (step.flat && !descent) return inner_end::accurate;
    if (step.end == feasible_step_end::endless) {
      return step.flat ? inner_end::endless : inner_end::broken;
    }
    half_step(s, step);
    return inner_end::boundary;
  }
};

/// What the options of mssn, imssn and gimssn begin with.
template <class Forcing>
inline constexpr Forcing default_forcing{};
/// The minimum on the face, for practical purposes.
template <>
inline constexpr fixed_forcing default_forcing<fixed_forcing>{.tolerance = 1e-8};
/// [K] does not print r_tol and c_fact. Where discs slide there are hundreds of steps, after which
/// c_fact^k, not the error, would decide: on bricks and wires with the proposal of [K §3.2.4], 0.1
/// and 0.9, most products go into accuracy that nobody needs, ten times as many at worst.
template <>
inline constexpr adaptive_precision default_forcing<adaptive_precision>{.r_tol = 0.5,
                                                                        .c_fact = 0.999};

/// The inner iterations end at ‖φ‖ ≤ η err^(0) [K (3.1°)] for the adaptive precision of the
/// documents, whose η falls with err^(k)/err^(0); at ‖φ‖ ≤ η err^(k) for all other rules.
template <class Forcing, class S>
[[nodiscard]] S inner_accuracy(Forcing const&, S const& η, forcing_history<S> const& h) {
  return η * (std::is_same_v<Forcing, adaptive_precision> ? h.first_error : h.error);
}

}  // namespace slant
