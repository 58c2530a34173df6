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
//     coarse      t₀ = −Π Nᵀ(N Π Nᵀ)⁻¹N (Q x − x̄)         the second row; problems/cut_face.hpp
//     solve       t − t₀ ∈ range(Π) ∩ ker N                preconditioned conjugate gradients
//     multiplier  dm from what is left of the first row
//     shorten     β = 1, ½, … until θ(y + β dy, ν + β dν) ≤ (1 − c β) θ,   θ² = ‖F‖² + ‖Q y − x̄‖²,
//                 F = y − P_Λ(z): y, z and Q y are linear along the step, no product by A
//     accept      others see x ∈ Λ with a gradient computed from x
//
// All equations are in every Newton system, and N Π Nᵀ is the coarse problem of the face: so it
// does not matter which of the bodies of Total-FETI contact holds. A preconditioner M ≈ A⁻¹ is
// applied in the cut face, as P W M W P with P onto range(Π) ∩ ker N
// (methods/parts/curved_minimum.hpp).
//
// Where equations depend on others on the face (N Π Nᵀ is singular) and do not agree there, no β is
// accepted, or A resists a step by rounding only, SMALSE-M takes over from x and ν until θ(x, ν) is a
// tenth below its value at the failure. It converges from everywhere, so this takes finitely many
// steps, and from failure to failure θ falls by a factor. Where it gets nowhere, because the
// multiplier is far away in units of its penalty, the penalty grows.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/augmented_problem.hpp>
#include <slant/problems/cut_face.hpp>
#include <slant/problems/separable_qp.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ, G x = e: a problem for symmetric_newton, and rows.
template <class QP, class C>
concept constrained_newton_problem =
    symmetric_newton_problem<QP> && affine_space_with_rows<C, typename QP::vector_type>;

/// Options of constrained_newton.
template <class S = double>
struct constrained_newton_options {
  index inner_steps = 1000;  ///< conjugate gradient steps of one Newton step at most

  [[gnu::cold]] void validate() const {
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
  }
};

namespace detail {

/// ½ xᵀP A P x − bᵀx with b = P (b − A x̄) − ν: its operator is owned, the rest is referenced.
template <class QP, class C>
using projected_qp =
    separable_qp<decltype(slant::projected_hessian(
                     std::declval<typename QP::operator_type const&>(), std::declval<C const&>())),
                 typename QP::vector_type const&, typename QP::set_type const&>;

}  // namespace detail

/// The steps of constrained_newton.
enum class constrained_newton_step : unsigned char { none, full, damped, fallback };

/// State of constrained_newton for a separable_qp of type QP, constraints C and the preconditioner
/// M. x ∈ Λ with the gradient r of q(x) + νᵀx, computed from x, and its reduced gradient are those
/// of gradient_point.
template <class QP, class C, class M>
struct constrained_newton_state : gradient_point<detail::projected_qp<QP, C>> {
  using base = gradient_point<detail::projected_qp<QP, C>>;
  using typename base::scalar;
  using typename base::vector_type;

  vector_type ν;                ///< Gᵀμ, a gradient
  vector_type projected_b;      ///< P (b − A x̄)
  vector_type b = projected_b;  ///< P (b − A x̄) − ν
  vector_type offset = ν;       ///< Q x − x̄

  newton_segment<vector_type> segment;   ///< y, z of Newton's iterate; x = P_Λ(z) after a step
  vector_type offset_y = ν;              ///< Q y − x̄
  vector_type target_offset = ν;         ///< the same at the end of the full step
  cut_face<scalar> face;                 ///< the face at z, cut by ker G
  curved_minimum<vector_type, M> inner;  ///< the step on it
  vector_type lifted = ν;                ///< the part of the step that cures Q x − x̄
  vector_type gradient_at_end = ν;       ///< scratch: gradients of the quadratic model
  vector_type dν = ν;                    ///< step of ν, in units
  workspace_t<decltype(std::declval<C const&>().range_projector()), vector_type> q_workspace;
  forcing_history<scalar> forcing{};              ///< errors and inner tolerances so far
  progress_watch<scalar> progress{};              ///< looks for steps that get nowhere
  std::optional<smalse_state<QP, C>> fallback{};  ///< of SMALSE-M, once there was need for it
  bool fallback_at_work = false;
  scalar goal{0};            ///< what the fallback has to reach
  index fallback_count = 0;  ///< how often it had to take over
  scalar penalty_factor{1};  ///< its penalty over the usual one

  scalar merit{0};  ///< √(‖F‖² + ‖Q y − x̄‖²)/α, in units of the gradient
  scalar feasibility_norm{0};     ///< ‖Q x − x̄‖, distance of x from the affine space
  scalar feasibility_scale{0};    ///< max(‖x̄‖, ‖x‖)
  scalar load{0};                 ///< ‖P (b − A x̄)‖
  scalar preconditioner_size{1};  ///< s = mean(diag M)
  bool at_projection = false;     ///< x = P_Λ(z)
  constrained_newton_step last_step = constrained_newton_step::none;
  scalar step_fraction{1};     ///< β of the last Newton step
  index inner_iterations = 0;  ///< of the last step
  index iteration = 0;         ///< Newton steps and outer steps of the fallback
  slant::status status = slant::status::running;
  bool infeasible = false;  ///< no point of Λ satisfies G x = e, which has been shown

  template <class Projected>
  constrained_newton_state(Projected const& problem, C const& c, M const& m, vector_type const& x0,
                           vector_type const& load_vector)
      : base(problem, x0),
        ν(like(x0, problem.size())),
        projected_b(load_vector),
        segment(x0, problem.size()),
        face(problem.set(), c.unit_rows()),
        inner(x0, problem.size(), m),
        q_workspace(workspace(c.range_projector(), x0)) {
    vectors::set_zero(ν);
  }

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_with_equalities(status, infeasible);
  }
};

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP, class C, class M>
class constrained_newton : public detail::refused_program<QP> {
  using problem = std::remove_cvref_t<QP>;

  static_assert(detail::program_demands<problem>::told);
  static_assert(detail::symmetric_newton_demands<problem, std::remove_cvref_t<M>>::told);
  static_assert(
      !symmetric_newton_problem<problem> ||
          affine_space_with_rows<std::remove_cvref_t<C>, typename detail::vector_of<problem>::type>,
      "the constraints must be equality_constraints of vectors like b, which must be an "
      "Eigen vector");

 public:
  using constrained_newton::refused_method::refused_method;
};

template <class QP, class C>
constrained_newton(QP&&, C&&, constrained_newton_options<detail::program_scalar_t<QP>> = {})
    -> constrained_newton<kept_t<QP>, kept_t<C>, identity_operator>;
template <class QP, class C, class M>
constrained_newton(QP&&, C&&, M&&, constrained_newton_options<detail::program_scalar_t<QP>> = {})
    -> constrained_newton<kept_t<QP>, kept_t<C>, kept_t<M>>;

/// The method at the top of this file: solve(constrained_newton{qp, constraints}, x0,
/// (reduced_gradient_below(1e-8) && feasibility_below(1e-8)) || at_most(100)); a preconditioner
/// M ≈ A⁻¹ third, options last. Requires of the problem what symmetric_newton does, for Eigen
/// vectors; constraints are equality_constraints{G, e}. Spends two products by A a step besides
/// those of conjugate gradients, one where x is in the affine space. Statuses of its own:
/// converged, stalled (see state.infeasible), unbounded, breakdown.
template <class QP, class C, class M>
  requires constrained_newton_problem<std::remove_cvref_t<QP>, std::remove_cvref_t<C>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class constrained_newton<QP, C, M>
    : public detail::preconditioned_program<QP, M, constrained_newton_options> {
  using base = detail::preconditioned_program<QP, M, constrained_newton_options>;
  using base::qp_, base::m_, base::options_, base::preconditioned;

 public:
  using typename base::problem, typename base::vector_type, typename base::scalar;
  using constraints = std::remove_cvref_t<C>;
  using state_type = constrained_newton_state<problem, constraints, typename base::preconditioner>;

  /// Throws bad_input if sizes do not match, or for options out of range.
  constrained_newton(held<QP> qp, held<C> c, typename base::options o = {})
    requires(!preconditioned)
      : base(std::move(qp), std::move(o)), constraints_(std::move(c)) {
    check();
  }
  constrained_newton(held<QP> qp, held<C> c, held<M> m, typename base::options o = {})
      : base(std::move(qp), std::move(m), std::move(o)), constraints_(std::move(c)) {
    check();
  }

  /// The state of P_Λ(x0) with ν = 0 or, if ‖r̃‖ is less, ν = −Q (b − A x̄). Throws bad_input if x0
  /// or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_start_in_set(x0, qp.b());
    auto const load = detail::projected_load(qp, constraints_.get());
    state_type s(projected(load.projected), constraints_.get(), m_.get(), x0, load.projected);
    s.load = norm(load.projected);
    ++s.work.setup_applications;
    set_sizes(s);
    slant::project(qp.set(), x0, s.x);
    s.gradient(projected(s.b));
    detail::check_finite("A x0 - b", s.r);
    s.unit = unit_near(std::max<scalar>(s.load, norm(s.r)));
    s.size_of_b = s.load / s.unit;
    s.r *= scalar(1) / s.unit;
    look(s);
    choose_multiplier(s, load.opposed);
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
    note_progress(s);
  }

  /// μ of G x = e, as many as G has rows: the gradient A x − b + Gᵀμ, reduced, vanishes at the
  /// solution. One application of A.
  [[nodiscard]] vector_type multipliers(state_type const& s) const {
    return detail::equality_multipliers(qp_.get(), constraints_.get(), s.x, s.offset, s.ν);
  }

 private:
  using projected_qp = detail::projected_qp<problem, constraints>;

  // As in benchmarks/total_feti.cpp.
  static constexpr double step_factor = 0.5;  // α in multiples of 1/mean(diag P A P)
  static constexpr double sufficient = 0.1;   // c: β lowers the merit by c β of it at least
  static constexpr index halvings = 20;       // β = 1, ½, …: so often at most
  static constexpr index patience = 100;      // steps in which the merit does not fall: stalled
  /// Inner accuracy, relative to the merit function.
  static constexpr eisenstat_walker forcing{
      .γ = 0.9, .exponent = 1.5, .η_max = 0.1, .η_first = 0.1};

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
    return detail::root_of_squares(of_x, of_space) / s.step_length;
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

  /// Whether a step on the face meets equations that depend on others there.
  [[nodiscard]] static bool can_lift(state_type& s) {
    s.face.lift(s.offset, s.lifted);
    s.trial = s.offset - s.lifted;
    return s.face.meets(s.trial, s.feasibility_scale);
  }

  /// t₀ in units, trial = r + P A P t₀ and gradient_at_end = the same with the curvature.
  template <class A>
  void lift(state_type& s, A const& a) const {
    s.trial = s.r;
    s.lifted.setZero();
    scalar const noise = scalar(4) * detail::epsilon<scalar>() * s.feasibility_scale;
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
    for (index j = 0; j <= halvings; ++j, β /= scalar(2)) {
      // residual_at needs two vectors: the gradient of the model is not needed any more.
      scalar const of_x = s.segment.residual_at(qp_.get().set(), β, s.projected, s.gradient_at_end);
      s.gradient_at_end = (scalar(1) - β) * s.offset_y + β * s.target_offset;
      scalar const merit = merit_of(s, of_x, norm(s.gradient_at_end));
      scalar const enough = (scalar(1) - scalar(sufficient) * β) * s.merit;
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
    if (s.progress.stalled(s.iteration, s.merit, patience)) {
      s.status = status::stalled;
    }
  }

  /// α, and s = mean(diag M).
  void set_sizes(state_type& s) const {
    auto const& qp = qp_.get();
    auto const mean = detail::projected_mean_diagonal(qp.a(), constraints_.get(), s.x);
    s.work.setup_applications += mean.applications;
    scalar const size = mean.value > scalar(0) ? scalar(scalar(1) / mean.value) : scalar(1);
    s.step_length = scalar(step_factor) * size;
    s.preconditioner_size = size;
    if constexpr (preconditioned) {
      s.preconditioner_size = mean_diagonal(m_.get(), s.x).value;
    }
  }

  void check() const {
    detail::check_size("columns of G", index(constraints_.get().size()), qp_.get().size(),
                       "the size of b,");
  }

  [[nodiscard]] auto fallback(state_type const& s) const {
    return smalse<problem const&, constraints const&>{
        qp_.get(), constraints_.get(), {.penalty = s.penalty_factor}};
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
    if (!s.face.assign(qp_.get().set(), s.segment.z, κ) && !can_lift(s)) return begin_fallback(s);
    lift(s, a);
    scalar const target = s.forcing.next(forcing) * s.merit / s.unit;
    auto const inner = s.inner.minimise(a, s.a_workspace, m_.get(), s.gradient_at_end, s.face, α,
                                        s.preconditioner_size, target, options_.inner_steps);
    if (!note_inner(inner, s)) {
      if constexpr (declares_positive_definite<typename problem::operator_type>) return;
      if (inner.iterations < 2) return;
      // A direction that A does not resist but for rounding; the other method knows these.
      s.status = status::running;
      return begin_fallback(s);
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
    if (shorten(s)) {
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
    ++s.fallback_count;
    start_fallback(s);
  }

  void start_fallback(state_type& s) const {
    auto const method = fallback(s);
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
    fall_back(s);
  }

  void fall_back(state_type& s) const {
    auto& other = *s.fallback;
    work const before = other.work;
    if (other.status == status::running) fallback(s).step(other);
    s.work.operator_applications += other.work.operator_applications - before.operator_applications;
    s.inner_iterations = other.inner_iterations;
    s.work.inner_iterations += other.inner_iterations;
    s.last_step = constrained_newton_step::fallback;
    s.x = other.x;
    s.ν = other.ν;
    measure(s);
    s.infeasible = other.infeasible;
    // Where it gets nowhere, μ is far away in units of ρ.
    bool const is_far =
        other.status == status::stalled || (other.is_slow && other.status == status::running);
    if (is_far && !s.infeasible && s.penalty_factor < scalar(1e6)) {
      s.penalty_factor *= scalar(100);
      s.fallback.reset();
      return start_fallback(s);
    }
    if (s.status == status::running) s.status = other.status;
    if (s.status == status::running && merit_at_x(s) > s.goal) return;
    s.fallback_at_work = false;
    restart(s);
    s.forcing.record(s.merit);
    s.progress = {};
  }

  held<C> constraints_;
};

}  // namespace slant
