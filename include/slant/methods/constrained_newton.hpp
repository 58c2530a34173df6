// SPDX-License-Identifier: MIT
//
// Symmetric semismooth Newton method for minimiser and multiplier together, for
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m,   G x = e
//
// It is Newton's method for y = P_Λ(z), Q y = x̄ with z = y − α (P A P y − P (b − A x̄) + ν),
// ν = Gᵀμ, and P, Q, x̄ those of equality_constraints. With x = P_Λ(z), the gradient r there, Π and
// C of the face at z (sets/curved_face.hpp) and N the independent rows of G a step is
//
//     [ Π P A P Π + C/α   Π Nᵀ ] [ t  ]   [ −Π r          ]
//     [ N Π                    ] [ dm ] = [ −N (Q x − x̄)  ]      t ∈ range(Π),  dν = Nᵀdm.
//
//     coarse      t₀ = −Π Nᵀ(N Π Nᵀ)⁻¹N (Q x − x̄)         the second row; methods/cut_face.hpp
//     solve       t − t₀ ∈ range(Π) ∩ ker N                preconditioned conjugate gradients
//     multiplier  dm from what is left of the first row
//     shorten     β = 1, ½, … until θ(y + β dy, ν + β dν) ≤ (1 − c β) θ,   θ² = ‖F‖² + ‖Q y − x̄‖²,
//                 F = y − P_Λ(z): y, z and Q y are linear along the step, no product by A
//     accept      others see x ∈ Λ with a gradient computed from x
//
// All equations are in every Newton system, and N Π Nᵀ is the coarse problem of the face: so it
// does not matter which of the bodies of Total-FETI contact holds. A preconditioner M ≈ A⁻¹ is
// applied in the cut face, as P W M W P with P onto range(Π) ∩ ker N (methods/curved_minimum.hpp).
//
// Where N Π Nᵀ is singular or no β is accepted, SMALSE-M takes over from x and ν until θ(x, ν) is a
// tenth below its value at the failure. It converges from everywhere, so this takes finitely many
// steps, and from failure to failure θ falls by a factor.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/methods/constrained_newton_core.hpp>
#include <slant/methods/constrained_newton_problem.hpp>
#include <slant/methods/constrained_newton_state.hpp>
#include <slant/methods/smalse.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// The method at the top of this file: solve(constrained_newton{qp, constraints}, x0,
/// energy_error_below(1e-8, constrained_energy_certificate{qp, constraints}) || at_most(100)), or
/// by residuals, reduced_gradient_below(1e-8) && feasibility_below(1e-8); a preconditioner M ≈ A⁻¹
/// third, options last. Requires of the problem what symmetric_newton does, for Eigen vectors;
/// constraints are equality_constraints{G, e}. Spends two products by A a step besides those of
/// conjugate gradients, one where x is in the affine space. Statuses of its own: converged, stalled
/// (see state.infeasible), unbounded, breakdown.
template <class QP, class C, class M>
  requires constrained_newton_problem<std::remove_cvref_t<QP>, std::remove_cvref_t<C>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class constrained_newton<QP, C, M> : detail::constrained_newton_core<QP, C, M> {
  using core = detail::constrained_newton_core<QP, C, M>;

 public:
  using core::preconditioned;
  using typename core::constraints;
  using typename core::options;
  using typename core::problem;
  using typename core::scalar;
  using typename core::state_type;
  using typename core::vector_type;

  constrained_newton(held<QP> qp, held<C> c)
    requires(!preconditioned)
      : constrained_newton(std::move(qp), std::move(c), options{}) {}
  /// Throws bad_input if sizes do not match, or for options out of range.
  constrained_newton(held<QP> qp, held<C> c, options o)
    requires(!preconditioned)
      : core(std::move(qp), std::move(c), std::move(o)) {}
  constrained_newton(held<QP> qp, held<C> c, held<M> m)
      : constrained_newton(std::move(qp), std::move(c), std::move(m), options{}) {}
  /// Throws bad_input if sizes do not match, or for options out of range.
  constrained_newton(held<QP> qp, held<C> c, held<M> m, options o)
      : core(std::move(qp), std::move(c), std::move(m), std::move(o)) {}

  /// The state of P_Λ(x0) with ν = 0 or, if ‖r̃‖ is less, ν = −Q (b − A x̄). Throws bad_input if x0
  /// or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_size("x0", x0.size(), qp.size(), "the size of b,");
    detail::check_finite("x0", x0);
    auto const load = detail::projected_load(qp, constraints_.get());
    state_type s(projected(load.projected), constraints_.get(), m_.get(), x0, load.projected);
    s.load = norm(load.projected);
    ++s.work.setup_applications;
    this->set_sizes(s);
    slant::project(qp.set(), x0, s.x);
    s.gradient(projected(s.b));
    detail::check_finite("A x0 - b", s.r);
    s.unit = unit_near(std::max<scalar>(s.load, norm(s.r)));
    s.size_of_b = s.load / s.unit;
    s.r *= scalar(1) / s.unit;
    this->look(s);
    this->choose_multiplier(s, load.opposed);
    restart(s);
    s.forcing = forcing_history<scalar>::starting_at(s.merit);
    return s;
  }

  /// One Newton step, or one outer step of SMALSE-M where Newton's method has failed.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (s.fallback_at_work) {
      fall_back(s);
    } else {
      project(s);
      if (s.status == status::running) newton_step(s);
    }
    ++s.iteration;
    this->note_progress(s);
  }

  /// μ of G x = e, as many as G has rows: the gradient A x − b + Gᵀμ, reduced, vanishes at the
  /// solution. One application of A.
  [[nodiscard]] vector_type multipliers(state_type const& s) const {
    return detail::equality_multipliers(qp_.get(), constraints_.get(), s.x, s.offset, s.ν);
  }

 private:
  using core::constraints_;
  using core::m_;
  using core::measure;
  using core::merit_at_x;
  using core::offset_of;
  using core::options_;
  using core::projected;
  using core::qp_;
  using core::restart;

  [[nodiscard]] auto fallback() const {
    return smalse<problem const&, constraints const&>{qp_.get(), constraints_.get(),
                                                      options_.fallback};
  }

  /// x = P_Λ(z) with r and r̃; nothing to do if it is there.
  void project(state_type& s) const {
    if (s.at_projection) return;
    slant::project(qp_.get().set(), s.segment.z, s.x);
    s.at_projection = true;
    measure(s);
  }

  void newton_step(state_type& s) const {
    auto const a = projected_hessian(qp_.get().a(), constraints_.get());
    scalar const α = s.step_length, κ = s.preconditioner_size / α;
    if (!s.face.assign(qp_.get().set(), s.segment.z, κ)) return begin_fallback(s);
    this->lift(s, a);
    scalar const target = s.forcing.next(options_.forcing) * s.merit / s.unit;
    auto const inner = s.inner.minimise(a, s.a_workspace, m_.get(), s.gradient_at_end, s.face, α,
                                        s.preconditioner_size, target, options_.inner_steps);
    s.inner_iterations = inner.iterations;
    s.work.inner_iterations += inner.iterations;
    s.work.operator_applications += inner.iterations;
    if (!inner.finite) {
      s.status = status::breakdown;
      return;
    }
    s.gradient_at_end += s.inner.image;
    s.face.whole().add_curvature(scalar(1) / α, s.inner.t, s.gradient_at_end);
    s.face.balance(s.gradient_at_end, s.dν);
    s.dν = -s.dν;
    s.inner.image += s.trial + s.dν;  // the gradient at the end of the step
    s.lifted += s.inner.t;
    s.segment.target_y = s.x + s.unit * s.lifted;
    s.segment.target_z = s.segment.target_y - (α * s.unit) * s.inner.image;
    offset_of(s, s.segment.target_y, s.target_offset);
    if (this->shorten(s)) {
      accept(s);
    } else {
      begin_fallback(s);
    }
  }

  void accept(state_type& s) const {
    scalar const& β = s.step_fraction;
    s.segment.advance(β);
    s.ν += (β * s.unit) * s.dν;
    s.x = s.projected;
    s.at_projection = true;
    measure(s);
    s.forcing.record(s.merit);
    s.last_step = β == scalar(1) ? constrained_newton_step::full : constrained_newton_step::damped;
  }

  /// SMALSE-M takes over, unless there are no digits left.
  void begin_fallback(state_type& s) const {
    if (s.merit <= s.rounding()) {
      s.status = status::stalled;
      return;
    }
    auto const method = fallback();
    if (!s.fallback) {
      try {
        s.fallback.emplace(method.start(s.x));
      } catch (bad_input const&) {  // A x0 was good, so what it finds is no matter of input
        s.status = status::breakdown;
        return;
      }
      s.work.setup_applications += s.fallback->work.setup_applications;
      s.work.operator_applications += s.fallback->work.operator_applications;
    }
    s.goal = scalar(0.9) * std::min<scalar>(s.merit, merit_at_x(s));
    method.resume(*s.fallback, s.x, s.ν);
    ++s.work.operator_applications;
    s.fallback_at_work = true;
    ++s.fallback_count;
    fall_back(s);
  }

  void fall_back(state_type& s) const {
    auto& other = *s.fallback;
    work const before = other.work;
    if (other.status == status::running) fallback().step(other);
    s.work.operator_applications += other.work.operator_applications - before.operator_applications;
    s.inner_iterations = other.inner_iterations;
    s.work.inner_iterations += other.inner_iterations;
    s.last_step = constrained_newton_step::fallback;
    s.x = other.x;
    s.ν = other.ν;
    measure(s);
    s.infeasible = other.infeasible;
    if (s.status == status::running) s.status = other.status;
    if (s.status == status::running && merit_at_x(s) > s.goal) return;
    s.fallback_at_work = false;
    restart(s);
    s.forcing.record(s.merit);
    s.progress = {};
  }
};

}  // namespace slant
