// SPDX-License-Identifier: MIT
//
// Symmetric semismooth Newton method with the curvature of the constraints, for
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m                      [K (29)]
//
// With another separable convex function than the indicator of Λ it is envelope_newton.
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

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/methods/envelope_newton.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/block_queries.hpp>
#include <slant/sets/curved_face.hpp>

#if SLANT_USES_COMPILED
#include <slant/problems/any_qp.hpp>
#endif

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// min ½ xᵀA x − bᵀx over x ∈ Λ as kprgp takes it, Λ of blocks whose projections have slant(x); or
/// + φ(x) as envelope_newton takes it.
template <class QP>
concept symmetric_newton_problem = !detail::was_refused<QP> && envelope_newton_problem<QP> &&
                                   (kprgp_problem<QP> || !quadratic_program<QP>);

// --- descent takeover ----------------------------------------------------------------------------
//
// A method that converges from everywhere takes over where a faster one fails: KPRGP, until its
// iterate is better than the point of failure by a factor.

/// KPRGP at work on a point s that derives from gradient_point<QP>. Nothing is computed or
/// allocated before the first failure, σ_max included.
template <class QP>
class descent_takeover {
 public:
  using scalar = typename QP::scalar;
  using options = kprgp_options<scalar>;
  /// Refers to the problem; one that forgets its types is as good as a reference.
  using method_type = kprgp<std::conditional_t<forgets_types<QP>, QP, QP const&>>;

  [[nodiscard]] bool at_work() const { return at_work_; }
  /// No longer at work, and never was: the problem has changed.
  void leave() {
    at_work_ = false;
    count_ = 0;
  }
  /// How often it had to take over.
  [[nodiscard]] index count() const { return count_; }
  /// The state of KPRGP, once there was need for it.
  [[nodiscard]] std::optional<kprgp_state<QP>> const& state() const { return state_; }

  /// Starts at s.x; will hand back a point with ‖r̃‖ ≤ goal. Allocates. Status breakdown if KPRGP
  /// finds A or A x unusable, which it would refuse as input.
  template <class State>
  [[gnu::cold]] status begin(QP const& qp, options o, State& s, scalar const& goal) {
    scalar const σ = state_ ? state_->σ : scalar(0);
    if (state_) o.step_length = state_->step_length;  // σ_max is known by now
    try {
      state_.emplace(method_type{qp, std::move(o)}.start(s.x));
    } catch (bad_input const&) {
      return status::breakdown;
    }
    if (σ > scalar(0)) state_->σ = σ;
    s.work.setup_applications += state_->work.setup_applications;
    s.work.operator_applications += state_->work.operator_applications;
    goal_ = goal;
    at_work_ = true;
    ++count_;
    return follow(qp, s);
  }

  /// r from x, if KPRGP has been updating it; whether it has. One product.
  template <class State>
  [[gnu::cold]] bool refresh(QP const& qp, options const& o, State& s) {
    if (!method_type{qp, o}.refresh(*state_)) return false;
    ++s.work.operator_applications;
    s.status = follow(qp, s);
    return true;
  }

  /// One step of KPRGP.
  template <class State>
  [[gnu::cold]] status step(QP const& qp, options const& o, State& s) {
    index const before = state_->work.operator_applications;
    method_type const method{qp, o};
    method.step(*state_);
    copy(qp, s);
    // r̃ = 0 counts if r was computed from x.
    if (s.reduced_gradient_norm == scalar(0) && method.refresh(*state_)) copy(qp, s);
    s.work.operator_applications += state_->work.operator_applications - before;
    return judged(s);
  }

 private:
  /// s.x, s.r and s.reduced become those of KPRGP's iterate, which is no longer at work if that is
  /// good enough.
  template <class State>
  status follow(QP const& qp, State& s) {
    copy(qp, s);
    return judged(s);
  }
  template <class State>
  void copy(QP const& qp, State& s) {
    vectors::copy(state_->x, s.x);
    vectors::copy(state_->r, s.r);
    // In that of a start far away it might vanish.
    if (s.unit != state_->unit) s.progress.forget_energy();
    s.unit = state_->unit;
    s.size_of_b = state_->size_of_b;
    s.since_refresh = state_->since_refresh;
    s.reduce(qp);
  }
  /// By the reduced gradient of s, whose step length is another one.
  template <class State>
  status judged(State const& s) {
    if (s.reduced_gradient_norm == scalar(0)) return status::converged;
    if (state_->status == status::running) at_work_ = s.reduced_gradient_norm > goal_;
    return state_->status == status::converged ? status::stalled : state_->status;
  }

  std::optional<kprgp_state<QP>> state_;
  scalar goal_{0};
  bool at_work_ = false;
  index count_ = 0;
};

// --- rounded products ----------------------------------------------------------------------------
//
// The operator that inner iterations apply: the rounded twin of A where A has one, else A itself.
//
// The step t that conjugate gradients find with the twin is as good as its products are; its image
// A t is then computed by A, so that whoever takes the step knows the residual as exactly as
// without a twin. If that residual is not what the twin promised, because A is too badly
// conditioned for its precision, or a number has left its range, the step is computed anew with A,
// and so are all others.

/// Nothing to round: everything is done with A.
template <class A, class V>
class rounded_products {
 public:
  rounded_products(A const&, V const&) {}

  /// Whether steps are computed with rounded products.
  [[nodiscard]] static constexpr bool at_work() noexcept { return false; }
  static constexpr void give_up() noexcept {}
  /// inner.minimise with these products.
  template <class Inner, class WA, class M, class Face, class S>
  static auto minimise(Inner& inner, A const& a, WA& wa, M const& m, V const& r, Face const& face,
                       S const& ρ, S const& s, S const& target, index most) {
    return inner.minimise(a, wa, m, r, face, ρ, s, target, most);
  }
};

/// The twin with its workspace. A copy shares what the operator shares.
template <class A, class V>
  requires has_rounded<A, V>
class rounded_products<A, V> {
  using twin = decltype(std::declval<A const&>().rounded());

 public:
  rounded_products(A const& a, V const& prototype)
      : twin_(a.rounded()), workspace_(slant::workspace(*twin_, prototype)) {}

  [[nodiscard]] bool at_work() const noexcept { return twin_.has_value(); }
  void give_up() { twin_.reset(); }

  template <class Inner, class WA, class M, class Face, class S>
  auto minimise(Inner& inner, A const& a, WA& wa, M const& m, V const& r, Face const& face,
                S const& ρ, S const& s, S const& target, index most) {
    auto const exactly = [&] { return inner.minimise(a, wa, m, r, face, ρ, s, target, most); };
    if (!at_work()) return exactly();
    auto found = inner.minimise(*twin_, workspace_, m, r, face, ρ, s, target, most, least_progress);
    slant::apply(a, inner.t, inner.image, wa);
    ++found.iterations;
    S const residual = inner.residual(r, face, ρ);
    S const enough = std::max(S(4) * found.residual, S(16) * least_progress * found.first_residual);
    if (found.finite && residual <= enough) {
      found.residual = residual;
      return found;
    }
    give_up();
    auto again = exactly();
    again.iterations += found.iterations;
    return again;
  }

 private:
  /// With products of this precision a residual is not worth lowering further in one step.
  static constexpr scalar_t<V> least_progress = scalar_t<V>(1) / scalar_t<V>(4096);

  std::optional<twin> twin_;  // empty once given up
  workspace_t<twin, V> workspace_;
};

/// The steps of symmetric_newton.
enum class symmetric_newton_step : unsigned char { none, full, damped, descent };

/// State of symmetric_newton for a separable_qp of type QP with the preconditioner M. x ∈ Λ with
/// its gradient r, computed from x, and its reduced gradient are those of gradient_point.
template <class QP, class M>
struct symmetric_newton_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  newton_segment<vector_type> segment;   ///< y, z of Newton's iterate; x = P_Λ(z) after a step
  curved_face<scalar> face;              ///< range(G) and C at z
  curved_minimum<vector_type, M> inner;  ///< the step t on it
  rounded_products<typename QP::operator_type, vector_type> products;  ///< what it spends
  forcing_history<scalar> forcing{};  ///< errors and inner tolerances so far
  progress_watch<scalar> progress;    ///< looks for steps that get nowhere
  descent_takeover<QP> descent;       ///< the method that takes over where Newton's fails

  scalar residual_norm{0};  ///< ‖F(y)‖/ρ = ‖y − P_Λ(z)‖/ρ, in units of the gradient
  scalar preconditioner_size{1};  ///< s = mean(diag M)
  bool at_projection = false;     ///< x = P_Λ(z)
  symmetric_newton_step last_step = symmetric_newton_step::none;
  scalar step_fraction{1};     ///< β of the last Newton step
  index inner_iterations = 0;  ///< of the last Newton step
  index iteration = 0;
  slant::status status = slant::status::running;

  symmetric_newton_state(QP const& qp, M const& m, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        segment(x0, qp.size()),
        face(qp.set()),
        inner(x0, qp.size(), m),
        products(qp.a(), x0) {}

  [[nodiscard, gnu::cold]] std::string reason() const;
};

template <class QP, class M>
std::string symmetric_newton_state<QP, M>::reason() const {
  return detail::reason_of(
      status,
      {.converged = "the reduced gradient is zero: x is the solution",
       .stalled = "no step lowers the residual any further at this precision: " + this->accuracy(),
       .unbounded =
           "the function decreases for ever along a direction in the set that A does not resist",
       .breakdown = "a number left the range of the scalar, or A is not semidefinite"});
}

namespace detail {

template <class QP, class M>
struct symmetric_newton_demands {
  static constexpr bool told = true;
};
template <composite_problem QP, class M>
  requires(!was_refused<QP>)
struct symmetric_newton_demands<QP, M> {
  using set_type = typename QP::set_type;
  using points = local_t<typename QP::vector_type>;
  static_assert(has_block_slants<set_type, points> &&
                    (!quadratic_program<QP> || active_set_domain<set_type, points>),
                "the set must be made of blocks with slant(x), state(x) and "
                "step_to_boundary(x, d), a function of blocks with slant(ρ, z)");
  static constexpr bool told =
      preconditioner_demands<M, typename QP::vector_type, law_demand::semidefinite>::told;
};

}  // namespace detail

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP, class M = identity_operator>
class symmetric_newton : public detail::refused_program<
                             QP, symmetric_newton_state<std::remove_cvref_t<QP>, identity_operator>,
                             symmetric_newton_options<detail::program_scalar_t<QP>>> {
  static_assert(detail::composite_demands<std::remove_cvref_t<QP>>::told);
  static_assert(
      detail::symmetric_newton_demands<std::remove_cvref_t<QP>, std::remove_cvref_t<M>>::told);

 public:
  using symmetric_newton::refused_method::refused_method;
};

template <class QP>
symmetric_newton(QP&&, symmetric_newton_options<detail::program_scalar_t<QP>> = {})
    -> symmetric_newton<kept_t<QP>, identity_operator>;
template <class QP, class M>
symmetric_newton(QP&&, M&&, symmetric_newton_options<detail::program_scalar_t<QP>> = {})
    -> symmetric_newton<kept_t<QP>, kept_t<M>>;

namespace detail {

/// What `symmetric_newton` does with a problem that has all it needs.
template <class QP, class M>
class symmetric_newton_steps : public preconditioned_program<QP, M, symmetric_newton_options> {
  using base = preconditioned_program<QP, M, symmetric_newton_options>;
  using base::qp_, base::m_, base::options_;

 public:
  using typename base::problem, typename base::vector_type, typename base::scalar;
  using state_type = symmetric_newton_state<problem, typename base::preconditioner>;
  using base::base;

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
  /// r and r̃ of x; one product.
  void measure(state_type& s) const {
    static_cast<void>(s.gradient_and_unit(qp_.get()));
    s.reduce(qp_.get());
    detail::judge_reduced_gradient(s);
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

  void newton_step(state_type& s) const {
    auto const& qp = qp_.get();
    s.face.assign(qp.set(), slant::local(s.segment.z), s.preconditioner_size / s.step_length);
    scalar const target = s.forcing.next(options_.forcing) * s.residual_norm / s.unit;
    auto const inner =
        s.products.minimise(s.inner, qp.a(), s.a_workspace, m_.get(), s.r, s.face, s.step_length,
                            s.preconditioner_size, target, options_.inner_steps);
    if (!note_inner(inner, s)) {
      if constexpr (declares_positive_definite<typename problem::operator_type>) return;
      // A direction that A does not resist but for rounding; the other method knows these.
      s.status = status::running;
      begin_descent(s);
      return;
    }
    vectors::waxpy(s.unit, s.inner.t, s.x, s.segment.target_y);
    vectors::add(s.r, s.inner.image);
    vectors::waxpy(-ρ(s), s.inner.image, s.segment.target_y, s.segment.target_z);
    if (shorten(s)) {
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
  set_sizes(qp, m_.get(), options_, options_.step_factor, s);
  begin_newton(s, s.begin(qp, x0));
  return s;
}

template <class QP, class M>
void symmetric_newton_steps<QP, M>::step(state_type& s) const {
  if (s.status != status::running) return;
  if (s.descent.at_work()) {
    s.status = s.descent.step(qp_.get(), options_.descent, s);
    end_descent(s);
  } else {
    project(s);
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
  requires quadratic_program<std::remove_cvref_t<QP>> &&
           symmetric_newton_problem<std::remove_cvref_t<QP>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class symmetric_newton<QP, M> : public detail::symmetric_newton_steps<QP, M> {
 public:
  using symmetric_newton::symmetric_newton_steps::symmetric_newton_steps;
};

/// With a function that is no indicator: envelope_newton.
template <class QP, class M>
  requires(!quadratic_program<std::remove_cvref_t<QP>>) &&
          symmetric_newton_problem<std::remove_cvref_t<QP>> &&
          preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class symmetric_newton<QP, M> : public envelope_newton<QP, M> {
 public:
  using symmetric_newton::envelope_newton::envelope_newton;
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
