// SPDX-License-Identifier: MIT
//
// What the steps of constrained_newton are made of: the sizes taken from the data, the multiplier
// it begins with, what is looked at in an iterate, and the line search. Symbols as in
// constrained_newton.hpp.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/constrained_newton_options.hpp>
#include <slant/methods/constrained_newton_problem.hpp>
#include <slant/methods/constrained_newton_state.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Problem, constraints, preconditioner and options, with what is measured of an iterate.
template <class QP, class C, class M>
class constrained_newton_core {
 public:
  using problem = std::remove_cvref_t<QP>;
  using constraints = std::remove_cvref_t<C>;
  using preconditioner = std::remove_cvref_t<M>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = constrained_newton_options<scalar>;
  using state_type = constrained_newton_state<problem, constraints, preconditioner>;
  static constexpr bool preconditioned = !std::is_same_v<preconditioner, identity_operator>;

  constrained_newton_core(held<QP> qp, held<C> c, options o)
      : qp_(std::move(qp)),
        constraints_(std::move(c)),
        m_(identity_operator(qp_.get().size())),
        options_(std::move(o)) {
    check();
  }
  constrained_newton_core(held<QP> qp, held<C> c, held<M> m, options o)
      : qp_(std::move(qp)), constraints_(std::move(c)), m_(std::move(m)), options_(std::move(o)) {
    check();
  }

 protected:
  using projected_qp = detail::projected_qp<problem, constraints>;

  [[nodiscard]] projected_qp projected(vector_type const& b) const {
    return {projected_hessian(qp_.get().a(), constraints_.get()), b, qp_.get().set()};
  }
  /// 0 or another ν, whichever leaves less of r̃; see smalse.
  void choose_multiplier(state_type& s, vector_type const& other) const {
    if (s.status != status::running) return;
    index const spent = s.work.operator_applications;
    scalar const with_none = s.reduced_gradient_norm;
    s.ν = other;
    measure(s);
    if (!(s.reduced_gradient_norm < with_none)) {
      s.status = status::running;
      s.ν.setZero();
      measure(s);
    }
    s.work.setup_applications += s.work.operator_applications - spent;
    s.work.operator_applications = spent;
  }

  /// r, r̃ and Q x − x̄ of x; one product.
  void measure(state_type& s) const {
    s.b = s.projected_b - s.ν;
    if (!detail::is_finite(norm(s.b))) {
      s.status = status::breakdown;
      return;
    }
    s.gradient(projected(s.b));
    look(s);
  }

  /// What rules look at, for x and its r.
  void look(state_type& s) const {
    s.reduce(projected(s.b));
    offset_of(s, s.x, s.offset);
    s.feasibility_norm = norm(s.offset);
    s.feasibility_scale = std::max<scalar>(norm(constraints_.get().nearest()), norm(s.x));
    s.gradient_scale =
        detail::gradient_scale(s.load, scalar(1) / s.step_length, s.feasibility_scale);
    if (s.reduced_gradient_norm == scalar(0) && s.feasibility_norm == scalar(0)) {
      s.status = status::converged;
    }
    if (!detail::is_finite(s.reduced_gradient_norm) || !detail::is_finite(s.feasibility_norm)) {
      s.status = status::breakdown;
    }
  }

  void offset_of(state_type& s, vector_type const& x, vector_type& offset) const {
    slant::apply(constraints_.get().range_projector(), x, offset, s.q_workspace);
    offset -= constraints_.get().nearest();
  }

  [[nodiscard]] static scalar merit_of(state_type const& s, scalar const& of_x,
                                       scalar const& of_space) {
    using std::hypot;
    return hypot(of_x, of_space) / s.step_length;
  }

  /// y = x and θ there.
  void restart(state_type& s) const {
    s.segment.y = s.x;
    s.segment.z = s.x - (s.step_length * s.unit) * s.r;
    s.offset_y = s.offset;
    s.merit = merit_at_x(s);
    s.at_projection = false;
  }
  [[nodiscard]] static scalar merit_at_x(state_type const& s) {
    return merit_of(s, s.step_length * s.reduced_gradient_norm, s.feasibility_norm);
  }

  /// t₀ in units, trial = r + P A P t₀ and gradient_at_end = the same with the curvature.
  template <class A>
  void lift(state_type& s, A const& a) const {
    s.trial = s.r;
    s.lifted.setZero();
    scalar const noise = scalar(4) * std::numeric_limits<scalar>::epsilon() * s.feasibility_scale;
    if (s.feasibility_norm > noise) {
      s.face.lift(s.offset, s.lifted);
      s.lifted *= scalar(-1) / s.unit;
      slant::apply(a, s.lifted, s.trial, s.a_workspace);
      ++s.work.operator_applications;
      s.trial += s.r;
    }
    s.gradient_at_end = s.trial;
    s.face.whole().add_curvature(scalar(1) / s.step_length, s.lifted, s.gradient_at_end);
  }

  /// The longest β = 2⁻ʲ that lowers θ enough; false if there is none. Spends no product.
  bool shorten(state_type& s) const {
    scalar β(1);
    for (index j = 0; j <= options_.halvings; ++j, β /= scalar(2)) {
      // residual_at needs two vectors: the gradient of the model is not needed any more.
      scalar const of_x = s.segment.residual_at(qp_.get().set(), β, s.projected, s.gradient_at_end);
      s.gradient_at_end = (scalar(1) - β) * s.offset_y + β * s.target_offset;
      scalar const merit = merit_of(s, of_x, norm(s.gradient_at_end));
      scalar const enough = (scalar(1) - options_.sufficient * β) * s.merit;
      if (!(enough < s.merit)) return false;  // β is below the precision
      if (merit <= enough) {
        s.step_fraction = β;
        s.merit = merit;
        s.offset_y = s.gradient_at_end;
        return true;
      }
    }
    return false;
  }

  void note_progress(state_type& s) const {
    if (s.status != status::running || s.fallback_at_work) return;
    if (s.progress.stalled(s.iteration, s.merit, options_.patience)) {
      s.status = status::stalled;
    }
  }

  /// α, and s = mean(diag M).
  void set_sizes(state_type& s) const {
    auto const& qp = qp_.get();
    scalar const whole = detail::size_on_ones(qp.a(), s.x);
    scalar mean(0);
    ++s.work.setup_applications;
    if (!detail::is_one_point(constraints_.get())) {
      auto const of_a = slant::mean_diagonal(projected_hessian(qp.a(), constraints_.get()), s.x,
                                             options_.mean_diagonal);
      mean = of_a.value;
      s.work.setup_applications += of_a.applications;
    }
    // P A P may consist of rounding errors of A; any α will do then.
    if (!(mean > scalar(32) * std::numeric_limits<scalar>::epsilon() * whole)) mean = whole;
    scalar const size = mean > scalar(0) ? scalar(scalar(1) / mean) : scalar(1);
    s.step_length = options_.step_factor * size;
    s.preconditioner_size = size;
    if constexpr (preconditioned) {
      s.preconditioner_size = slant::mean_diagonal(m_.get(), s.x, options_.mean_diagonal).value;
    }
  }

  held<QP> qp_;
  held<C> constraints_;
  held<M> m_;
  options options_;

 private:
  void check() const {
    index const n = qp_.get().size();
    detail::check_size("columns of G", index(constraints_.get().size()), n, "the size of b,");
    detail::check_size("rows of the preconditioner", index(m_.get().rows()), n);
    detail::check_size("columns of the preconditioner", index(m_.get().cols()), n);
    options_.validate();
  }
};

}  // namespace slant::detail
