// SPDX-License-Identifier: MIT
//
// KPRGP, "KKT proportioning with reduced gradient projections" [K §3.1.2, (30)–(33), Theorem 1]:
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m
//
//     r(x)  = A x − b                          gradient
//     r̃(x)  = (x − P_Λ(x − α̃ r)) / α̃           reduced gradient, zero exactly at the solution
//     F, 𝒜  = blocks with f_i < 0, f_i = 0       free and active set; or, with the active sets of
//                                                semismooth Newton, those of P_Λ(x − α̃ r)
//     φ̃, β̃  = r̃ on F, r̃ on 𝒜;   φ = r on F
//
//     (1°) r̃ = 0:                     stop
//     (2°) β̃ᵀr < Γ² φ̃ᵀr:              conjugate gradient step over F; if it leaves Λ, expansion
//                                         x ← x − α̃ φ̃ instead
//     (3°) otherwise:                 proportioning  x ← x − α̃ β̃
//
// Every gradient step is a projected gradient step on some of the blocks: with d its change of x,
// q falls by at least (1/α̃ − σ_max/2) ‖d‖², so α̃ ∈ (0, 2/σ_max) decreases q whatever the sets are.
// For blocks as symmetric as balls, intervals and half lines q falls R-linearly by the factor
// 1 − α̃ σ_min / (2 + 2 max(Γ, 1/Γ)²) a step [K Theorem 1].
//
// Known weakness: on a curved boundary a sliding block moves only by fixed gradient steps.
#pragma once

#include <slant/concepts/distributed.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/krylov/gradient_step.hpp>
#include <slant/methods/kprgp_options.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/kprgp_state.hpp>
#include <slant/methods/separable_qp.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// KPRGP for a separable_qp: solve(kprgp{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// Requires: psd_operator (A symmetric positive semidefinite) and separable_set with
/// step_to_boundary. Spends one application of A a step (two for an expansion and for a CG step
/// that recomputes r) and, only if no step_length is given, those for the bound of σ_max at the
/// start. Statuses of its own: converged (r̃ = 0); unbounded (q decreases for ever along
/// −state.directions.p; only if A is not declared definite); stalled (neither ‖r̃‖ nor q fell for
/// `patience` steps, or q falls for ever, but only along a curve on the boundary of a cone);
/// breakdown (a number left the range of the scalar, or A was seen not to be semidefinite).
template <class QP>
  requires kprgp_problem<std::remove_cvref_t<QP>>
class kprgp<QP> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = kprgp_options<scalar>;
  using state_type = kprgp_state<problem>;

  explicit kprgp(held<QP> qp) : kprgp(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  kprgp(held<QP> qp, options o) : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
  }

  /// The state of P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if
  /// 1/σ_max is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_size("x0", index(slant::local(x0).size()), qp.size(), "the size of b,");
    detail::check_finite("x0", x0);
    state_type s(qp, x0);
    set_step_length(s);
    bool const solved = s.begin(qp, x0);
    restart(s);
    if (solved) s.status = status::converged;
    return s;
  }

  /// One step (2°) or (3°).
  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (strictly_proportional(s)) {
      if (!conjugate_gradient_step(s)) expansion_step(s);
    } else {
      proportioning_step(s);
    }
    ++s.iteration;
    note_progress(s);
  }

  /// r and r̃ from x, if CG steps have been updating r instead; whether they have. One application.
  bool refresh(state_type& s) const {
    if (s.since_refresh == 0) return false;
    s.status = status::running;
    s.directions.live = false;
    s.gradient(qp_.get());
    split(s);
    return true;
  }

 private:
  static constexpr bool definite = declares_positive_definite<typename problem::operator_type>;

  static scalar epsilon() { return std::numeric_limits<scalar>::epsilon(); }

  /// [K (33)]: the error on the active set is small against the one on the free set.
  [[nodiscard]] bool strictly_proportional(state_type const& s) const {
    auto const& Γ = options_.proportioning;
    return s.βr < Γ * Γ * s.φr;
  }

  /// [K (31), (32)]. False if the step leaves Λ (then x may have moved up to the boundary).
  bool conjugate_gradient_step(state_type& s) const {
    auto const& qp = qp_.get();
    s.face.keep(s.r, s.φ);
    next_direction(qp.a(), s);
    auto const step = step_within(
        qp.set(), s,
        kernel_curvature<definite>(s.directions, s.σ, options_.step_length.has_value()));
    switch (step.end) {
      case feasible_step_end::minimum:
        if (options_.refresh > 0 && s.since_refresh >= options_.refresh) s.gradient(qp);
        split(s);
        s.last_step = kprgp_step::conjugate_gradient;
        return true;
      case feasible_step_end::boundary:
        if (options_.half_step || step.flat) {
          half_step(s, step);
          split(s);
        }
        return false;
      case feasible_step_end::endless: {
        bool const descent =
            !definite && step.flat && is_descent(step.slope, s.directions.p, gradient_noise(s));
        s.status = descent ? status::unbounded : status::stalled;
        return true;
      }
      default:  // A is not what it promised, or not a number
        s.status = status::breakdown;
        return true;
    }
  }

  /// x ← x − α̃ φ̃: may add blocks to the active set.
  void expansion_step(state_type& s) const {
    s.face.keep(s.projected, s.φ);
    s.face.keep_complement(s.x, s.trial);
    take_gradient_step(s, kprgp_step::expansion);
  }

  /// x ← x − α̃ β̃: may release blocks from the active set.
  void proportioning_step(state_type& s) const {
    s.face.keep_complement(s.projected, s.φ);
    s.face.keep(s.x, s.trial);
    take_gradient_step(s, kprgp_step::proportioning);
  }

  /// The blocks that move are in s.φ, the others in s.trial.
  void take_gradient_step(state_type& s, kprgp_step kind) const {
    slant::local(s.x) = slant::local(s.φ) + slant::local(s.trial);
    s.gradient(qp_.get());
    restart(s);
    s.last_step = kind;
  }

  /// A new face; the next direction is φ itself.
  void restart(state_type& s) const {
    bool const semismooth = options_.active_sets == active_set_rule::semismooth;
    s.reduce(qp_.get());
    s.face.assign(qp_.get().set(), slant::local(semismooth ? s.projected : s.x));
    s.directions.live = false;
    weigh(s);
    if constexpr (!definite) {
      // Steps that leave Λ again and again may still sum up to a direction that never does.
      if (s.recession.found(qp_.get().set(), s)) s.status = status::unbounded;
    }
  }

  /// r̃ and what its two parts can gain.
  void split(state_type& s) const {
    s.reduce(qp_.get());
    weigh(s);
  }

  void weigh(state_type& s) const {
    scalar const rounding = epsilon() * norm(s.x) / (s.step_length * s.unit);  // of r̃
    scalar const noise = rounding * norm(s.r);
    s.face.keep(s.reduced, s.φ);
    s.φr = gain(s.φ, s.r, noise);
    s.face.keep_complement(s.reduced, s.φ);
    s.βr = gain(s.φ, s.r, noise);
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
  }

  /// At least max(‖b‖, ‖A x‖) / unit.
  static scalar gradient_noise(state_type const& s) { return s.size_of_b + norm(s.r); }

  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    auto const energy = [&] { return s.energy(qp_.get()); };
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, energy)) {
      s.status = status::stalled;
    }
  }

  void set_step_length(state_type& s) const {
    if (options_.step_length) {
      s.step_length = *options_.step_length;
      return;
    }
    auto const safe =
        safe_gradient_step(qp_.get().a(), s.x, options_.step_factor, options_.spectrum);
    s.step_length = safe.length;
    s.σ = safe.σ;
    s.work.setup_applications += safe.applications;
  }

  held<QP> qp_;
  options options_;
};

template <class QP>
kprgp(QP&&) -> kprgp<kept_t<QP>>;
template <class QP>
kprgp(QP&&, kprgp_options<typename std::remove_cvref_t<QP>::scalar>) -> kprgp<kept_t<QP>>;

}  // namespace slant
