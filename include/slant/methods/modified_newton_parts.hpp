// SPDX-License-Identifier: MIT
//
// What distinguishes MSSN, IMSSN and GIMSSN [K §3.3.3, §3.3.4]: where a step starts, which
// conjugate gradients minimise q on the face, and how accurately.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/methods/recession.hpp>

#include <algorithm>

namespace slant {

/// Step (3.2°) of IMSSN, (57): the blocks off the face are frozen at P(λ − ρ r), the others stay.
struct frozen_start {
  /// s.trial becomes λ^(k+1,0); s.φ is scratch.
  template <class State>
  static void place(State& s) {
    s.face.keep(s.x, s.φ);
    s.face.keep_complement(s.projected, s.trial);
    slant::local(s.trial) += slant::local(s.φ);
  }
};

/// Step (3.2°) of GIMSSN, (63) on all blocks: λ^(k+1,0) = P_Λ(λ − ρ r), a projected gradient step.
struct projected_start {
  /// s.trial becomes λ^(k+1,0).
  template <class State>
  static void place(State& s) {
    slant::local(s.trial) = slant::local(s.projected);
  }
};

/// How the inner iterations of a step ended.
enum class inner_end : unsigned char {
  going_on,   ///< not yet
  accurate,   ///< to the accuracy asked for
  boundary,   ///< at the boundary of Λ, by a half step
  limit,      ///< after max_inner iterations
  unbounded,  ///< q falls for ever along −p, and −p does not leave Λ
  broken      ///< A is not positive definite on the face, or a number is not finite
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
    slant::local(s.x) -= (s.unit * α) * slant::local(d.p);
    slant::local(s.r) -= α * slant::local(d.Ap);
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
      return step.flat ? inner_end::unbounded : inner_end::broken;
    }
    half_step(s, step);
    return inner_end::boundary;
  }
};

/// ‖φ‖ ≤ tolerance · err^(k): the minimum on the face, for practical purposes.
template <class S>
struct fixed_precision {
  S tolerance = S(1e-8);  ///< in (0, 1)

  void validate() const {
    if (!(tolerance > S(0) && tolerance < S(1))) {
      throw bad_input("precision.tolerance", detail::show(tolerance), "a number in (0, 1)");
    }
  }
  /// tol^(0).
  [[nodiscard]] S first() const { return tolerance; }
  /// tol^(k+1), relative to err^(0), from err^(k)/err^(0) and tol^(k).
  [[nodiscard]] S next(S const& error, S const&) const { return tolerance * error; }
};

/// tol^(k+1) = min(r_tol err^(k)/err^(0), c_fact tol^(k)),  tol^(0) = r_tol/c_fact.
template <class S>
struct adaptive_precision {
  S r_tol = S(0.5);     ///< in (0, 1): accuracy relative to that of the last iterate
  S c_fact = S(0.999);  ///< in (0, 1): what tol falls by at least, wanted or not

  void validate() const {
    if (!(r_tol > S(0) && r_tol < S(1))) {
      throw bad_input("precision.r_tol", detail::show(r_tol), "a number in (0, 1)");
    }
    if (!(c_fact > S(0) && c_fact < S(1))) {
      throw bad_input("precision.c_fact", detail::show(c_fact), "a number in (0, 1)");
    }
  }
  /// tol^(0).
  [[nodiscard]] S first() const { return r_tol / c_fact; }
  /// tol^(k+1), relative to err^(0), from err^(k)/err^(0) and tol^(k).
  [[nodiscard]] S next(S const& error, S const& last) const {
    return std::min<S>(r_tol * error, c_fact * last);
  }
};

}  // namespace slant
