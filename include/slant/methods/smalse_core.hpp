// SPDX-License-Identifier: MIT
//
// What smalse needs besides its steps (1°) to (3°): the inner problems, what rules look at, and the
// judgement of progress.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/detail/separation.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/methods/smalse_state.hpp>
#include <slant/operators/held.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Problem, constraints and options of smalse; symbols as in smalse.hpp.
template <class QP, class C>
class smalse_core {
 public:
  using problem = std::remove_cvref_t<QP>;
  using constraints = std::remove_cvref_t<C>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = smalse_options<scalar>;
  using state_type = smalse_state<problem, constraints>;

  smalse_core(held<QP> qp, held<C> c, options o)
      : qp_(std::move(qp)), constraints_(std::move(c)), options_(std::move(o)) {
    check_size("columns of G", index(constraints_.get().size()), qp_.get().size(),
               "the size of b,");
    options_.validate();
  }

 protected:
  using inner_qp = augmented_qp<problem, constraints>;

  /// min L(·, ν, ρ) over Λ; refers to b.
  [[nodiscard]] inner_qp augmented(vector_type const& b, scalar const& ρ) const {
    return {augmented_hessian(qp_.get().a(), constraints_.get(), ρ), b, qp_.get().set()};
  }
  [[nodiscard]] auto inner_method(inner_qp const& qp, scalar const& σ) const {
    auto own = options_.inner;
    if (!own.step_length) own.step_length = own.step_factor / σ;
    return kprgp<inner_qp const&>{qp, own};
  }

  void form_linear_term(state_type& s) const {
    vectors::difference(s.projected_b, s.ν, s.b);
    vectors::axpy(s.ρ, constraints_.get().nearest(), s.b);
    if (!is_finite(norm(s.b))) s.status = status::breakdown;
  }

  /// The inner method at s.inner.x with the linear term s.b.
  void restart(state_type& s) const {
    auto const inner_problem = augmented(s.b, s.ρ);
    inner_method(inner_problem, s.σ).resume(s.inner);
    ++s.work.operator_applications;
    s.resumed = true;
  }

  void measure_offset(state_type& s, vector_type const& x) const {
    slant::apply(constraints_.get().range_projector(), x, s.offset, s.q_workspace);
    vectors::subtract(constraints_.get().nearest(), s.offset);
    s.feasibility_norm = norm(s.offset);
  }

  /// What rules look at.
  void look(state_type& s) const {
    vectors::copy(s.inner.x, s.x);
    measure_offset(s, s.x);
    s.feasibility_scale = std::max<scalar>(norm(constraints_.get().nearest()), norm(s.x));
    s.gradient_scale = gradient_scale(s.load, s.ρ, s.feasibility_scale);
    s.reduced_gradient_norm = s.inner.reduced_gradient_norm;
    bool const solved = s.reduced_gradient_norm == scalar(0) && s.feasibility_norm == scalar(0);
    if (solved) s.status = status::converged;
    if (s.inner.status == status::unbounded || s.inner.status == status::breakdown) {
      s.status = s.inner.status;
    }
    if (!is_finite(s.feasibility_norm)) s.status = status::breakdown;
  }

  /// In lengths, by a factor that does not change: x may be much larger on the way than at its end.
  [[nodiscard]] static scalar error(state_type const& s) {
    return std::max<scalar>(s.reduced_gradient_norm / s.ρ, s.feasibility_norm);
  }

  /// Infeasible constraints are recognised by a plane that separates them from Λ, and by nothing
  /// else: where the two meet at a small angle, progress is as slow as if they did not.
  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    if (!s.progress.stalled(s.iteration, error(s), options_.patience)) return;
    s.status = status::stalled;
    s.infeasible = is_apart(qp_.get().set(), constraints_.get(), s.x);
  }

  held<QP> qp_;
  held<C> constraints_;
  options options_;
};

}  // namespace slant::detail
