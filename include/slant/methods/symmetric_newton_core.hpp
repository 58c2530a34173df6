// SPDX-License-Identifier: MIT
//
// What the steps of symmetric_newton are made of: the sizes taken from A and M, what is measured of
// an iterate, and the search for a length. Symbols as in symmetric_newton.hpp.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/mean_diagonal.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/methods/symmetric_newton_options.hpp>
#include <slant/methods/symmetric_newton_state.hpp>
#include <slant/operators/held.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/curved_face.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

/// Problem, preconditioner and options of symmetric_newton, with its smaller steps.
template <class QP, class M>
class symmetric_newton_core {
 public:
  using problem = std::remove_cvref_t<QP>;
  using preconditioner = std::remove_cvref_t<M>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = symmetric_newton_options<scalar>;
  using state_type = symmetric_newton_state<problem, preconditioner>;
  static constexpr bool preconditioned = !std::is_same_v<preconditioner, identity_operator>;

  symmetric_newton_core(held<QP> qp, options o)
      : qp_(std::move(qp)), m_(identity_operator(qp_.get().size())), options_(std::move(o)) {
    options_.validate();
  }
  symmetric_newton_core(held<QP> qp, held<M> m, options o)
      : qp_(std::move(qp)), m_(std::move(m)), options_(std::move(o)) {
    check_size("rows of the preconditioner", index(m_.get().rows()), qp_.get().size());
    check_size("columns of the preconditioner", index(m_.get().cols()), qp_.get().size());
    options_.validate();
  }

 protected:
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

  /// r and r̃ of x; one product.
  void measure(state_type& s) const {
    static_cast<void>(s.gradient_and_unit(qp_.get()));
    s.reduce(qp_.get());
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
    if (!is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
  }

  /// x = P_Λ(z) with r and r̃; nothing to do if it is there.
  void project(state_type& s) const {
    if (s.at_projection) return;
    std::swap(s.x, s.projected);
    s.at_projection = true;
    measure(s);
  }

  /// y = x, with its z and ‖F(y)‖.
  void restart(state_type& s) const {
    vectors::copy(s.x, s.segment.y);
    vectors::waxpy(-ρ(s), s.r, s.x, s.segment.z);
    s.residual_norm = s.reduced_gradient_norm;
    s.at_projection = false;
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

  /// ρ per unit of the gradient: z = y − ρ r.
  static scalar ρ(state_type const& s) { return s.step_length * s.unit; }

  held<QP> qp_;
  held<M> m_;
  options options_;
};

}  // namespace slant::detail
