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

#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/symmetric_newton_core.hpp>
#include <slant/methods/symmetric_newton_problem.hpp>
#include <slant/methods/symmetric_newton_state.hpp>
#include <slant/operators/held.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// What `symmetric_newton` does with a problem that has all it needs.
template <class QP, class M>
class symmetric_newton_steps : public symmetric_newton_core<QP, M> {
  using core = symmetric_newton_core<QP, M>;

 public:
  using typename core::options;
  using typename core::preconditioner;
  using typename core::problem;
  using typename core::scalar;
  using typename core::state_type;
  using typename core::vector_type;

  explicit symmetric_newton_steps(held<QP> qp)
    requires(!core::preconditioned)
      : symmetric_newton_steps(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  symmetric_newton_steps(held<QP> qp, options o)
    requires(!core::preconditioned)
      : core(std::move(qp), std::move(o)) {}
  symmetric_newton_steps(held<QP> qp, held<M> m)
      : symmetric_newton_steps(std::move(qp), std::move(m), options{}) {}
  /// Throws bad_input if the size of M is not that of the problem, or for options out of range.
  symmetric_newton_steps(held<QP> qp, held<M> m, options o)
      : core(std::move(qp), std::move(m), std::move(o)) {}

  /// The state of P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if
  /// ρ is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const;

  /// One Newton step, or one step of KPRGP where Newton's method has failed.
  void step(state_type& s) const;

  /// Goes on from s.x after b of the problem has changed: r and r̃ anew, everything else (units,
  /// scales, ρ) as it is. One product; no allocation.
  void resume(state_type& s) const;

  /// As start(x0), in a state that start has made, after b or Λ of the problem have changed: what
  /// depends on A alone (ρ, mean(diag M), all memory) stays. Counts begin at zero. x0 must not be
  /// s.x. One product; no allocation.
  void resume(state_type& s, vector_type const& x0) const;

  /// r from x where KPRGP has been updating it, also in the point that it has handed back; whether
  /// it has. One product.
  bool refresh(state_type& s) const;

 private:
  using core::m_;
  using core::measure;
  using core::options_;
  using core::qp_;
  using core::restart;

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
    vectors::waxpy(s.unit, s.inner.t, s.x, s.segment.target_y);
    vectors::add(s.r, s.inner.image);
    vectors::waxpy(-core::ρ(s), s.inner.image, s.segment.target_y, s.segment.target_z);
    if (this->shorten(s)) {
      accept(s);
    } else if (s.products.at_work()) {
      s.products.give_up();  // the next step is computed anew
    } else {
      begin_descent(s);
    }
  }

  void accept(state_type& s) const {
    scalar const& β = s.step_fraction;
    s.segment.advance(β);
    std::swap(s.x, s.projected);
    measure(s);
    s.forcing.record(s.residual_norm);
    s.last_step = β == scalar(1) ? symmetric_newton_step::full : symmetric_newton_step::damped;
  }

  /// Newton's iterate and its forcing terms from x, r and r̃.
  void begin_newton(state_type& s, bool solved) const {
    restart(s);
    s.forcing = forcing_history<scalar>::starting_at(s.residual_norm);
    s.forcing.first_error = s.gradient_scale;
    if (solved || s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
  }

  /// Where no length is accepted: the other method takes over, unless there are no digits left.
  void begin_descent(state_type& s) const {
    if (s.residual_norm <= s.rounding()) {
      // F(y) is known by recurrences, which a start far away has robbed of their digits.
      if (s.reduced_gradient_norm <= s.rounding()) {
        s.status = status::stalled;
      } else {
        restart(s);
      }
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
    s.progress.begin_again(s.iteration);
  }

  /// KPRGP watches itself; but at the floor the two may take turns for ever.
  void note_progress(state_type& s) const {
    bool const other = s.descent.at_work();
    if (s.status != status::running || (other && !s.progress.at_floor())) return;
    scalar const size = other ? s.reduced_gradient_norm : s.residual_norm;
    if (s.progress.stalled(s.iteration, size, options_.patience, s.rounding())) {
      s.status = status::stalled;
    }
  }
};

template <class QP, class M>
auto symmetric_newton_steps<QP, M>::start(vector_type const& x0) const -> state_type {
  auto const& qp = qp_.get();
  detail::check_start_in_set(x0, qp_.get().b());
  state_type s(qp, m_.get(), x0);
  this->set_sizes(s);
  begin_newton(s, s.begin(qp, x0));
  return s;
}

template <class QP, class M>
void symmetric_newton_steps<QP, M>::step(state_type& s) const {
  if (s.status != status::running) return;
  if (s.descent.at_work()) {
    descend(s);
  } else {
    this->project(s);
    if (s.status == status::running) newton_step(s);
  }
  ++s.iteration;
  note_progress(s);
}

template <class QP, class M>
void symmetric_newton_steps<QP, M>::resume(state_type& s) const {
  s.status = status::running;
  s.progress = {};
  s.descent.leave();
  measure(s);
  begin_newton(s, false);
}

template <class QP, class M>
void symmetric_newton_steps<QP, M>::resume(state_type& s, vector_type const& x0) const {
  detail::check_start_in_set(x0, qp_.get().b());
  s.progress = {};
  s.descent.leave();
  s.last_step = symmetric_newton_step::none;
  s.iteration = s.inner_iterations = 0;
  s.status = status::running;
  begin_newton(s, s.begin_again(qp_.get(), x0));
}

template <class QP, class M>
bool symmetric_newton_steps<QP, M>::refresh(state_type& s) const {
  if (s.descent.at_work()) return s.descent.refresh(qp_.get(), options_.descent, s);
  if (s.since_refresh == 0) return false;
  s.status = status::running;
  measure(s);
  restart(s);
  return true;
}

}  // namespace detail

/// The method at the top of this file: solve(symmetric_newton{qp}, x0, reduced_gradient_below(1e-8)
/// || at_most(100)); symmetric_newton{qp, M} with a preconditioner M ≈ A⁻¹, options last. Requires
/// of the problem what kprgp does, and blocks with slant(x); of M psd_operator. Begins at P_Λ(x0).
/// Statuses of its own: converged (r̃ = 0); stalled (the precision is exhausted); unbounded (only if
/// A is not declared definite); breakdown.
template <class QP, class M>
  requires symmetric_newton_problem<std::remove_cvref_t<QP>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class symmetric_newton<QP, M> : public detail::symmetric_newton_steps<QP, M> {
 public:
  using symmetric_newton::symmetric_newton_steps::symmetric_newton_steps;
};

#if SLANT_USES_COMPILED
extern template struct symmetric_newton_state<any_qp<double, definite_laws>, identity_operator>;
extern template struct symmetric_newton_state<any_qp<double, semidefinite_laws>, identity_operator>;
extern template class detail::symmetric_newton_steps<any_qp<double, definite_laws>,
                                                     identity_operator>;
extern template class detail::symmetric_newton_steps<any_qp<double, semidefinite_laws>,
                                                     identity_operator>;
extern template class detail::symmetric_newton_steps<
    any_qp<double, definite_laws>, any_operator<Eigen::VectorXd, semidefinite_laws>>;
extern template class detail::symmetric_newton_steps<
    any_qp<double, semidefinite_laws>, any_operator<Eigen::VectorXd, semidefinite_laws>>;
#endif

}  // namespace slant
