// SPDX-License-Identifier: MIT
//
// The frame of the active set methods KPRGP, QPQ and QPC: conjugate gradients on a face, expansion
// of the active set by projected gradient steps, and a rule that says when and how blocks are
// released from it.
//
//     the rule keeps the face:   conjugate gradient step over F [K (31), (32)]; if it leaves Λ, a
//                                half step to the boundary and the expansion  x ← x − α̃ φ̃
//     otherwise:                 proportioning  x ← x − α̃ β̃,  or the step along −β to the minimum
//                                of q or the boundary of Λ
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/parts/recession.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/face.hpp>

#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// Options of kprgp, qpq and qpc.
template <class S>
struct kprgp_options {
  S proportioning = S(1);    ///< Γ > 0 of [K (33)]: large keeps the face, small releases early
  S face_accuracy = S(0.1);  ///< of qpc, in [0, 1): CG goes on until ‖φ‖ is this fraction of its
                             ///< first size on the face, and of ‖β‖
  std::optional<S> step_length{};  ///< α̃ in (0, 2/σ_max); not given: see krylov/spectrum.hpp
  S step_factor = S(1.9);          ///< in (0, 2), of that step; the bricks need half the steps of 1
  /// Blocks count as free if P_Λ(x − α̃ r) is not on the boundary, in the sets of semismooth Newton
  /// [K (60), (61)], as for AS-S [K Ex 5]; else if x is not: f_i < 0 [K §3.1.1].
  bool semismooth_sets = false;
  index refresh = 50;     ///< CG steps after which r = A x − b is recomputed; 0: never
  index patience = 1000;  ///< steps in which neither ‖r̃‖ nor q falls that mean stalled
  spectral_bound_options spectrum{};  ///< how σ_max is bounded, if it is needed

  [[gnu::cold]] void validate() const {
    detail::check_positive("proportioning", proportioning);
    detail::check_option("face_accuracy", face_accuracy,
                         face_accuracy >= S(0) && face_accuracy < S(1), "a number in [0, 1)");
    if (step_length) detail::check_positive("step_length", *step_length);
    detail::check_option("step_factor", step_factor, step_factor > S(0) && step_factor < S(2),
                         "a number in (0, 2)");
    if (refresh < 0) throw bad_input("refresh", detail::show(refresh), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    spectrum.validate();
  }
};

/// The three steps of KPRGP, QPQ and QPC.
enum class kprgp_step : unsigned char { conjugate_gradient, expansion, proportioning };

/// State of kprgp, qpq and qpc for a separable_qp of type QP.
template <class QP>
struct kprgp_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  vector_type φ;                                 ///< free gradient; between steps scratch
  conjugate_directions<vector_type> directions;  ///< p, Ap, pᵀAp; p vanishes off the face
  recession_watch<vector_type> recession;        ///< looks for descent without end
  progress_watch<scalar> progress;               ///< looks for steps that get nowhere
  face_t<typename QP::set_type, local_t<vector_type>> face;  ///< that of x at the last restart

  scalar φr{0};  ///< φ̃ᵀr / unit², what the free set can still gain; of qpq and qpc: ‖φ‖² / unit²
  scalar βr{0};  ///< β̃ᵀr / unit², what the active set can still gain; of qpq and qpc: ‖β‖² / unit²
  scalar φr_at_restart{0};  ///< φr when the face was chosen
  scalar σ{0};              ///< σ_max to a few digits; known if A is not declared definite
  bool no_minimum = false;  ///< ended by a direction along which q has no minimum in floating point
  kprgp_step last_step = kprgp_step::conjugate_gradient;
  index iteration = 0;
  slant::status status = slant::status::running;

  kprgp_state(QP const& qp, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        φ(like(x0, qp.size())),
        directions(x0),
        recession(x0, declares_positive_definite<typename QP::operator_type> ? 0 : qp.size()) {}

  [[nodiscard, gnu::cold]] std::string reason() const {
    std::string const why =
        no_minimum ? "along a direction that does not leave the set the curvature is lost in "
                     "rounding errors: "
                   : "neither the reduced gradient nor the function has fallen any more: ";
    return detail::reason_of(status, {.stalled = why + this->accuracy()});
  }
};

/// A problem that lacks something ends here; kprgp, qpq and qpc say what it is.
template <class QP, class Rule>
class proportioning : public detail::refused_program<QP, kprgp_state<std::remove_cvref_t<QP>>,
                                                     kprgp_options<detail::program_scalar_t<QP>>> {
 public:
  using proportioning::refused_method::refused_method;
};

namespace detail {

/// What `proportioning` does with a problem that has all it needs.
template <class QP, class Rule>
class proportioning_steps {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = kprgp_options<scalar>;
  using state_type = kprgp_state<problem>;

  /// Throws bad_input for options out of range.
  explicit proportioning_steps(held<QP> qp, options o = {})
      : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
  }

  /// The state of P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if
  /// 1/σ_max is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const;

  /// One step on the face, or one that changes it.
  void step(state_type& s) const;

  /// Goes on from s.x after b of the problem has changed: r, r̃ and the face anew, everything else
  /// (units, scales, bounds) as it is. One application; no allocation.
  void resume(state_type& s) const;

  /// As start(x0), in a state that start has made, after b or Λ of the problem have changed: what
  /// depends on A alone (α̃, σ_max, all memory) stays. Counts begin at zero. x0 must not be s.x. One
  /// application; no allocation.
  void resume(state_type& s, vector_type const& x0) const;

  /// r and r̃ from x, if CG steps have been updating r instead; whether they have. One application.
  bool refresh(state_type& s) const;

 private:
  static constexpr index most_confirming_steps = 500;
  static constexpr bool definite = declares_positive_definite<typename problem::operator_type>;

  /// [K (31), (32)]. False if the step leaves Λ: then x has moved up to the boundary.
  bool conjugate_gradient_step(state_type& s) const {
    s.face.keep(s.r, s.φ);
    auto const step = step_along(s);
    if (step.end == feasible_step_end::boundary) {
      half_step(s, step);  // what follows projects x
      split(s);
      return false;
    }
    if (step.end == feasible_step_end::minimum) {
      renew(s);
      split(s);
      s.last_step = kprgp_step::conjugate_gradient;
    }
    return true;
  }

  /// The step from the gradient in s.φ. Sets the status if there is none.
  feasible_step<scalar> step_along(state_type& s) const {
    auto const& qp = qp_.get();
    next_direction(qp.a(), s);
    bool const σ_unknown = options_.step_length.has_value();
    auto const step =
        step_within(qp.set(), s, kernel_curvature<definite>(s.directions, s.σ, σ_unknown));
    // A is not what it promised, or not a number.
    if (step.end == feasible_step_end::broken) s.status = status::breakdown;
    if (step.end == feasible_step_end::endless) {
      bool descent = false;
      if constexpr (!definite) {
        descent = step.flat &&
                  is_descent(step.slope, s.directions.p, scalar(s.size_of_b + norm(s.r))) &&
                  confirm_descent(qp, s, most_confirming_steps);
      }
      s.status = descent ? status::unbounded : status::stalled;
      s.no_minimum = true;
      s.reduce(qp);
    }
    return step;
  }

  /// r anew from x after many updates.
  void renew(state_type& s) const {
    if (options_.refresh > 0 && s.since_refresh >= options_.refresh) compute_gradient(s);
  }

  /// r from x.
  void compute_gradient(state_type& s) const {
    if (s.gradient_and_unit(qp_.get())) s.progress.forget_energy();
  }

  /// r and r̃ from x; the next direction is φ itself.
  void recompute(state_type& s) const {
    s.directions.live = false;
    compute_gradient(s);
    split(s);
  }

  /// x ← x − α̃ φ̃: may add blocks to the active set.
  void expansion_step(state_type& s) const {
    s.face.keep(s.projected, s.φ);
    s.face.keep_complement(s.x, s.trial);
    take_gradient_step(s, kprgp_step::expansion);
  }

  /// May release blocks from the active set.
  void release_step(state_type& s) const {
    if constexpr (Rule::minimising) {  // x ← x − α β, no further than the boundary
      Rule::release_direction(qp_.get(), s, s.φ);
      s.directions.live = false;
      auto const step = step_along(s);
      if (s.status != status::running) return;
      if (step.end == feasible_step_end::boundary) half_step_within(qp_.get().set(), s, step);
      renew(s);
      restart(s);
      s.last_step = kprgp_step::proportioning;
    } else {  // x ← x − α̃ β̃
      s.face.keep_complement(s.projected, s.φ);
      s.face.keep(s.x, s.trial);
      take_gradient_step(s, kprgp_step::proportioning);
    }
  }

  /// The blocks that move are in s.φ, the others in s.trial.
  void take_gradient_step(state_type& s, kprgp_step kind) const {
    vectors::sum(s.φ, s.trial, s.x);
    compute_gradient(s);
    restart(s);
    s.last_step = kind;
  }

  /// A new face; the next direction is φ itself.
  void restart(state_type& s) const {
    s.reduce(qp_.get());
    s.face.assign(qp_.get().set(), slant::local(options_.semismooth_sets ? s.projected : s.x));
    s.directions.live = false;
    Rule::weigh(qp_.get(), s);
    s.φr_at_restart = s.φr;
    if constexpr (!definite) {
      // Steps that leave Λ again and again may still sum up to a direction that never does.
      if (s.status == status::running && s.reduced_gradient_norm > scalar(0) &&
          s.recession.found(qp_.get(), s)) {
        s.status = status::unbounded;
      }
    }
  }

  /// r̃ and what its two parts can gain.
  void split(state_type& s) const {
    s.reduce(qp_.get());
    Rule::weigh(qp_.get(), s);
  }

  /// The status of the point at which a step has ended, never of one that it has passed. Whatever
  /// ends the run counts if r was computed from x; if not, the run goes on from there.
  void settle(state_type& s) const {
    bool const at_end = s.status != status::running || s.reduced_gradient_norm == scalar(0);
    if (at_end && s.since_refresh > 0 && s.status != status::unbounded) {
      s.status = status::running;
      recompute(s);
    }
    if (s.status == status::running) detail::judge_reduced_gradient(s);
  }

  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    auto const energy = [&] { return s.energy(qp_.get()); };
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, energy,
                           s.rounding())) {
      s.no_minimum = false;
      if (s.since_refresh > 0) recompute(s);
      s.status = status::stalled;
      detail::judge_reduced_gradient(s);
    }
  }

  held<QP> qp_;
  options options_;
};

template <class QP, class Rule>
auto proportioning_steps<QP, Rule>::start(vector_type const& x0) const -> state_type {
  auto const& qp = qp_.get();
  detail::check_start_in_set(x0, qp_.get().b());
  state_type s(qp, x0);
  s.σ = s.set_step_length(qp, options_.step_length, options_.step_factor, options_.spectrum);
  bool const solved = s.begin(qp, x0);
  restart(s);
  settle(s);
  if (solved) s.status = status::converged;
  return s;
}

template <class QP, class Rule>
void proportioning_steps<QP, Rule>::step(state_type& s) const {
  if (s.status != status::running) return;
  if (Rule::keeps_face(s, options_)) {
    if (!conjugate_gradient_step(s)) expansion_step(s);
  } else {
    release_step(s);
  }
  ++s.iteration;
  settle(s);
  note_progress(s);
}

template <class QP, class Rule>
void proportioning_steps<QP, Rule>::resume(state_type& s) const {
  s.status = status::running;
  s.progress = {};
  s.recession.forget();
  compute_gradient(s);
  restart(s);
  settle(s);
}

template <class QP, class Rule>
void proportioning_steps<QP, Rule>::resume(state_type& s, vector_type const& x0) const {
  detail::check_start_in_set(x0, qp_.get().b());
  s.progress = {};
  s.recession.forget();
  s.iteration = 0;
  s.status = status::running;
  bool const solved = s.begin_again(qp_.get(), x0);
  restart(s);
  settle(s);
  if (solved) s.status = status::converged;
}

template <class QP, class Rule>
bool proportioning_steps<QP, Rule>::refresh(state_type& s) const {
  if (s.since_refresh == 0) return false;
  s.status = status::running;
  recompute(s);
  detail::judge_reduced_gradient(s);
  return true;
}

}  // namespace detail

/// Active set method with a rule of kprgp.hpp. Requires: psd_operator (A symmetric
/// positive semidefinite) and separable_set with step_to_boundary.
template <class QP, class Rule>
  requires kprgp_problem<std::remove_cvref_t<QP>>
class proportioning<QP, Rule> : public detail::proportioning_steps<QP, Rule> {
 public:
  using proportioning::proportioning_steps::proportioning_steps;
};

}  // namespace slant
