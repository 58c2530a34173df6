// SPDX-License-Identifier: MIT
//
// Semismooth Newton without the curvature term of the friction discs [K §3.3.3, (56)], after the
// displacements are eliminated:
//
//     minimise   q(λ) = ½ λᵀA λ − bᵀλ   over   λ ∈ Λ = Λ₁ × … × Λ_m
//
//     r(λ) = A λ − b,     r̃(λ) = (λ − P_Λ(λ − ρ r)) / ρ
//
//     (1°)   err^(k) = 0:  stop
//     (2°)   z = λ^(k) − ρ r^(k),   𝒜 = blocks with zᵢ inside Λᵢ                      (60), (61)
//     (3.1°) tol^(k+1) from err^(k)/err^(0) and tol^(k)
//     (3.2°) λ^(k+1,0): frozen blocks λᵢ = P_Λᵢ(zᵢ) for i ∉ 𝒜                         (57)
//            or P_Λ(z)                                                                (63)
//     (3.3°) λ^(k+1): minimum of q over the blocks in 𝒜 by conjugate gradients, to tol^(k+1) err^(0)
//     (4°)   err^(k+1) = ‖r̃(P_Λ(λ^(k+1)))‖
//
// 𝒜 is the set of free blocks of P_Λ(z). It differs from (60), (61) only if zᵢ is on the boundary
// itself, the kink of P_Λᵢ where any value is a slanting function. Rejected: 𝒜 with the boundary. A
// block that starts there may block the first CG step, and one that is a single point, such as a
// disc of radius 0, must not move at all.
//
// Products: one for each inner iteration, which takes the whole of r along; one for the start of a
// step, unless λ^(k+1,0) = λ^(k); one for (4°), if λ^(k+1) has left Λ.
#pragma once

#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/parts/recession.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/face.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- parts ---------------------------------------------------------------------------------------
//
// What distinguishes MSSN, IMSSN and GIMSSN [K §3.3.3, §3.3.4]: where a step starts, which
// conjugate gradients minimise q on the face, and how accurately (newton/forcing.hpp).

/// Step (3.2°) of IMSSN, (57): the blocks off the face are frozen at P(λ − ρ r), the others stay.
struct frozen_start {
  /// s.trial becomes λ^(k+1,0); s.φ is scratch.
  template <class State>
  static void place(State& s) {
    s.face.keep(s.x, s.φ);
    s.face.keep_complement(s.projected, s.trial);
    vectors::add(s.φ, s.trial);
  }
};

/// Step (3.2°) of GIMSSN, (63) on all blocks: λ^(k+1,0) = P_Λ(λ − ρ r), a projected gradient step.
struct projected_start {
  /// s.trial becomes λ^(k+1,0).
  template <class State>
  static void place(State& s) {
    vectors::copy(s.projected, s.trial);
  }
};

/// How the inner iterations of a step ended.
enum class inner_end : unsigned char {
  going_on,  ///< not yet
  accurate,  ///< to the accuracy asked for
  boundary,  ///< at the boundary of Λ, by a half step
  limit,     ///< after max_inner iterations
  endless,   ///< q has no minimum along p in floating point, and −p does not leave Λ
  broken     ///< A is not positive definite on the face, or a number is not finite
};

/// CG [K (62)]: to the minimum on the face, in Λ or not.
struct unlimited_cg {
  static constexpr bool stays_inside = false;

  /// One step along −p.
  template <class Set, class State, class S>
  static inner_end advance(Set const&, State& s, S const& noise) {
    auto const& d = s.directions;
    S const slope = inner_product(s.r, d.p);
    if (!(d.curvature > noise)) {
      bool const flat = d.curvature >= -noise;
      bool const minimal = flat && !is_descent(slope, d.p, S(s.size_of_b + norm(s.r)));
      return minimal ? inner_end::accurate : inner_end::broken;
    }
    S const α = slope / d.curvature;
    vectors::axpy(-(s.unit * α), d.p, s.x);
    vectors::axpy(-α, d.Ap, s.r);
    ++s.since_refresh;
    return inner_end::going_on;
  }
};

/// CG_feas [K §3.3.4 (ii)]: ends where it would leave Λ, with a half step to the boundary.
struct feasible_cg {
  static constexpr bool stays_inside = true;

  /// One step along −p.
  template <class Set, class State, class S>
  static inner_end advance(Set const& set, State& s, S const& noise) {
    auto const step = step_within(set, s, noise);
    if (step.end == feasible_step_end::minimum) return inner_end::going_on;
    if (step.end == feasible_step_end::broken) return inner_end::broken;
    bool const descent = is_descent(step.slope, s.directions.p, S(s.size_of_b + norm(s.r)));
    if (step.flat && !descent) return inner_end::accurate;
    if (step.end == feasible_step_end::endless) {
      return step.flat ? inner_end::endless : inner_end::broken;
    }
    half_step_within(set, s, step);
    return inner_end::boundary;
  }
};

/// What the options of mssn, imssn and gimssn begin with.
template <class Forcing>
inline constexpr Forcing default_forcing{};
/// The minimum on the face, for practical purposes.
template <>
inline constexpr fixed_forcing default_forcing<fixed_forcing>{.tolerance = 1e-8};
/// [K] does not print r_tol and c_fact. Where discs slide there are hundreds of steps, after which
/// c_fact^k, not the error, would decide: on bricks and wires with the proposal of [K §3.2.4], 0.1
/// and 0.9, most products go into accuracy that nobody needs, ten times as many at worst.
template <>
inline constexpr adaptive_precision default_forcing<adaptive_precision>{.r_tol = 0.5,
                                                                        .c_fact = 0.999};

/// Options of mssn, imssn and gimssn. Forcing is a rule of newton/forcing.hpp.
template <class S, class Forcing>
struct modified_newton_options {
  Forcing forcing = default_forcing<Forcing>;  ///< how accurately q is minimised on a face
  std::optional<S> step_length{};  ///< ρ > 0 of z = λ − ρ r; not given: β / σ_max
  S step_factor = S(1.9);          ///< β > 0; below 2 for gimssn, whose descent it guarantees
  index max_inner = 1000;          ///< inner iterations a step at most
  index patience = 100;  ///< steps in which neither ‖r̃‖ nor q falls that mean stalled

  [[gnu::cold]] void validate() const {
    forcing.validate();
    if (step_length) detail::check_positive("step_length", *step_length);
    detail::check_positive("step_factor", step_factor);
    if (max_inner < 1) throw bad_input("max_inner", detail::show(max_inner), "a number >= 1");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
  }
};

/// An iterate λ that has left Λ: the state's x is then P_Λ(λ).
template <class V>
struct outside_point {
  V x;                      ///< λ
  V r;                      ///< its gradient, in multiples of the state's unit
  index since_refresh = 0;  ///< steps since r was computed from λ
  bool in_use = false;      ///< false: λ is the state's x

  outside_point(V const& prototype, index n) : x(like(prototype, n)), r(x) {}
};

/// State of mssn, imssn and gimssn for a separable_qp of type QP and the inner iterations Inner.
template <class QP, class Inner>
struct modified_newton_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  vector_type φ;                                 ///< r on the face; between steps scratch
  conjugate_directions<vector_type> directions;  ///< p, Ap, pᵀAp; p vanishes off the face
  outside_point<vector_type> outside;            ///< λ, where it is not x
  recession_watch<vector_type> recession;        ///< looks for descent without end
  progress_watch<scalar> progress;               ///< looks for steps that get nowhere
  face_t<typename QP::set_type, local_t<vector_type>> face;  ///< of the last step; free blocks: 𝒜

  forcing_history<scalar> forcing{};  ///< err^(k), err^(0), and the last tolerance η
  scalar σ{0};                        ///< σ_max to a few digits; known if ρ was not given
  index inner_iterations = 0;         ///< of the last step; those of all steps are in work
  inner_end last_inner = inner_end::going_on;  ///< how they ended
  index iteration = 0;
  slant::status status = slant::status::running;

  modified_newton_state(QP const& qp, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        φ(like(x0, qp.size())),
        directions(x0),
        outside(x0, Inner::stays_inside ? 0 : qp.size()),
        recession(x0, declares_positive_definite<typename QP::operator_type> ? 0 : qp.size()) {}

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_of(
        status,
        {.stalled = stagnation() + ": " + this->accuracy(),
         .breakdown = "a number left the range of the scalar, or A is not positive definite "
                      "on a face"});
  }

 private:
  [[nodiscard, gnu::cold]] std::string stagnation() const {
    if (last_inner == inner_end::endless) {
      return "along a direction that does not leave the set the curvature is lost in rounding "
             "errors";
    }
    return std::string("neither the reduced gradient nor the function falls any more; the ") +
           (last_inner == inner_end::limit ? "inner iterations end at their limit"
                                           : "active sets may recur");
  }
};

/// A problem that lacks something ends here; mssn, imssn and gimssn say what it is.
template <class QP, class Start, class Inner, class Forcing>
class modified_newton : public detail::refused_program<
                            QP, modified_newton_state<std::remove_cvref_t<QP>, Inner>,
                            modified_newton_options<detail::program_scalar_t<QP>, Forcing>> {
 public:
  using modified_newton::refused_method::refused_method;
};

/// The frame of mssn, imssn and gimssn. Start and Inner are of the kinds above,
/// Forcing is a rule of newton/forcing.hpp. Requires: psd_operator (A positive definite on the
/// faces that occur) and separable_set with step_to_boundary.
template <class QP, class Start, class Inner, class Forcing>
  requires kprgp_problem<std::remove_cvref_t<QP>>
class modified_newton<QP, Start, Inner, Forcing> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = modified_newton_options<scalar, Forcing>;
  using state_type = modified_newton_state<problem, Inner>;

  /// Throws bad_input for options out of range.
  explicit modified_newton(held<QP> qp, options o = {})
      : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
    if (Inner::stays_inside && !options_.step_length && !(options_.step_factor < scalar(2))) {
      throw bad_input("step_factor", detail::show(options_.step_factor), "a number in (0, 2)");
    }
  }

  /// The state of λ^(0) = P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong
  /// size, or if 1/σ_max is not a finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_start_in_set(x0, qp_.get().b());
    state_type s(qp, x0);
    set_step_length(s);
    begin_newton(s, s.begin(qp, x0));
    return s;
  }

  /// As start(x0), in a state that start has made, after b or Λ of the problem have changed: what
  /// depends on A alone (ρ, σ_max, all memory) stays. Counts begin at zero. x0 must not be s.x. One
  /// application; no allocation.
  void resume(state_type& s, vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    if constexpr (!Inner::stays_inside) s.outside.in_use = false;
    s.progress = {};
    s.recession.forget();
    s.iteration = s.inner_iterations = 0;
    s.last_inner = inner_end::going_on;
    s.status = status::running;
    begin_newton(s, s.begin_again(qp_.get(), x0));
  }

  /// One Newton step, (2°) to (4°), with its inner iterations.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    return_to_iterate(s);
    s.face.assign(qp_.get().set(), slant::local(s.projected));
    scalar const η = s.forcing.next(options_.forcing);
    start_on_face(s);
    // The η of the documents falls with err^(k)/err^(0) [K (3.1°)], that of other rules does not.
    constexpr bool falls = std::is_same_v<Forcing, adaptive_precision>;
    minimise(s, η * (falls ? s.forcing.first_error : s.forcing.error));
    measure(s);
    s.forcing.record(s.reduced_gradient_norm);
    ++s.iteration;
    note_progress(s);
  }

  /// r and r̃ from x, if inner iterations have been updating r instead; whether they have. One
  /// application.
  bool refresh(state_type& s) const {
    if (s.since_refresh == 0) return false;
    s.status = status::running;
    compute_gradient(s);
    s.reduce(qp_.get());
    judge(s);
    return true;
  }

 private:
  static constexpr bool definite = declares_positive_definite<typename problem::operator_type>;
  /// Inner iterations after which a step computes r anew even where it could be kept.
  static constexpr index most_updates = 50;

  void begin_newton(state_type& s, bool solved) const {
    s.face.assign(qp_.get().set(), slant::local(s.x));
    s.reduce(qp_.get());
    judge(s);
    s.forcing = s.forcing.starting_at(s.reduced_gradient_norm);
    if (solved) s.status = status::converged;
  }

  /// λ^(k), its r and P_Λ(z), if x is only its projection.
  void return_to_iterate(state_type& s) const {
    if constexpr (!Inner::stays_inside) {
      if (!s.outside.in_use) return;
      exchange(s);
      s.outside.in_use = false;
      vectors::waxpy(-(s.step_length * s.unit), s.r, s.x, s.trial);
      slant::project(qp_.get().set(), slant::local(s.trial), slant::local(s.projected));
    }
  }

  /// (3.2°): r is computed anew unless λ stays where it is.
  void start_on_face(state_type& s) const {
    Start::place(s);
    bool const stays = slant::everywhere(s.x, vectors::equal(s.trial, s.x));
    if (stays && s.since_refresh < most_updates) return;
    std::swap(s.x, s.trial);
    compute_gradient(s);
  }

  /// r from x.
  void compute_gradient(state_type& s) const {
    if (s.gradient_and_unit(qp_.get())) s.progress.forget_energy();
  }

  /// (3.3°): conjugate gradients on the face until ‖r‖ there is at most `accuracy`. By recurrences
  /// it would go on to fall below the rounding errors of r, until its squares vanish.
  void minimise(state_type& s, scalar const& accuracy) const {
    auto const& qp = qp_.get();
    scalar const noise = detail::epsilon<scalar>() / scalar(4) * (s.size_of_b + norm(s.r));
    scalar const size = std::max<scalar>(accuracy, s.unit * noise);
    s.directions.live = false;
    s.inner_iterations = 0;
    s.last_inner = inner_end::going_on;
    while (s.last_inner == inner_end::going_on) {
      s.face.keep(s.r, s.φ);
      if (s.unit * norm(s.φ) <= size) {
        s.last_inner = inner_end::accurate;
      } else if (s.inner_iterations == options_.max_inner) {
        s.last_inner = inner_end::limit;
      } else {
        next_direction(qp.a(), s);
        ++s.inner_iterations;
        bool const σ_unknown = options_.step_length.has_value();
        s.last_inner =
            Inner::advance(qp.set(), s, kernel_curvature<definite>(s.directions, s.σ, σ_unknown));
      }
    }
    s.work.inner_iterations += s.inner_iterations;
    if (s.last_inner == inner_end::broken) s.status = status::breakdown;
    if (s.last_inner == inner_end::endless) look_for_descent(s);
  }

  /// Where an inner iteration has found no minimum along p and no end of Λ.
  void look_for_descent(state_type& s) const {
    if constexpr (definite) {
      s.status =
          status::breakdown;  // a curvature of 0 is out of range, or A is not what it promised
    } else {
      bool const confirmed = confirm_descent(qp_.get(), s, options_.max_inner);
      s.status = confirmed ? status::unbounded : status::stalled;
    }
  }

  /// (4°), with x = P_Λ(λ).
  void measure(state_type& s) const {
    if constexpr (!Inner::stays_inside) {
      slant::project(qp_.get().set(), slant::local(s.x), slant::local(s.trial));
      bool const inside = slant::everywhere(s.x, vectors::equal(s.trial, s.x));
      if (!inside) {
        s.outside.in_use = true;
        exchange(s);
        std::swap(s.x, s.trial);
        compute_gradient(s);
      }
    }
    s.reduce(qp_.get());
    // r̃ = 0 counts if r was computed from x.
    if (s.reduced_gradient_norm == scalar(0) && s.since_refresh > 0) {
      compute_gradient(s);
      s.reduce(qp_.get());
    }
    judge(s);
    if constexpr (!definite) {
      // Steps that end at the boundary again and again may still sum up to a direction of descent
      // that never does.
      if (s.status == status::running && s.recession.found(qp_.get(), s)) {
        s.status = status::unbounded;
      }
    }
  }

  static void exchange(state_type& s) {
    std::swap(s.x, s.outside.x);
    std::swap(s.r, s.outside.r);
    std::swap(s.since_refresh, s.outside.since_refresh);
  }

  /// The status of the point at which a step has ended.
  void judge(state_type& s) const {
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
    if (s.status == status::running && s.reduced_gradient_norm == scalar(0)) {
      s.status = status::converged;
    }
  }

  void note_progress(state_type& s) const {
    if (s.status != status::running) return;
    auto const energy = [&] { return s.energy(qp_.get()); };
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, energy,
                           s.rounding())) {
      s.status = status::stalled;
    }
  }

  void set_step_length(state_type& s) const {
    s.σ = s.set_step_length(qp_.get(), options_.step_length, scalar(1));
    if (options_.step_length) return;
    s.step_length *= options_.step_factor;
    if (!detail::is_finite(s.step_length)) {
      throw bad_input("step_factor", detail::show(options_.step_factor),
                      "one for which step_factor / sigma_max is finite");
    }
  }

  held<QP> qp_;
  options options_;
};

// --- mssn ----------------------------------------------------------------------------------------
//
// MSSN, "modified semismooth Newton" [K §3.3.3]: every step freezes the blocks outside 𝒜 by (57)
// and minimises q over the others. If it converges, then to the solution [K Theorem 6]. It need
// not: active sets can recur, and a sliding disc moves only by the fixed steps of (57).

template <class S>
using mssn_options = modified_newton_options<S, fixed_forcing>;

/// MSSN for a separable_qp: solve(mssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)). The
/// minimum on a face is computed to a fraction of err^(k), by default 1e-8. Iterates may leave Λ; x
/// is P_Λ of them. Requires what kprgp does. Statuses of its own: see imssn.
template <class QP>
class mssn : public modified_newton<QP, frozen_start, unlimited_cg, fixed_forcing> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using mssn::modified_newton::modified_newton;
};

template <class QP>
mssn(QP&&, mssn_options<detail::program_scalar_t<QP>> = {}) -> mssn<kept_t<QP>>;

// --- imssn ---------------------------------------------------------------------------------------
//
// IMSSN, "inexact MSSN" [K §3.3.3]: a restarted CG method, (3.2°) with frozen blocks (57) and
//
//     tol^(k+1) = min(r_tol err^(k)/err^(0), c_fact tol^(k)),   tol^(0) = r_tol/c_fact      (3.1°)
//
// Nothing guarantees convergence: use gimssn where it stalls. Measured: with ρ = 1.9/σ_max it
// converges on all wires and bricks tried, with 8/σ_max in half the products on some bricks and not
// at all on others and on the wire, where active sets recur. A sliding disc moves by one fixed step
// (57) a Newton step, so the last digits cost hundreds of steps where discs slide; on half lines
// and intervals there are some ten.

template <class S>
using imssn_options = modified_newton_options<S, adaptive_precision>;

/// IMSSN for a separable_qp: solve(imssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(100)).
/// Iterates may leave Λ; x is P_Λ of them. Requires what kprgp does. Statuses of its own: converged
/// (r̃ = 0); stalled (neither ‖r̃‖ nor q has fallen for `patience` steps: active sets recur, or
/// rounding errors end the descent); breakdown (a number left the range of the scalar, or A is not
/// definite on a face).
template <class QP>
class imssn : public modified_newton<QP, frozen_start, unlimited_cg, adaptive_precision> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using imssn::modified_newton::modified_newton;
};

template <class QP>
imssn(QP&&, imssn_options<detail::program_scalar_t<QP>> = {}) -> imssn<kept_t<QP>>;

// --- gimssn --------------------------------------------------------------------------------------
//
// GIMSSN, "globally convergent IMSSN" [K §3.3.4]: with tol^(k+1) as IMSSN has it every step begins
// with a projected gradient step on all blocks, (63) with ρ ∈ (0, 2/σ_max), and ends in Λ: CG_feas
// makes a half step to the boundary when it would leave Λ. q falls in every step, by the factor
// η = 1 − min(ρ, 2/σ_max − ρ) σ_min at least, and
// ‖λ^(k) − λ*‖² ≤ 2 (q(λ^(0)) − q(λ*)) η^k / σ_min for subsymmetric sets [K Theorem 7].
//
// Known weakness: on a curved boundary a sliding block moves only by the gradient steps (3.2°).

/// GIMSSN for a separable_qp: solve(gimssn{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// All iterates are in Λ. Requires what kprgp does. ρ < 2/σ_max is insisted on, unless step_length
/// is given. Statuses of its own: those of imssn, and unbounded (q decreases for ever along
/// −state.directions.p); breakdown where A was seen not to be semidefinite.
template <class QP>
class gimssn : public modified_newton<QP, projected_start, feasible_cg, adaptive_precision> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(detail::active_set_demands<std::remove_cvref_t<QP>>::told);

 public:
  using gimssn::modified_newton::modified_newton;
};

template <class QP>
gimssn(QP&&, imssn_options<detail::program_scalar_t<QP>> = {}) -> gimssn<kept_t<QP>>;

}  // namespace slant
