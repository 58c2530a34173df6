// SPDX-License-Identifier: MIT
//
// Symmetric semismooth Newton method with the curvature of the constraints, for
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m                      [K (29)]
//
// It is Newton's method for the natural residual F(y) = y − P_Λ(z), z = y − ρ r(y), r(y) = A y − b.
// With G = P_Λ°(z), x = P_Λ(z), dy = x + t − y the equation (I − G(I − ρA)) dy = −F becomes
//
//     (Π A Π + C/ρ) t = −Π r(x),     t ∈ range(G),  C = G⁺ − I on it ⪰ 0,  Π onto range(G),
//
// self-adjoint and positive definite, so that conjugate gradients solve it where [K (54)] needs
// BiCGSTAB; and it keeps the term C that MSSN drops [K (55)], without which a sliding disc creeps.
//
//     project     x ← P_Λ(z), r ← A x − b                        one product
//     classify    G, Π, C at z                                   sets/curved_face.hpp
//     solve       t and A t                                      one product a step of CG
//     shorten     β = 1, ½, … until ‖F(y + β dy)‖ ≤ (1 − c β) ‖F(y)‖    no product
//     accept      y ← y + β dy; others see x ∈ Λ with a gradient computed from x
//
// Convergence, for positive definite A. Near a solution with an invertible Newton operator the
// steps are full and superlinear [T Theorem 1.2]: of order min(forcing.exponent, that of the set).
// Far from it each accepted step lowers ‖F‖ by the factor 1 − c 2⁻ʰ at least, h = halvings. If none
// is accepted, KPRGP takes over at x until ‖F‖ is a tenth below its value when Newton failed; this
// happens after finitely many of its steps, because they converge to the solution from every x ∈ Λ
// [K Theorem 1]. So between two failures ‖F‖ falls, from failure to failure it falls by a factor,
// and the values of ‖F‖ tend to zero whatever the start and ρ are.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/methods/descent_takeover.hpp>
#include <slant/methods/symmetric_newton_options.hpp>
#include <slant/methods/symmetric_newton_problem.hpp>
#include <slant/methods/symmetric_newton_state.hpp>
#include <slant/operators/identity.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// The method at the top of this file: solve(symmetric_newton{qp}, x0, reduced_gradient_below(1e-8)
/// || at_most(100)); symmetric_newton{qp, M} with a preconditioner M ≈ A⁻¹, options last. Requires
/// of the problem what kprgp does, and blocks with slant(x); of M psd_operator. Begins at P_Λ(x0).
/// Statuses of its own: converged (r̃ = 0); stalled (the precision is exhausted); unbounded (only if
/// A is not declared definite); breakdown.
template <class QP, class M>
  requires symmetric_newton_problem<std::remove_cvref_t<QP>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class symmetric_newton<QP, M> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using preconditioner = std::remove_cvref_t<M>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = symmetric_newton_options<scalar>;
  using state_type = symmetric_newton_state<problem, preconditioner>;
  static constexpr bool preconditioned = !std::is_same_v<preconditioner, identity_operator>;

  explicit symmetric_newton(held<QP> qp)
    requires(!preconditioned)
      : symmetric_newton(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  symmetric_newton(held<QP> qp, options o)
    requires(!preconditioned)
      : qp_(std::move(qp)), m_(identity_operator(qp_.get().size())), options_(std::move(o)) {
    options_.validate();
  }
  symmetric_newton(held<QP> qp, held<M> m)
      : symmetric_newton(std::move(qp), std::move(m), options{}) {}
  /// Throws bad_input if the size of M is not that of the problem, or for options out of range.
  symmetric_newton(held<QP> qp, held<M> m, options o)
      : qp_(std::move(qp)), m_(std::move(m)), options_(std::move(o)) {
    detail::check_size("rows of the preconditioner", index(m_.get().rows()), qp_.get().size());
    detail::check_size("columns of the preconditioner", index(m_.get().cols()), qp_.get().size());
    options_.validate();
  }

  /// The state of P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if
  /// ρ is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_start_in_set(x0, qp_.get().b());
    state_type s(qp, m_.get(), x0);
    set_sizes(s);
    begin_newton(s, s.begin(qp, x0));
    return s;
  }

  /// One Newton step, or one step of KPRGP where Newton's method has failed.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (s.descent.at_work()) {
      descend(s);
    } else {
      project(s);
      if (s.status == status::running) newton_step(s);
    }
    ++s.iteration;
    note_progress(s);
  }

  /// Goes on from s.x after b of the problem has changed: r and r̃ anew, everything else (units,
  /// scales, ρ) as it is. One product; no allocation.
  void resume(state_type& s) const {
    s.status = status::running;
    s.progress = {};
    s.descent.leave();
    measure(s);
    begin_newton(s, false);
  }

  /// As start(x0), in a state that start has made, after b or Λ of the problem have changed: what
  /// depends on A alone (ρ, mean(diag M), all memory) stays. Counts begin at zero. x0 must not be
  /// s.x. One product; no allocation.
  void resume(state_type& s, vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    s.progress = {};
    s.descent.leave();
    s.last_step = symmetric_newton_step::none;
    s.iteration = s.inner_iterations = 0;
    s.status = status::running;
    begin_newton(s, s.begin_again(qp_.get(), x0));
  }

  /// r from x where KPRGP has been updating it; whether it has. One product.
  bool refresh(state_type& s) const {
    return s.descent.at_work() && s.descent.refresh(qp_.get(), options_.descent, s);
  }

 private:
  /// x = P_Λ(z) with r and r̃; nothing to do if it is there.
  void project(state_type& s) const {
    if (s.at_projection) return;
    std::swap(s.x, s.projected);
    s.at_projection = true;
    measure(s);
  }

  void newton_step(state_type& s) const {
    auto const& qp = qp_.get();
    s.face.assign(qp.set(), slant::local(s.segment.z), s.preconditioner_size / s.step_length);
    scalar const target = s.forcing.next(options_.forcing) * s.residual_norm / s.unit;
    auto const inner =
        s.products.minimise(s.inner, qp.a(), s.a_workspace, m_.get(), s.r, s.face, s.step_length,
                            s.preconditioner_size, target, options_.inner_steps);
    s.inner_iterations = inner.iterations;
    s.work.inner_iterations += inner.iterations;
    s.work.operator_applications += inner.iterations;
    if (!inner.finite) {
      s.status = status::breakdown;
      return;
    }
    slant::local(s.segment.target_y) = slant::local(s.x) + s.unit * slant::local(s.inner.t);
    slant::local(s.inner.image) += slant::local(s.r);
    slant::local(s.segment.target_z) =
        slant::local(s.segment.target_y) - ρ(s) * slant::local(s.inner.image);
    if (shorten(s)) {
      accept(s);
    } else if (s.products.at_work()) {
      s.products.give_up();  // the next step is computed anew
    } else {
      begin_descent(s);
    }
  }

  /// The longest β = 2⁻ʲ that lowers ‖F‖ enough; false if there is none. Spends no product.
  bool shorten(state_type& s) const {
    scalar β(1);
    for (index j = 0; j <= options_.halvings; ++j, β /= scalar(2)) {
      scalar const size =
          s.segment.residual_at(qp_.get().set(), β, s.projected, s.trial) / s.step_length;
      scalar const enough = (scalar(1) - options_.sufficient * β) * s.residual_norm;
      if (!(enough < s.residual_norm)) return false;  // β is below the precision
      if (size <= enough) {
        s.step_fraction = β;
        s.residual_norm = size;
        return true;
      }
    }
    return false;
  }

  void accept(state_type& s) const {
    scalar const& β = s.step_fraction;
    s.segment.advance(β);
    std::swap(s.x, s.projected);
    measure(s);
    s.forcing.record(s.residual_norm);
    s.last_step = β == scalar(1) ? symmetric_newton_step::full : symmetric_newton_step::damped;
  }

  /// r and r̃ of x; one product.
  void measure(state_type& s) const {
    s.gradient(qp_.get());
    s.reduce(qp_.get());
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
  }

  /// Newton's iterate and its forcing terms from x, r and r̃.
  void begin_newton(state_type& s, bool solved) const {
    restart(s);
    s.forcing = forcing_history<scalar>::starting_at(s.residual_norm);
    s.forcing.first_error = s.gradient_scale;
    if (solved || s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
  }

  void restart(state_type& s) const {
    slant::local(s.segment.y) = slant::local(s.x);
    slant::local(s.segment.z) = slant::local(s.x) - ρ(s) * slant::local(s.r);
    s.residual_norm = s.reduced_gradient_norm;
    s.at_projection = false;
  }

  /// Where no length is accepted: the other method takes over, unless there are no digits left.
  void begin_descent(state_type& s) const {
    if (s.residual_norm <= s.rounding()) {
      s.status = status::stalled;
      return;
    }
    scalar const goal = scalar(0.9) * std::min(s.residual_norm, s.reduced_gradient_norm);
    s.status = s.descent.begin(qp_.get(), options_.descent, s, goal);
    end_descent(s);
  }

  void descend(state_type& s) const {
    s.status = s.descent.step(qp_.get(), options_.descent, s);
    end_descent(s);
  }

  /// Back to Newton's method if the other one has done its work.
  void end_descent(state_type& s) const {
    s.last_step = symmetric_newton_step::descent;
    if (s.descent.at_work() || s.status != status::running) return;
    restart(s);
    s.forcing.record(s.residual_norm);
    s.progress = {};
  }

  /// ρ per unit of the gradient: z = y − ρ r.
  static scalar ρ(state_type const& s) { return s.step_length * s.unit; }

  void note_progress(state_type& s) const {
    if (s.status != status::running || s.descent.at_work()) return;
    auto const no_energy = [] {
      return std::pair(std::numeric_limits<scalar>::infinity(), scalar(0));
    };
    if (s.progress.stalled(s.iteration, s.residual_norm, options_.patience, no_energy)) {
      s.status = status::stalled;
    }
  }

  /// ρ, and s = mean(diag M). Not inlined: g++ 12 would see *step_length read where there is none.
  [[gnu::noinline]] void set_sizes(state_type& s) const {
    if (options_.step_length) {
      s.step_length = *options_.step_length;
    } else {
      auto const step = mean_step(qp_.get().a(), s.x, options_.step_factor, options_.mean_diagonal);
      s.step_length = step.length;
      s.work.setup_applications += step.applications;
    }
    // What knows the inverse on each face is not weighed against the curvature of its boundary.
    if constexpr (!preconditioned ||
                  preconditions_faces<preconditioner, vector_type, curved_face<scalar>>) {
      s.preconditioner_size = s.step_length / options_.step_factor;
    } else {
      s.preconditioner_size = mean_diagonal(m_.get(), s.x, options_.mean_diagonal).value;
    }
  }

  held<QP> qp_;
  held<M> m_;
  options options_;
};

}  // namespace slant
