// SPDX-License-Identifier: MIT
//
// SMALSE-M, semimonotonic augmented Lagrangians for separable and equality constraints [K §3.1.2;
// K refs 9, 13]: Dostál, Kučera, SIAM J. Optim. 20 (2010), for
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m,   G x = e
//
//     L(x, ν, ρ) = ½ xᵀP A P x − (P (b − A x̄))ᵀx + νᵀ(Q x − x̄) + ½ ρ ‖Q x − x̄‖²,   ν = Gᵀμ
//
//     (1°) x ∈ Λ with ‖r̃(x)‖ ≤ min(M ‖Q x − x̄‖, η), r̃ the reduced gradient of L(·, ν, ρ)
//     (2°) ν ← ν + ρ (Q x − x̄)
//     (3°) if L(xᵏ, νᵏ, ρ) < L(xᵏ⁻¹, νᵏ⁻¹, ρ) + ½ ρ ‖Q xᵏ − x̄‖²:   M ← β M
//
// Instead of the penalty ρ, which would spoil the spectrum of the inner problems, M is adapted; it
// falls below a bound that depends on the spectrum alone only finitely often, after which L grows
// by ½ ρ ‖Q x − x̄‖² a step. So the number of outer steps is bounded by the spectrum of P A P on
// ker G and by the accuracy ε, but as O(ε⁻²) only. What is measured is a factor a step, the cosine
// squared of the smallest angle between { G x = e } and the face of the solution: hundreds of steps
// where they nearly touch (bodies that contact alone holds, and which lose some of it). There
// constrained_newton is the method to use; it falls back on this one.
//
// Rows of G need not be orthonormal: they enter by the projectors Q onto range Gᵀ and P = I − Q
// only, see methods/augmented_problem.hpp, and ‖Q x − x̄‖, the distance of x from { G x = e },
// stands for ‖G x − e‖.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/spectral_bound.hpp>
#include <slant/methods/smalse_core.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/methods/smalse_problem.hpp>
#include <slant/methods/smalse_state.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// The method at the top of this file: solve(smalse{qp, constraints}, x0, energy_error_below(1e-8,
/// constrained_energy_certificate{qp, constraints}) || at_most(100)), or by residuals,
/// reduced_gradient_below(1e-8) && feasibility_below(1e-8); options last. Requires of the problem
/// what kprgp does; constraints are equality_constraints{G, e}. Spends one application of A an
/// outer step besides those of KPRGP, and at the start those for the bound of σ_max(P A P).
/// Statuses of its own: converged, stalled (see state.infeasible), unbounded, breakdown.
template <class QP, class C>
  requires smalse_problem<std::remove_cvref_t<QP>, std::remove_cvref_t<C>>
class smalse<QP, C> : private detail::smalse_core<QP, C> {
  using core = detail::smalse_core<QP, C>;
  using typename core::inner_qp;

 public:
  using typename core::options;
  using typename core::scalar;
  using typename core::state_type;
  using typename core::vector_type;

  smalse(held<QP> qp, held<C> c) : smalse(std::move(qp), std::move(c), options{}) {}
  /// Throws bad_input if the constraints are for another number of unknowns, or for options out of
  /// range.
  smalse(held<QP> qp, held<C> c, options o) : core(std::move(qp), std::move(c), std::move(o)) {}

  /// The state of P_Λ(x0) with ν = 0 or, if ‖r̃‖ is less, ν = −Q (b − A x̄). Throws bad_input if x0
  /// or A x0 is not finite or of the wrong size, or as the bound of σ_max and the inner method do.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    auto const& c = constraints_.get();
    detail::check_size("x0", index(slant::local(x0).size()), qp.size(), "the size of b,");
    detail::check_finite("x0", x0);

    spectral_bound<scalar> bound{scalar(0), scalar(0), scalar(0), 0};
    if (!detail::is_one_point(c)) {
      bound = largest_eigenvalue_bound(projected_hessian(qp.a(), c), x0, options_.spectrum);
    }
    scalar const whole = detail::size_on_ones(qp.a(), x0);
    // P A P may consist of rounding errors of A; any penalty will do then.
    bool const told = bound.ritz > scalar(32) * std::numeric_limits<scalar>::epsilon() * whole;
    scalar const ρ = options_.penalty * (told ? bound.ritz : whole > scalar(0) ? whole : scalar(1));
    scalar const σ = std::max(bound.upper, ρ);  // of P A P + ρ Q: both act on spaces of their own

    auto const load = detail::projected_load(qp, c);
    vector_type b = load.projected;
    vectors::axpy(ρ, c.nearest(), b);

    auto const inner_problem = augmented(b, ρ);
    auto inner = inner_method(inner_problem, σ).start(x0);
    inner.σ = std::max<scalar>(bound.ritz, ρ);  // known: what counts as a direction of the kernel
    vector_type ν = like(x0, qp.size());
    vectors::set_zero(ν);
    state_type s{x0, ν, load.projected, b, ν, std::move(inner), workspace(c.range_projector(), x0)};
    s.σ = σ;
    s.ρ = ρ;
    s.M = options_.balance * ρ;
    s.load = norm(load.projected);
    s.work = s.inner.work;
    s.work.setup_applications += bound.applications + 2;
    look(s);
    choose_multiplier(s, x0, load.opposed);
    s.η = options_.precision * std::max(s.load, s.gradient_scale);
    return s;
  }

  /// Goes on from P_Λ(x) with another multiplier ν ∈ range Gᵀ. One application; no allocation.
  void resume(state_type& s, vector_type const& x, vector_type const& ν) const {
    s.status = status::running;
    s.progress = {};
    s.M = options_.balance * s.ρ;
    slant::project(qp_.get().set(), slant::local(x), slant::local(s.inner.x));
    vectors::copy(ν, s.ν);
    form_linear_term(s);
    if (s.status != status::running) return;
    restart(s);
    look(s);
  }

  /// One inner problem and the update of ν.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    form_linear_term(s);
    if (s.status != status::running) return;
    auto const inner_problem = augmented(s.b, s.ρ);
    minimise(s, inner_method(inner_problem, s.σ));
    adapt_precision(s, inner_problem);
    vectors::axpy(s.ρ, s.offset, s.ν);
    ++s.iteration;
    look(s);
    note_progress(s);
  }

  /// r̃ from x, if the inner method has been updating it; whether it has. One application.
  bool refresh(state_type& s) const {
    auto const inner_problem = augmented(s.b, s.ρ);
    if (!inner_method(inner_problem, s.σ).refresh(s.inner)) return false;
    ++s.work.operator_applications;
    s.status = status::running;
    look(s);
    return true;
  }

  /// μ of G x = e, as many as G has rows: the gradient A x − b + Gᵀμ, reduced, vanishes at the
  /// solution. One application of A.
  [[nodiscard]] auto multipliers(state_type const& s) const {
    return detail::equality_multipliers(qp_.get(), constraints_.get(), s.x, s.offset, s.ν);
  }

 private:
  using core::augmented, core::constraints_, core::form_linear_term, core::inner_method, core::look,
      core::measure_offset, core::note_progress, core::options_, core::qp_, core::restart;

  /// 0 or another ν, whichever leaves less of r̃: the load of a bound that is far away (a large gap)
  /// is best left where the bound absorbs it, and P would spread it.
  void choose_multiplier(state_type& s, vector_type const& x0, vector_type const& other) const {
    if (s.status != status::running) return;
    index const spent = s.work.operator_applications;
    scalar const with_none = s.reduced_gradient_norm;
    vector_type const none = s.ν;
    resume(s, x0, other);
    if (!(s.reduced_gradient_norm < with_none)) resume(s, x0, none);
    s.work.setup_applications += s.work.operator_applications - spent;
    s.work.operator_applications = spent;
  }

  /// (1°). The inner method may end by itself: at the solution, or where it gets no further.
  template <class Method>
  void minimise(state_type& s, Method const& method) const {
    auto& inner = s.inner;
    work const before = inner.work;
    index const steps_before = inner.iteration;
    if (!s.resumed) method.resume(inner);
    s.comparable = !s.resumed;
    s.resumed = false;
    scalar const at_start = inner.reduced_gradient_norm;
    while (inner.status == status::running &&
           inner.iteration - steps_before < options_.inner_steps) {
      measure_offset(s, inner.x);
      if (inner.reduced_gradient_norm <= wanted(s, at_start)) break;
      method.step(inner);
    }
    measure_offset(s, inner.x);
    s.inner_iterations = inner.iteration - steps_before;
    s.work.inner_iterations += s.inner_iterations;
    s.work.operator_applications += inner.work.operator_applications - before.operator_applications;
    s.work.setup_applications += inner.work.setup_applications - before.setup_applications;
  }

  /// min(M ‖Q x − x̄‖, η), but nothing that is lost in rounding errors (unless those are larger than
  /// the whole gradient: then x is on its way to infinity). Where G x = e holds by itself, a part
  /// of ‖r̃‖ takes the place of M ‖Q x − x̄‖.
  [[nodiscard]] scalar wanted(state_type const& s, scalar const& at_start) const {
    scalar const balanced = s.M * s.feasibility_norm, noise = s.inner.rounding();
    scalar const least = scalar(64) * std::numeric_limits<scalar>::epsilon() * s.σ *
                         (norm(s.inner.x) + norm(constraints_.get().nearest()));
    scalar const most =
        std::min<scalar>(s.η, balanced > least ? balanced : options_.shrink * at_start);
    return noise < s.η ? std::max(most, noise) : most;
  }

  /// (3°), as far as it can be told from rounding errors.
  void adapt_precision(state_type& s, inner_qp const& qp) const {
    auto const [q, noise] = s.inner.energy(qp);
    auto const& x_e = constraints_.get().nearest();
    // L − q: the constant terms −νᵀx̄ + ½ ρ ‖x̄‖². Scaled before they are squared.
    scalar const unit = s.inner.unit, size = norm(x_e);
    vectors::scale(scalar(1) / unit, s.ν, s.inner.trial);
    scalar const constant =
        s.ρ * size * (size / unit) / scalar(2) - inner_product(s.inner.trial, x_e);
    scalar const now = q + constant;
    scalar const growth =
        s.ρ * s.feasibility_norm * (s.feasibility_norm / s.inner.unit) / scalar(2);
    if (s.comparable && now < s.lagrangian + growth - noise) s.M *= options_.shrink;
    s.lagrangian = now;
  }
};

}  // namespace slant
