// SPDX-License-Identifier: MIT
//
// Semismooth Newton without the curvature term of the friction discs [K §3.3.3, (56)], after the
// displacements are eliminated:
//
//     minimise   q(λ) = ½ λᵀA λ − bᵀλ   over   λ ∈ Λ = Λ₁ × … × Λ_m,     r(λ) = A λ − b,
//     r̃(λ) = (λ − P_Λ(λ − ρ r)) / ρ
//
//     (1°)   err^(k) = 0:  stop
//     (2°)   z = λ^(k) − ρ r^(k),   𝒜 = blocks with zᵢ inside Λᵢ                          (60),
//     (61) (3.1°) tol^(k+1) from err^(k)/err^(0) and tol^(k) (3.2°) λ^(k+1,0): frozen blocks λᵢ =
//     P_Λᵢ(zᵢ) for i ∉ 𝒜 (57), or P_Λ(z)             (63) (3.3°) λ^(k+1): minimum of q over the
//     blocks in 𝒜 by conjugate gradients, to tol^(k+1) err^(0) (4°)   err^(k+1) = ‖r̃(P_Λ(λ^(k+1)))‖
//
// 𝒜 is the set of free blocks of P_Λ(z). It differs from (60), (61) only if zᵢ is on the boundary
// itself, the kink of P_Λᵢ where any value is a slanting function. Rejected: 𝒜 with the boundary. A
// block that starts there may block the first CG step, and one that is a single point, such as a
// disc of radius 0, must not move at all.
//
// Products: one for each inner iteration, which takes the whole of r along; one for the start of a
// step, unless λ^(k+1,0) = λ^(k); one for (4°), if λ^(k+1) has left Λ.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/gradient_step.hpp>
#include <slant/methods/modified_newton_options.hpp>
#include <slant/methods/modified_newton_parts.hpp>
#include <slant/methods/modified_newton_problem.hpp>
#include <slant/methods/modified_newton_state.hpp>
#include <slant/methods/separable_qp.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// The frame of mssn, imssn and gimssn. Start and Inner are parts of modified_newton_parts.hpp,
/// Forcing is a rule of newton/forcing.hpp. Requires: psd_operator (A positive definite on the
/// faces that occur) and separable_set with step_to_boundary.
template <class QP, class Start, class Inner, class Forcing>
  requires kprgp_problem<std::remove_cvref_t<QP>>
class modified_newton<QP, Start, Inner, Forcing> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = modified_newton_options<scalar, Forcing>;
  using state_type = modified_newton_state<problem, Inner>;

  explicit modified_newton(held<QP> qp) : modified_newton(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  modified_newton(held<QP> qp, options o) : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
    if (Inner::stays_inside && !options_.step_length && !(options_.step_factor < scalar(2))) {
      throw bad_input("step_factor", detail::show(options_.step_factor), "a number in (0, 2)");
    }
  }

  /// The state of λ^(0) = P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong
  /// size, or if 1/σ_max is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_start_in_set(x0, qp_.get().b());
    state_type s(qp, x0);
    set_step_length(s);
    begin_newton(s, s.begin(qp, x0));
    return s;
  }

  /// As start(x0), in a state that start has made, after b or Λ of the problem have changed: what
  /// depends on A alone (ρ, σ_max, all memory) stays. Counts begin at zero. x0 must not be s.x. One
  /// application; no allocation.
  void resume(state_type& s, vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    if constexpr (!Inner::stays_inside) s.outside.in_use = false;
    s.progress = {};
    s.recession.forget();
    s.iteration = s.inner_iterations = 0;
    s.last_inner = inner_end::going_on;
    s.status = status::running;
    begin_newton(s, s.begin_again(qp_.get(), x0));
  }

  /// One Newton step, (2°) to (4°), with its inner iterations.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    return_to_iterate(s);
    s.face.assign(qp_.get().set(), slant::local(s.projected));
    scalar const η = s.forcing.next(options_.forcing);
    start_on_face(s);
    minimise(s, inner_accuracy(options_.forcing, η, s.forcing));
    measure(s);
    s.forcing.record(s.reduced_gradient_norm);
    ++s.iteration;
    note_progress(s);
  }

  /// r and r̃ from x, if inner iterations have been updating r instead; whether they have. One
  /// application.
  bool refresh(state_type& s) const {
    if (s.since_refresh == 0) return false;
    s.status = status::running;
    compute_gradient(s);
    reduce(s);
    judge(s);
    return true;
  }

 private:
  static constexpr bool definite = declares_positive_definite<typename problem::operator_type>;

  void begin_newton(state_type& s, bool solved) const {
    s.face.assign(qp_.get().set(), slant::local(s.x));
    reduce(s);
    judge(s);
    s.forcing = s.forcing.starting_at(s.reduced_gradient_norm);
    if (solved) s.status = status::converged;
  }

  /// λ^(k), its r and P_Λ(z), if x is only its projection.
  void return_to_iterate(state_type& s) const {
    if constexpr (!Inner::stays_inside) {
      if (!s.outside.in_use) return;
      exchange(s);
      s.outside.in_use = false;
      vectors::waxpy(-(s.step_length * s.unit), s.r, s.x, s.trial);
      slant::project(qp_.get().set(), slant::local(s.trial), slant::local(s.projected));
    }
  }

  /// (3.2°): r is computed anew unless λ stays where it is.
  void start_on_face(state_type& s) const {
    Start::place(s);
    bool const stays = slant::everywhere(s.x, vectors::equal(s.trial, s.x));
    if (stays && (options_.refresh == 0 || s.since_refresh < options_.refresh)) return;
    std::swap(s.x, s.trial);
    compute_gradient(s);
  }

  /// r from x.
  void compute_gradient(state_type& s) const {
    if (s.gradient_and_unit(qp_.get())) s.progress.forget_energy();
  }

  /// (3.3°): conjugate gradients on the face until ‖r‖ there is at most `accuracy`. By recurrences
  /// it would go on to fall below the rounding errors of r, until its squares vanish.
  void minimise(state_type& s, scalar const& accuracy) const {
    auto const& qp = qp_.get();
    scalar const noise =
        std::numeric_limits<scalar>::epsilon() / scalar(4) * (s.size_of_b + norm(s.r));
    scalar const size = std::max<scalar>(accuracy, s.unit * noise);
    s.directions.live = false;
    s.inner_iterations = 0;
    s.last_inner = inner_end::going_on;
    while (s.last_inner == inner_end::going_on) {
      s.face.keep(s.r, s.φ);
      if (s.unit * norm(s.φ) <= size) {
        s.last_inner = inner_end::accurate;
      } else if (s.inner_iterations == options_.max_inner) {
        s.last_inner = inner_end::limit;
      } else {
        next_direction(qp.a(), s);
        ++s.inner_iterations;
        bool const σ_unknown = options_.step_length.has_value();
        s.last_inner =
            Inner::advance(qp.set(), s, kernel_curvature<definite>(s.directions, s.σ, σ_unknown));
      }
    }
    s.work.inner_iterations += s.inner_iterations;
    if (s.last_inner == inner_end::broken) s.status = status::breakdown;
    if (s.last_inner == inner_end::endless) look_for_descent(s);
  }

  /// Where an inner iteration has found no minimum along p and no end of Λ.
  void look_for_descent(state_type& s) const {
    if constexpr (definite) {
      s.status =
          status::breakdown;  // a curvature of 0 is out of range, or A is not what it promised
    } else {
      bool const confirmed = confirm_descent(qp_.get(), s, options_.max_inner);
      s.status = confirmed ? status::unbounded : status::stalled;
    }
  }

  /// (4°), with x = P_Λ(λ).
  void measure(state_type& s) const {
    if constexpr (!Inner::stays_inside) {
      slant::project(qp_.get().set(), slant::local(s.x), slant::local(s.trial));
      bool const inside = slant::everywhere(s.x, vectors::equal(s.trial, s.x));
      if (!inside) {
        s.outside.in_use = true;
        exchange(s);
        std::swap(s.x, s.trial);
        compute_gradient(s);
      }
    }
    reduce(s);
    // r̃ = 0 counts if r was computed from x.
    if (s.reduced_gradient_norm == scalar(0) && s.since_refresh > 0) {
      compute_gradient(s);
      reduce(s);
    }
    judge(s);
    if constexpr (!definite) {
      // Steps that end at the boundary again and again may still sum up to a direction of descent
      // that never does.
      if (s.status == status::running && s.recession.found(qp_.get(), s)) {
        s.status = status::unbounded;
      }
    }
  }

  static void exchange(state_type& s) {
    std::swap(s.x, s.outside.x);
    std::swap(s.r, s.outside.r);
    std::swap(s.since_refresh, s.outside.since_refresh);
  }

  void reduce(state_type& s) const { s.reduce(qp_.get()); }

  /// The status of the point at which a step has ended.
  void judge(state_type& s) const {
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
    if (s.status == status::running && s.reduced_gradient_norm == scalar(0)) {
      s.status = status::converged;
    }
  }

  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    auto const energy = [&] { return s.energy(qp_.get()); };
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, energy,
                           s.rounding())) {
      s.status = status::stalled;
    }
  }

  /// Not inlined: g++ 12 would see *step_length read where there is none.
  [[gnu::noinline]] void set_step_length(state_type& s) const {
    if (options_.step_length) {
      s.step_length = *options_.step_length;
      return;
    }
    auto const safe = safe_gradient_step(qp_.get().a(), s.x, scalar(1), options_.spectrum);
    s.step_length = options_.step_factor * safe.length;
    s.σ = safe.σ;
    s.work.setup_applications += safe.applications;
    if (!detail::is_finite(s.step_length)) {
      throw bad_input("step_factor", detail::show(options_.step_factor),
                      "one for which step_factor / sigma_max is finite");
    }
  }

  held<QP> qp_;
  options options_;
};

}  // namespace slant
