// SPDX-License-Identifier: MIT
//
// Successive approximations with inexact inner solves, for problems whose data depend on their own
// solution (quasi-variational inequalities):
//
//     x minimises   q_p(x) = ½ xᵀA x − b_pᵀx   over   Λ_p,      p = P(x).                [K (22)]
//
// Coulomb's law is one: the slip bounds g = F λ_ν are parameters of Tresca's problem. With x(p) the
// solution at p it is a fixed point of Ψ(p) = P(x(p)). The residual, free of charge after each
// solve, is the reduced gradient of x in the problem that x itself asks for,
//
//     R = ‖r̃(x)‖ for b and Λ at P(x):       0 exactly at a solution.
//
//     solve       min q_p over Λ_p from the last x, until ‖r̃‖ ≤ η R
//     look        P(x), R
//     mix         p ← a secant step from the last p and Ψ(p); where R has grown: p ← P(x)
//
// The convergence is linear, of rate κ say: inner problems solved by a factor η ~ κ ask conjugate
// gradients for the digits of one problem in portions, each of which begins anew; measured for
// Coulomb friction in benchmarks/coulomb.cpp. Where even plain steps let R grow the relaxation ω is
// halved. What Ψ is not a contraction for may have a solution that is not found: status `stalled`.
//
// A family of problems has
//
//     qp()                      the problem at the present p, whose b and set change in place
//     parameter_count()         entries of p
//     guess(x, p)               p ← a first guess for a start at x
//     parameters(x, r, p)       p ← P(x); r is the gradient at x of qp()
//     assign(p)                 makes p the present one; brings its entries into their range first
#pragma once

#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/newton/forcing.hpp>

#include <algorithm>
#include <concepts>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// Acceleration of a fixed point iteration p ← Ψ(p) by its last difference, Anderson's with a
/// window of one [Anderson 1965; Walker, Ni 2011, "type II"]: with f = Ψ(p) − p and Δp, Δf since
/// the last call
///
///     p ← p + ω f − γ (Δp + ω Δf),      γ = argmin ‖f − γ Δf‖.
///
/// It costs no evaluation of Ψ. More differences see the errors of inexact solves: on the bricks of
/// benchmarks/coulomb.cpp five took up to a quarter more products than one.
template <class V>
class secant_mixing {
 public:
  using scalar = scalar_t<V>;

  secant_mixing() = default;
  /// For vectors of n entries. Allocates; nothing later does.
  secant_mixing(V const& prototype, index n) : p_(like(prototype, n)) {}

  /// The next step is a plain one.
  void forget() { begun_ = false; }

  /// next ← the next p, from p and f, which are remembered. Whether a difference was used. `next`
  /// must not alias the others.
  bool mix(V const& p, V const& f, scalar const& ω, V& next) {
    bool used = false;
    scalar γ(0);
    if (begun_) {
      vectors::difference(p, p_, Δp_);
      vectors::difference(f, f_, Δf_);
      scalar const length = norm(Δf_);
      used = length > scalar(0) && detail::is_finite(length);
      if (used) {
        vectors::divide(length, Δf_);
        vectors::divide(length, Δp_);
        γ = inner_product(Δf_, f);
      }
    }
    vectors::copy(p, p_);
    vectors::copy(f, f_);
    begun_ = true;
    vectors::copy(p, next);
    if (used) {
      vectors::axpy(-γ, Δf_, f_);
      vectors::axpy(-γ, Δp_, next);
    }
    vectors::axpy(ω, f_, next);
    vectors::copy(f, f_);
    return used;
  }

 private:
  V p_{}, f_ = p_, Δp_ = p_, Δf_ = p_;
  bool begun_ = false;
};

/// Options of successive_approximations.
template <class S = double>
struct successive_options {
  /// η, relative to the residual R: more than Ψ brings the parameters nearer is wasted. With a goal
  /// the last problem is not solved too well. Measured for Coulomb friction on bricks (k = 6): the
  /// products for 0.5 … 0.1 differ by a fifth at most, 0.02 takes up to a half more.
  eisenstat_walker forcing{.γ = 1, .exponent = 1.001, .η_max = 0.3, .η_first = 0.3};
  bool secant = true;       ///< whether steps are accelerated
  index inner_steps = 200;  ///< of the inner method in one outer step at most
  index patience = 30;      ///< outer steps in which the residual does not fall that mean stalled

  [[gnu::cold]] void validate() const {
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    if (patience < 1) throw bad_input("patience", detail::show(patience), "at least 1");
    forcing.validate();
  }
};

/// State of successive_approximations with an inner method of states Inner, for vectors V.
template <class Inner, class V>
struct successive_state {
  using vector_type = V;
  using scalar = scalar_t<V>;

  V x;           ///< solution of the inner problem at `parameters`
  V parameters;  ///< p of the last inner problem
  V image;       ///< Ψ(p), of x
  V change;      ///< Ψ(p) − p
  V next;        ///< scratch: the next p
  V r;           ///< gradient at x of the problem at Ψ(p), in multiples of unit
  V reduced;     ///< its reduced gradient
  V trial;       ///< scratch
  V projected;   ///< scratch
  Inner inner;   ///< state of the inner method

  secant_mixing<V> mixing;            ///< differences of p and Ψ(p) − p
  forcing_history<scalar> forcing{};  ///< residuals and inner tolerances so far
  progress_watch<scalar> progress{};  ///< looks for steps that get nowhere
  scalar relaxation{1};  ///< ω: p ← p + ω (Ψ(p) − p) for a plain step; smaller after failures
  bool solved_once = false;         ///< x is a solution at p, up to η R, and no start
  bool accelerated = false;         ///< the last p is a secant step
  scalar unit{1};                   ///< of r and r̃, a power of two: that of the inner method
  scalar reduced_gradient_norm{0};  ///< ‖r̃‖ at x for the problem at Ψ(p): 0 at a fixed point
  scalar gradient_scale{0};         ///< that of the inner problem
  index inner_iterations = 0;       ///< of the inner method in the last step
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::status inner_status = slant::status::running;  ///< how the last inner solve ended
  slant::work work{};  ///< inner_iterations: steps of the inner method

  [[nodiscard, gnu::cold]] std::string reason() const {
    if (status == slant::status::converged) return "x solves the problem that belongs to it";
    if (status == slant::status::stalled) return "the fixed point iteration gets no nearer";
    return "the inner method reports: " + std::string(to_string(inner_status));
  }
};

/// A family of quadratic programs with parameters; see the top of this file.
template <class F, class V = typename F::vector_type>
concept parametric_program = requires(F& family, F const& c, V const& x, V& p) {
  c.qp().b();
  c.qp().set();
  { c.parameter_count() } -> std::convertible_to<index>;
  c.guess(x, p);
  c.parameters(x, x, p);
  family.assign(p);
};

/// The method at the top of this file. make(goal) makes the inner method, for family.qp(), that
/// does not look for more than goal · gradient_scale: its states are those of gradient_point.
///
///     slant::successive_approximations method(family, [&](double goal) {
///       return slant::symmetric_newton{qp, M, {.forcing = {…, .goal = goal}}};
///     });
///     auto r = slant::solve(method, x0, slant::reduced_gradient_below(1e-8));
///
/// Refers to the family, in which each step leaves P(x) of its state.
template <parametric_program Family, class Make>
class successive_approximations {
 public:
  using vector_type = typename Family::vector_type;
  using scalar = scalar_t<vector_type>;
  using inner_method = std::remove_cvref_t<std::invoke_result_t<Make const&, scalar>>;
  using inner_state = state_t<inner_method const, vector_type>;
  using options = successive_options<scalar>;
  using state_type = successive_state<inner_state, vector_type>;

  /// Throws bad_input for options out of range.
  successive_approximations(Family& family, Make make, options o = {})
      : family_(&family), make_(std::move(make)), options_(std::move(o)) {
    options_.validate();
  }

  /// The state of the inner method at x0, for the parameters that the family guesses. Throws
  /// bad_input as the inner method does.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    index const n = family_->parameter_count();
    vector_type p = like(x0, n);
    family_->guess(x0, p);
    family_->assign(p);
    auto const one = [&] { return like(x0, index(slant::local(x0).size())); };
    state_type s{x0, p, p, p, p, one(), one(), one(), one(), make_(scalar(0.5)).start(x0), {p, n}};
    begin(s);
    s.work = s.inner.work;
    return s;
  }

  /// As start(x0), in a state that start has made, after the data of the family have changed.
  void resume(state_type& s, vector_type const& x0) const
    requires has_resume_at<inner_method, inner_state, vector_type>
  {
    family_->guess(x0, s.parameters);
    family_->assign(s.parameters);
    make_(scalar(0.5)).resume(s.inner, x0);
    s.mixing.forget();
    s.progress = {};
    s.iteration = s.inner_iterations = 0;
    s.status = status::running;
    begin(s);
    s.work = s.inner.work;
  }

  /// One inner problem, and new parameters.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    bool const anew = choose_parameters(s);
    solve_inner(s, anew);
    ++s.iteration;
    if (s.status != status::running) return;
    scalar const before = s.reduced_gradient_norm;
    look(s);
    s.forcing.record(s.reduced_gradient_norm);
    guard(s, before);
  }

 private:
  void begin(state_type& s) const {
    s.relaxation = scalar(1);
    s.accelerated = false;
    s.solved_once = false;
    look(s);
    s.forcing = forcing_history<scalar>::starting_at(s.reduced_gradient_norm);
    s.forcing.first_error = s.gradient_scale;
  }

  /// P(x) and R; no product.
  void look(state_type& s) const {
    auto const& in = s.inner;
    vectors::copy(in.x, s.x);
    s.unit = in.unit;
    vectors::scale(in.unit, in.r, s.trial);
    family_->parameters(s.x, s.trial, s.image);
    if (!detail::is_finite(norm(s.image))) {
      s.status = s.inner_status = status::breakdown;
      return;
    }
    // r for the other b: r + b_p − b_P(x).
    vectors::waxpy(scalar(1) / in.unit, family_->qp().b(), in.r, s.r);
    family_->assign(s.image);
    vectors::axpy(-(scalar(1) / in.unit), family_->qp().b(), s.r);
    reduced_gradient(family_->qp().set(), s.x, s.r, in.step_length * in.unit, s.trial, s.projected,
                     s.reduced);
    vectors::difference(s.image, s.parameters, s.change);
    s.reduced_gradient_norm = in.unit * norm(s.reduced);
    s.gradient_scale = in.gradient_scale;
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
  }

  /// The next p; false if it is the last one, x being a start for it or not yet accurate enough.
  bool choose_parameters(state_type& s) const {
    s.accelerated = false;
    bool const moves = norm(s.change) > scalar(0);
    if (!moves) {
      vectors::copy(s.parameters, s.next);
    } else if (s.solved_once) {
      if (!options_.secant) s.mixing.forget();
      s.accelerated = s.mixing.mix(s.parameters, s.change, s.relaxation, s.next);
    } else {
      vectors::copy(s.image, s.next);
    }
    std::swap(s.parameters, s.next);
    family_->assign(s.parameters);
    return moves;
  }

  void solve_inner(state_type& s, bool anew) const {
    scalar const η = s.forcing.next(options_.forcing);
    auto& in = s.inner;
    // Where p stays as it is there is nothing to save for later. A guess that was P(x) of the start
    // may not stay: seen on the way, for nothing.
    bool const guessed = !anew && !s.solved_once;
    auto const whole = scalar(options_.forcing.goal / 2) * in.gradient_scale;
    scalar const target = anew || whole == scalar(0) ? η * s.reduced_gradient_norm : whole;
    if (anew) restart(s);
    work const before = anew ? work{} : in.work;
    scalar const goal = std::min<scalar>(scalar(0.999), target / in.gradient_scale);
    auto const method = make_(goal > scalar(0) ? goal : scalar(0));
    index const first = in.iteration;
    auto const done = [&] { return in.reduced_gradient_norm <= target; };
    while (in.status == status::running && !done() && in.iteration - first < options_.inner_steps) {
      method.step(in);
      if constexpr (has_refresh<inner_method const, inner_state>) {
        if (done()) method.refresh(in);
      }
      if (!guessed || in.status != status::running) continue;
      look(s);
      family_->assign(s.parameters);
      if (s.status != status::running || in.reduced_gradient_norm <= η * s.reduced_gradient_norm)
        break;
    }
    s.inner_iterations = in.iteration - first;
    s.inner_status = in.status;
    s.work.operator_applications += in.work.operator_applications - before.operator_applications;
    s.work.setup_applications += in.work.setup_applications - before.setup_applications;
    s.work.factorizations += in.work.factorizations - before.factorizations;
    s.work.inner_iterations += s.inner_iterations;
    s.solved_once = true;
    bool const lost = in.status == status::breakdown || in.status == status::unbounded;
    if (lost) s.status = in.status;
    if (!lost && !anew && s.inner_iterations == 0) s.status = status::stalled;
  }

  /// The inner method at s.x for the present parameters. One product.
  void restart(state_type& s) const {
    auto const method = make_(scalar(0.5));
    if constexpr (has_resume_at<inner_method, inner_state, vector_type>) {
      method.resume(s.inner, s.x);
    } else {
      s.inner = method.start(s.x);
    }
  }

  /// Where the residual has more than doubled: no secant step from what is known, or shorter ones.
  void guard(state_type& s, scalar const& before) const {
    if (s.status != status::running) return;
    if (s.reduced_gradient_norm > scalar(2) * before) {
      if (!s.accelerated && s.iteration > 1) s.relaxation /= scalar(2);
      s.mixing.forget();
    }
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience)) {
      s.status = status::stalled;
    }
  }

  Family* family_;
  Make make_;
  options options_;
};

}  // namespace slant
