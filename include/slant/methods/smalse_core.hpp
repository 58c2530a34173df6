// SPDX-License-Identifier: MIT
//
// What smalse needs besides its steps (1°) to (3°): the inner problems, what rules look at, the
// judgement of progress, and the Newton step for x and ν.
#pragma once

#include <slant/methods/multiplier_newton.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/methods/smalse_state.hpp>
#include <slant/operators/held.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Problem, constraints and options of smalse; symbols as in smalse.hpp.
template <class QP, class C, class Inner>
class smalse_core {
 public:
  using problem = std::remove_cvref_t<QP>;
  using constraints = std::remove_cvref_t<C>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = smalse_options<scalar, Inner>;
  using state_type = smalse_state<problem, constraints, Inner>;

  smalse_core(held<QP> qp, held<C> c, options o)
      : qp_(std::move(qp)), constraints_(std::move(c)), options_(std::move(o)) {
    check_size("columns of G", index(constraints_.get().size()), qp_.get().size(),
               "the size of b,");
    options_.validate();
  }

 protected:
  using inner_qp = augmented_qp<problem, constraints>;
  static constexpr bool knows_rows = requires(constraints const& c) { c.unit_rows(); };

  /// min L(·, ν, ρ) over Λ; refers to b.
  [[nodiscard]] inner_qp augmented(vector_type const& b, scalar const& ρ) const {
    return {augmented_hessian(qp_.get().a(), constraints_.get(), ρ), b, qp_.get().set()};
  }
  [[nodiscard]] auto inner_method(inner_qp const& qp, scalar const& ρ, scalar const& σ) const {
    return options_.inner.make(qp, constraints_.get(), ρ, σ);
  }

  void form_linear_term(state_type& s) const {
    slant::local(s.b) = slant::local(s.projected_b) - slant::local(s.ν) +
                        s.ρ * slant::local(constraints_.get().nearest());
    if (!is_finite(norm(s.b))) s.status = status::breakdown;
  }

  /// A Newton step for x and ν, taken back unless it lowers the error by a third; then it is tried
  /// less often.
  void improve(state_type& s) const {
    if (s.wait-- > 0) return;
    scalar const before = relative_error(s);
    vector_type const x = s.inner.x, ν = s.ν, b = s.b;
    if (!newton_step(s)) return;
    form_linear_term(s);
    restart(s);
    look(s);
    if (relative_error(s) <= before * scalar(2) / scalar(3)) {
      s.resumed = true;
      s.pause = 0;
      return;
    }
    s.wait = s.pause = std::min<index>(2 * s.pause + 1, 7);
    s.status = status::running;
    s.inner.x = x;
    s.ν = ν;
    s.b = b;
    restart(s);
    look(s);
  }

  [[nodiscard]] bool newton_step(state_type& s) const {
    auto const& c = constraints_.get();
    multiplier_newton<scalar> newton;
    scalar const α = scalar(1) / s.σ;
    vector_type const r = s.inner.unit * s.inner.r;
    auto const a = projected_hessian(qp_.get().a(), c);
    auto w = workspace(a, r);
    if (!newton.assign(c.unit_rows(), qp_.get().set(), vector_type(s.inner.x - α * r)))
      return false;
    bool const done = newton.solve(a, w, c.unit_rows(), r, s.offset, α, scalar(0.1), 200);
    s.work.operator_applications += newton.iterations;
    s.work.inner_iterations += newton.iterations;
    if (!done) return false;
    slant::project(qp_.get().set(), vector_type(s.inner.x + newton.t), s.inner.x);
    s.ν += newton.dν;
    return true;
  }

  /// The inner method at s.inner.x with the linear term s.b.
  void restart(state_type& s) const {
    auto const inner_problem = augmented(s.b, s.ρ);
    inner_method(inner_problem, s.ρ, s.σ).resume(s.inner);
    ++s.work.operator_applications;
  }

  void measure_offset(state_type& s, vector_type const& x) const {
    slant::apply(constraints_.get().range_projector(), x, s.offset, s.q_workspace);
    slant::local(s.offset) -= slant::local(constraints_.get().nearest());
    s.feasibility_norm = norm(s.offset);
  }

  /// What rules look at.
  void look(state_type& s) const {
    slant::local(s.x) = slant::local(s.inner.x);
    measure_offset(s, s.x);
    s.feasibility_scale = std::max<scalar>(norm(constraints_.get().nearest()), norm(s.x));
    s.reduced_gradient_norm = s.inner.reduced_gradient_norm;
    bool const solved = s.reduced_gradient_norm == scalar(0) && s.feasibility_norm == scalar(0);
    if (solved) s.status = status::converged;
    if (s.inner.status == status::unbounded || s.inner.status == status::breakdown) {
      s.status = s.inner.status;
    }
    if (!is_finite(s.feasibility_norm)) s.status = status::breakdown;
  }

  static scalar relative(scalar const& size, scalar const& scale) {
    return scale > scalar(0) ? scalar(size / scale) : size;
  }
  static scalar relative_error(state_type const& s) {
    return std::max(relative(s.reduced_gradient_norm, s.gradient_scale),
                    relative(s.feasibility_norm, s.feasibility_scale));
  }

  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    scalar const distance = relative(s.feasibility_norm, s.feasibility_scale);
    scalar const error = relative_error(s);
    if (!s.progress.stalled(s.iteration, error, distance, options_.patience)) return;
    s.status = status::stalled;
    s.infeasible = !s.progress.is_near(distance) && is_next_to_space(s);
  }

  /// Does no step towards the affine space lead far? x is then next to the point y of Λ that is
  /// nearest to it, and if that is at a distance, (z − y)ᵀ(Q y − x̄) ≥ 0 for all z ∈ Λ.
  [[nodiscard]] bool is_next_to_space(state_type& s) const {
    vector_type &trial = s.inner.trial, &projected = s.inner.projected;
    slant::local(trial) = slant::local(s.x) - slant::local(s.offset);
    slant::project(qp_.get().set(), slant::local(trial), slant::local(projected));
    slant::local(trial) = slant::local(s.x) - slant::local(projected);
    return norm(trial) <= s.feasibility_norm / scalar(2);
  }

  held<QP> qp_;
  held<C> constraints_;
  options options_;
};

}  // namespace slant::detail
