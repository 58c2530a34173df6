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
// only, see problems/augmented_problem.hpp, and ‖Q x − x̄‖, the distance of x from { G x = e },
// stands for ‖G x − e‖.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/problems/augmented_problem.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ, G x = e: a problem for kprgp, and an affine space.
template <class QP, class C>
concept smalse_problem = kprgp_problem<QP> && affine_space<C, typename QP::vector_type>;

/// Options of smalse.
template <class S = double>
struct smalse_options {
  /// ρ in multiples of σ_max(P A P); it does not grow. Measured with Total-FETI on bricks: 4 halves
  /// the outer steps and doubles the products of KPRGP.
  S penalty = S(1);

  [[gnu::cold]] void validate() const { detail::check_positive("penalty", penalty); }
};

namespace detail {

/// What the statuses of methods for problems with equality constraints mean. `infeasible`: no point
/// of Λ satisfies G x = e, which has been shown.
[[nodiscard, gnu::cold]] inline std::string reason_with_equalities(slant::status end,
                                                                   bool infeasible) {
  return reason_of(
      end,
      {.converged = "the reduced gradient and the residual of the equality constraints vanish",
       .stalled = infeasible ? "no point of the set satisfies the equality constraints"
                             : "the last outer steps have lowered neither the reduced gradient "
                               "nor the residual of the equality constraints: rounding, or a "
                               "small angle between the set and the equations"});
}

/// The inner problem: its operator is owned, its linear term and set are referenced.
template <class QP, class C>
using augmented_qp = separable_qp<decltype(slant::augmented_hessian(
                                      std::declval<typename QP::operator_type const&>(),
                                      std::declval<C const&>(), typename QP::scalar(1))),
                                  typename QP::vector_type const&, typename QP::set_type const&>;

}  // namespace detail

/// State of smalse for a separable_qp of type QP and constraints C.
template <class QP, class C>
struct smalse_state {
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;
  using inner_state = kprgp_state<detail::augmented_qp<QP, C>>;

  vector_type x;            ///< in Λ; close to the affine space
  vector_type ν;            ///< Gᵀμ, the multiplier of G x = e, a gradient
  vector_type projected_b;  ///< P (b − A x̄)
  vector_type b;            ///< linear term of the last inner problem
  vector_type offset;       ///< Q x − x̄
  inner_state inner;        ///< of the method for L(·, ν, ρ); its r, r̃ belong to b
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> q_workspace;

  scalar σ{1};           ///< σ_max(P A P), from above
  scalar ρ{1};           ///< penalty
  scalar M{1};           ///< inner problems are solved until ‖r̃‖ ≤ M ‖Q x − x̄‖
  scalar η{0};           ///< and ‖r̃‖ ≤ η
  scalar lagrangian{0};  ///< L(x, ν, ρ) of the last inner problem, in units of inner.unit
  scalar lagrangian_noise{0};   ///< of that, from rounding
  scalar feasibility_norm{0};   ///< ‖Q x − x̄‖, distance of x from the affine space
  scalar feasibility_scale{0};  ///< max(‖x̄‖, ‖x‖)
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖ of L(·, ν, 0) with the new ν: of A x − b + ν on ker G
  scalar gradient_scale{0};    ///< min(‖P (b − A x̄)‖, ρ feasibility_scale), see step
  scalar load{0};              ///< ‖P (b − A x̄)‖
  index inner_iterations = 0;  ///< of the last outer step
  index iteration = 0;         ///< outer steps: updates of ν
  slant::status status = slant::status::running;
  slant::work work{};

  progress_watch<scalar> progress{};  ///< looks for steps that get nowhere
  scalar energy_unit{1};              ///< what it is told L in
  bool is_slow = false;               ///< the error has not fallen for `patience` steps, L may rise
  bool resumed = true;                ///< the inner method has been told of ν already
  bool comparable = false;            ///< L may be compared with that of the step before
  bool infeasible = false;            ///< no point of Λ satisfies G x = e, which has been shown

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_with_equalities(status, infeasible);
  }
};

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP, class C>
class smalse : public detail::refused_program<QP> {
  using problem = std::remove_cvref_t<QP>;

  static_assert(detail::program_demands<problem>::told);
  static_assert(detail::active_set_demands<problem>::told);
  static_assert(!kprgp_problem<problem> ||
                    affine_space<std::remove_cvref_t<C>, typename detail::vector_of<problem>::type>,
                "the constraints must be equality_constraints of vectors like b");

 public:
  using smalse::refused_method::refused_method;
};

template <class QP, class C>
smalse(QP&&, C&&, smalse_options<detail::program_scalar_t<QP>> = {})
    -> smalse<kept_t<QP>, kept_t<C>>;

// --- separation ----------------------------------------------------------------------------------
//
// Does a plane separate the set Λ from the affine space { Q x = x̄ }? Every point z of the space has
// wᵀz = wᵀx̄ if w ∈ range Q; so none is in Λ if wᵀy > wᵀx̄ for all y ∈ Λ. The least value of wᵀy is
// approached by
//
//     y(t) = P_Λ(x − t w),     t = 1, 2, 4, …,
//
// the minimisers of wᵀy + ‖y − x‖²/(2t), for w = Q x − x̄, the way from the space to x. The answer
// is yes only if the plane lies between the space and all y(t) until y(t) stays where it is, or up
// to t = 2⁴⁰: no point of Λ within that many times the distance ‖w‖ is in the space then.
//
// The right w is the one at the point of Λ next to the space, which minimises ½ ‖Q x − x̄‖² over Λ:
// accelerated projected gradients find it, at the price of a projection onto both a step.

namespace detail {

/// y and projected are scratch of the size of x. Mostly the first few t say no.
template <class Set, class V>
[[nodiscard]] bool separates(Set const& set, V const& x, V const& w, V const& nearest, V& y,
                             V& projected) {
  using S = scalar_t<V>;
  S const distance = norm(w), rounding = S(256) * detail::epsilon<S>() * (norm(x) + norm(nearest));
  S last = detail::infinity<S>();
  S t(1);
  for (int k = 0; k <= 40; ++k, t *= S(2)) {
    vectors::waxpy(-t, w, x, y);
    slant::project(set, slant::local(y), slant::local(projected));
    vectors::difference(projected, nearest, y);
    vectors::scale(S(1) / distance, y);
    // w = Q x − x̄ is a difference.
    if (!(inner_product(w, y) > rounding * norm(y))) return false;
    vectors::difference(projected, x, y);
    S const moved = norm(y);
    if (moved == last) return true;
    last = moved;
  }
  return true;
}

/// Is it shown that no point of Λ is in the space c? Starts at x. Allocates.
template <class Set, class C, class V>
[[nodiscard]] bool is_apart(Set const& set, C const& c, V const& x) {
  using S = scalar_t<V>;
  V point = x, last = x, ahead = x, w = x, y = x, projected = x;
  auto const Q = c.range_projector();
  S shortest = detail::infinity<S>();
  index momentum = 0;
  for (index k = 1; k <= 4096; ++k) {
    slant::apply(Q, ahead, w);
    vectors::subtract(c.nearest(), w);
    vectors::difference(ahead, w, y);
    std::swap(last, point);
    slant::project(set, slant::local(y), slant::local(point));
    slant::apply(Q, point, w);
    vectors::subtract(c.nearest(), w);
    S const distance = norm(w);
    using std::sqrt;
    if (!(distance > sqrt(detail::epsilon<S>()) * norm(point))) return false;
    if ((k & (k - 1)) == 0 && separates(set, point, w, c.nearest(), y, projected)) return true;
    momentum = distance > shortest ? 0 : momentum + 1;
    shortest = std::min(shortest, distance);
    S const factor = S(static_cast<double>(momentum)) / S(static_cast<double>(momentum + 3));
    slant::local(ahead) = slant::local(point) + factor * (slant::local(point) - slant::local(last));
  }
  return false;
}

}  // namespace detail

/// The method at the top of this file: solve(smalse{qp, constraints}, x0,
/// (reduced_gradient_below(1e-8) && feasibility_below(1e-8)) || at_most(100)); options last.
/// Requires of the problem what kprgp does; constraints are equality_constraints{G, e}. Spends one
/// application of A an outer step besides those of KPRGP, and at the start those for the bound of
/// σ_max(P A P). Statuses of its own: converged, stalled (see state.infeasible), unbounded,
/// breakdown.
template <class QP, class C>
  requires smalse_problem<std::remove_cvref_t<QP>, std::remove_cvref_t<C>>
class smalse<QP, C> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using constraints = std::remove_cvref_t<C>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = smalse_options<scalar>;
  using state_type = smalse_state<problem, constraints>;

  /// Throws bad_input if the constraints are for another number of unknowns, or for options out of
  /// range.
  smalse(held<QP> qp, held<C> c, options o = {})
      : qp_(std::move(qp)), constraints_(std::move(c)), options_(std::move(o)) {
    detail::check_size("columns of G", index(constraints_.get().size()), qp_.get().size(),
                       "the size of b,");
    options_.validate();
  }

  /// The state of P_Λ(x0) with ν = 0 or, if ‖r̃‖ is less, ν = −Q (b − A x̄). Throws bad_input if x0
  /// or A x0 is not finite or of the wrong size, or as the bound of σ_max and the inner method do.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    auto const& c = constraints_.get();
    detail::check_start_in_set(x0, qp.b());
    spectral_bound<scalar> bound{scalar(0), scalar(0), scalar(0), 0};
    if (!detail::is_one_point(c)) {
      bound = largest_eigenvalue_bound(projected_hessian(qp.a(), c), x0);
    }
    scalar const whole = detail::size_on_ones(qp.a(), x0);
    // P A P may consist of rounding errors of A; any penalty will do then.
    bool const told = bound.ritz > scalar(32) * detail::epsilon<scalar>() * whole;
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
    s.M = balance * ρ;
    s.load = norm(load.projected);
    s.work = s.inner.work;
    s.work.setup_applications += bound.applications + 2;
    look(s);
    choose_multiplier(s, x0, load.opposed);
    s.η = precision * std::max(s.load, s.gradient_scale);
    return s;
  }

  /// Goes on from P_Λ(x) with another multiplier ν ∈ range Gᵀ. One application; no allocation.
  void resume(state_type& s, vector_type const& x, vector_type const& ν) const {
    s.status = status::running;
    s.progress = {};
    s.is_slow = false;
    s.energy_unit = s.inner.unit;
    s.M = balance * s.ρ;
    slant::project(qp_.get().set(), slant::local(x), slant::local(s.inner.x));
    vectors::copy(ν, s.ν);
    form_linear_term(s);
    if (s.status != status::running) return;
    auto const inner_problem = augmented(s.b, s.ρ);
    inner_method(inner_problem, s.σ).resume(s.inner);
    ++s.work.operator_applications;
    s.resumed = true;
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
  using inner_qp = detail::augmented_qp<problem, constraints>;

  /// M₀ in multiples of ρ: inner problems until ‖r̃‖ ≤ M ‖G x − e‖. Of 0.3, 1 and 5 the first took
  /// the least products, down to half of those of the last.
  static constexpr scalar balance = scalar(0.3);
  static constexpr scalar shrink = scalar(0.1);     // β: M ← β M if L has not grown enough
  static constexpr scalar precision = scalar(0.1);  // η in multiples of ‖P (b − A x̄)‖
  static constexpr index inner_steps = 5000;        // of one inner problem at most
  /// Outer steps without progress that mean stalled: the error does not fall, nor L rise.
  static constexpr index patience = 30;

  /// min L(·, ν, ρ) over Λ; refers to b.
  [[nodiscard]] inner_qp augmented(vector_type const& b, scalar const& ρ) const {
    return {augmented_hessian(qp_.get().a(), constraints_.get(), ρ), b, qp_.get().set()};
  }
  [[nodiscard]] auto inner_method(inner_qp const& qp, scalar const& σ) const {
    kprgp_options<scalar> own;
    own.step_length = own.step_factor / σ;  // σ is an upper bound of σ_max
    return kprgp<inner_qp const&>{qp, own};
  }

  void form_linear_term(state_type& s) const {
    vectors::difference(s.projected_b, s.ν, s.b);
    vectors::axpy(s.ρ, constraints_.get().nearest(), s.b);
    if (!detail::is_finite(norm(s.b))) s.status = status::breakdown;
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
    s.gradient_scale = detail::gradient_scale(s.load, s.ρ, s.feasibility_scale);
    s.reduced_gradient_norm = s.inner.reduced_gradient_norm;
    bool const solved = s.reduced_gradient_norm == scalar(0) && s.feasibility_norm == scalar(0);
    if (solved) s.status = status::converged;
    if (s.inner.status == status::unbounded) {
      s.infeasible = detail::is_apart(qp_.get().set(), constraints_.get(), s.x);
      s.status = s.infeasible ? status::stalled : status::unbounded;
    } else if (s.inner.status == status::breakdown) {
      s.status = status::breakdown;
    }
    if (!detail::is_finite(s.feasibility_norm)) s.status = status::breakdown;
  }

  /// While x stays in a corner of Λ the error does not fall before ν has grown to what b asks for,
  /// and every step of that raises L. It rises for ever where the constraints are infeasible, which
  /// is recognised by a plane that separates them from Λ, and by nothing else: where the two meet at
  /// a small angle, progress is as slow as if they did not. Looking for it allocates, once in
  /// `patience` steps.
  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    // In lengths, by a factor that does not change: x may be larger on the way than at its end.
    scalar const error = std::max<scalar>(s.reduced_gradient_norm / s.ρ, s.feasibility_norm);
    auto const energy = [&] {
      s.is_slow = true;
      s.infeasible = detail::is_apart(qp_.get().set(), constraints_.get(), s.x);
      if (s.infeasible) return std::pair(detail::infinity<scalar>(), scalar(0));
      // Half of its digits may stay the same, as those of the error.
      using std::abs, std::sqrt;
      scalar const unit = s.inner.unit / s.energy_unit, L = s.lagrangian * unit;
      scalar const share = sqrt(detail::epsilon<scalar>()) * abs(L);
      return std::pair<scalar, scalar>(-L, std::max<scalar>(s.lagrangian_noise * unit, share));
    };
    if (s.progress.stalled(s.iteration, error, patience, energy)) {
      s.status = status::stalled;
    }
  }

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
    while (inner.status == status::running && inner.iteration - steps_before < inner_steps) {
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
    scalar const least = scalar(64) * detail::epsilon<scalar>() * s.σ *
                         (norm(s.inner.x) + norm(constraints_.get().nearest()));
    scalar const most = std::min<scalar>(s.η, balanced > least ? balanced : shrink * at_start);
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
    if (s.comparable && now < s.lagrangian + growth - noise) s.M *= shrink;
    s.lagrangian = now;
    s.lagrangian_noise = noise;
  }

  held<QP> qp_;
  held<C> constraints_;
  options options_;
};

}  // namespace slant
