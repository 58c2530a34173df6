// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction from matrices to displacements, to an accuracy in the energy norm:
//
//     min ½ uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖   subject to   N u ≤ d,     ‖u − u*‖_K ≤ tolerance · ‖u*‖_K
//
//     condense    K factored with the contact unknowns late factorizations/static_condensation
//     scale       rows of B so that every contact is about equally stiff, by powers of two; not at
//                 all where they are already
//     start       conjugate gradients without the constraints       methods/unconstrained_start
//     solve       symmetric_newton on the dual problem, with the lumped preconditioner
//     certify     ‖u − u*‖_K from K and the data alone              contact/certificate
//     correct     where the certificate asks for more: b is replaced by the one whose gradient, as
//                 the method computes it, is the accurate one of the certificate; Newton's method
//                 goes on to a smaller reduced gradient (iterative refinement of the program)
//
// One certificate is all that a well-conditioned scene costs: one solve with K beyond that for u.
//
// Where the layout of the unknowns is known and K is large, K is not factored: the displacements
// are solved for with multigrid (contact/parts/iterated_run.hpp). Which is faster is estimated
// (contact/route.hpp); what gets nowhere one way, or costs far more than that, is tried the other
// way. Bodies that supports do not hold get springs that end where they began.
//
// With factors, for bodies that supports do not hold, so that K is singular: their free motions are
// computed and named (contact/free_motions), and where contact or friction holds them the same
// method solves a few problems with springs that give way (contact/parts/spring_supports), from
// where the load puts the bodies across their gaps. The error is then that in the seminorm ‖·‖_K,
// an estimate. Where nothing holds them the status is `unbounded`, with the motion along which the
// energy falls for ever.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/certificate.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/parts/iterated_run.hpp>
#include <slant/contact/parts/spring_supports.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::contact::detail {

// --- certified run -------------------------------------------------------------------------------

/// Newton's method on the scaled dual problem of bodies that supports hold, under the control of
/// the certificate.
template <class Friction, class S>
class certified_run {
 public:
  using scalar = S;
  using friction_type = Friction;
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  certified_run(Friction law, sparse_type const& K, data<S> const& c, solve_options<S> const& o)
      : options_(o),
        data_(&c),
        factor_(K, contact_unknowns(c), o.condensation),
        dual_(law, factor_, c),
        certificate_(K, c),
        b_(dual_.b()),
        C_(dual_.constraints()) {
    auto const d = o.scale ? row_factors(certificate_.stiffness(), c.nodes(), c.tangents(), false)
                           : vector_type();
    result_.scaled = d.size() > 0;
    d_ = result_.scaled ? d : vector_type::Ones(b_.size());
    b_ = b_.cwiseProduct(d_);
    g_ = c.g;
    if (c.tangents() > 0) {
      for (index i = 0; i < c.nodes(); ++i) g_(i) /= d_(c.nodes() + i * c.tangents());
    }
    if (result_.scaled) C_ = sparse_type(d_.asDiagonal() * C_);
    ++result_.work.factorizations;
    if (o.prove) {
      certificate_.prove(solver(factor_), [&](sparse_type const& matrix) {
        ++result_.work.factorizations;
        static_cast<void>(factorize(matrix));
      });
    }
  }

  /// The same scene with the load and the gaps that the data have now, and with slips T u − w, from
  /// λ.
  void reload(vector_type const& λ, vector_type const& w, S const& tolerance, index max_steps) {
    load_step<S> step{.f = data_->f, .d = data_->d};
    if (w.size() > 0) step.w = w;
    dual_.update(std::move(step));
    certificate_.set_positions(w);
    b_ = dual_.b().cwiseProduct(d_);
    if (λ.size() > 0) options_.start = λ;
    options_.tolerance = tolerance;
    options_.max_steps = max_steps;
    bool const scaled = result_.scaled;
    solves_before_ = certificate_.solves();
    result_ = {};
    result_.scaled = scaled;
  }

  [[nodiscard]] solution<S> solve() {
    auto const set = feasible_set(dual_.friction(), data_->nodes(), g_);
    separable_qp const qp{dual_.a(C_), b_, set};
    auto const M = lumped_preconditioner(certificate_.matrix(), C_);
    vector_type const x0 = start(qp, M);
    // The reduced gradient is some 3 to 10 times smaller than the error that goes with it, and the
    // bound some 2 to 10 times larger. A few products more are less than a second phase.
    S threshold = S(0.02) * options_.tolerance;
    index budget = options_.max_steps;
    auto const method = [&] {
      symmetric_newton_options<S> o;
      o.forcing.goal = static_cast<double>(threshold);
      return symmetric_newton{qp, M, o};
    };
    auto state = method().start(x0);
    image_.resize(b_.size());
    S best = std::numeric_limits<S>::infinity();
    auto wa = workspace(qp.a(), state.x);
    std::optional<
        newton_certificate<std::remove_cvref_t<decltype(qp)>, std::remove_const_t<decltype(M)>>>
        by_newton;
    auto const tell = [&](auto const& now) { tell_progress(options_, now); };
    while (true) {
      auto newton = method();
      auto stop = reduced_gradient_below(threshold) || at_most(budget);
      auto end = slant::detail::run_to_end(newton, state, stop, tell);
      // A later phase that takes longer than all before it is at its floor.
      bool const is_later = budget < options_.max_steps;
      if (is_later && end.how == status::iteration_limit) end.how = status::stalled;
      bool const can_go_on = end.how == status::converged || end.how == status::stalled;
      result_.multipliers = d_.cwiseProduct(state.x);
      result_.u = dual_.displacement(result_.multipliers);
      ++result_.solves;
      result_.error = certificate_(dual_.set(), result_.multipliers, result_.u, options_.tolerance,
                                   solver(factor_));
      S error = result_.error.relative();
      bool is_sharp = false;
      auto const sharpen = [&] {
        if (!(error > options_.tolerance) || is_sharp) return;
        is_sharp = true;
        if (!by_newton) by_newton.emplace(qp, M, certificate_, d_);
        index const before = by_newton->applications();
        result_.error = (*by_newton)(result_.multipliers);
        result_.work.operator_applications += by_newton->applications() - before;
        error = result_.error.relative();
      };
      // The bound is rarely off by more than 30.
      if (!can_go_on || error <= S(64) * options_.tolerance) sharpen();
      bool const progresses = error < best / S(2) || end.how == status::converged;
      bool const goes_on = can_go_on && progresses && result_.corrections < 20;
      if (!goes_on) sharpen();
      bool const is_enough = error <= options_.tolerance && end.how != status::unbounded;
      if (is_enough || !goes_on) {
        finish(end, is_enough);
        break;
      }
      best = std::min<S>(best, error);
      // While nothing is known of the error there is no floor that could have been met.
      budget = slant::detail::is_finite(best)
                   ? std::min<index>(options_.max_steps, 4 * state.iteration + 100)
                   : options_.max_steps;
      // The gradient as the method computes it becomes that of the certificate.
      slant::apply(qp.a(), state.x, image_, wa);
      ++state.work.operator_applications;
      b_ = image_ - d_.cwiseProduct(certificate_.gradient());
      ++result_.corrections;
      S const ask = S(0.3) * options_.tolerance / error;
      S const reached = relative_gradient<S>(state);
      S const factor = ask < S(1e-3) || !(ask == ask) ? S(1e-3) : ask < S(0.3) ? ask : S(0.3);
      threshold = std::min<S>(threshold, reached) * factor;
      newton.resume(state);
    }
    result_.iterations = state.iteration;
    result_.work += state.work;
    result_.solves += certificate_.solves() - solves_before_;
    result_.condition = certificate_.condition();
    result_.factorization = std::string(factor_.name());
    return std::move(result_);
  }

 private:
  template <class QP, class M>
  [[nodiscard]] vector_type start(QP const& qp, M const& m) {
    if (options_.start) {
      slant::detail::check_size("start", options_.start->size(), b_.size());
      slant::detail::check_finite("start", *options_.start);
      return options_.start->cwiseQuotient(d_);
    }
    if (options_.max_steps == 0) return vector_type::Zero(b_.size());
    auto found = unconstrained_start(qp, m);
    result_.work.setup_applications += found.applications;
    return std::move(found.x);
  }

  void finish(slant::detail::ending& end, bool is_enough) {
    auto const known = result_.error.sentence();
    if (is_enough) {
      result_.status = status::converged;
      result_.reason = known + ", at most " + slant::detail::show(options_.tolerance);
      return;
    }
    result_.status = end.how == status::converged ? status::stalled : end.how;
    if (result_.status == status::stalled) {
      result_.reason = known + ": rounding errors allow no more (condition of K about " +
                       slant::detail::brief(certificate_.condition()) + ")";
    } else if (result_.status == status::unbounded) {
      result_.reason =
          "no u satisfies the constraints, so that the contact forces grow without bound";
    } else {
      result_.reason = end.why + "; " + known;
    }
  }

  solve_options<S> options_;
  data<S> const* data_;
  static_condensation<S> factor_;
  dual<Friction, static_condensation<S> const&, S> dual_;
  certificate<S> certificate_;
  vector_type b_;
  sparse_type C_;
  vector_type d_{}, g_{}, image_{};
  solution<S> result_{};
  index solves_before_ = 0;
};

}  // namespace slant::contact::detail

namespace slant::contact {

// --- solve ---------------------------------------------------------------------------------------

/// Solves with this friction law, which the data must have: no other one is compiled. Throws
/// bad_input if K is not symmetric positive semidefinite, for data that do not fit, or for options
/// out of range.
template <class Friction, class S>
[[nodiscard]] solution<S> solve(Friction friction, Eigen::SparseMatrix<S> const& K,
                                data<S> const& c, solve_options<S> const& o = {}) {
  using run = detail::certified_run<Friction, S>;
  o.validate();
  detail::validated(friction, c, K.rows());
  if (auto const U = detail::row_units(c); U.size() > 0) {
    auto own = o;
    if (o.start) {
      slant::detail::check_size("start", o.start->size(), U.size());
      slant::detail::check_finite("start", *o.start);
      own.start = detail::kept_finite<S>(o.start->cwiseQuotient(U), *o.start);
    }
    auto found = solve(friction, K, detail::with_units(c, U), own);
    found.multipliers = found.multipliers.cwiseProduct(U);
    found.scaled = true;
    return found;
  }
  bool const asked = o.route == solution_route::iterate;
  auto outlook = o.prove ? detail::iteration_outlook<S>{"the proof of a bound takes factors"}
                         : detail::outlook_of_iteration(K, c, o);
  if (o.start && !asked && !outlook.refusal) outlook.refusal = "forces to start from are given";
  route_choice choice = choose_route(K, outlook.refusal, o.route, o.costs);
  detail::route_budget<S> budget(K, choice, o.costs);
  auto const iterate = [&] {
    return detail::iterated_run(friction, K, c, outlook.floating, o, budget);
  };
  bool const automatic = o.route == solution_route::automatic;
  bool const can_follow = automatic && outlook.is_possible && o.tolerance > S(0) && o.max_steps > 0;
  // Multigrid takes K for definite where neither coordinates nor factors have told.
  bool may_iterate = can_follow && o.layout.is_known();
  auto const factor = [&] {
    free_motions<S> motions;
    try {
      run supported(friction, K, c, o);
      may_iterate = can_follow;
      return supported.solve();
    } catch (bad_input const& refusal) {
      motions = motions_behind(refusal, K, o.layout);
      if (motions.free.empty()) throw;
    }
    may_iterate = may_iterate && !outlook.floating.free.empty();
    return detail::spring_supports<run>(friction, K, c, o, std::move(motions)).run();
  };
  auto found = choice.route == solution_route::iterate
                   ? detail::by_routes(
                         choice, automatic, iterate,
                         [&] { return detail::factored_after(choice, budget, factor, iterate); })
                   : detail::by_routes(choice, may_iterate, factor,
                                       [&] { return detail::unless_refused(iterate); });
  found.choice = std::move(choice);
  return found;
}

/// The same with the law that T stands for, one instance for all laws.
template <class S>
[[nodiscard]] solution<S> solve(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                                solve_options<S> const& o = {}) {
  c.validate();
  return solve(friction_of_data{c.tangents()}, K, c, o);
}

#if SLANT_USES_COMPILED
/// A named law: what is compiled is the instance for all of them.
template <class Friction>
  requires(!std::same_as<Friction, friction_of_data>)
[[nodiscard]] solution<double> solve(Friction friction, Eigen::SparseMatrix<double> const& K,
                                     data<double> const& c, solve_options<double> const& o = {}) {
  return solve(friction_of_data{friction.tangents}, K, c, o);
}

extern template solution<double> solve<friction_of_data, double>(friction_of_data,
                                                                 Eigen::SparseMatrix<double> const&,
                                                                 data<double> const&,
                                                                 solve_options<double> const&);
extern template solution<double> solve<double>(Eigen::SparseMatrix<double> const&,
                                               data<double> const&, solve_options<double> const&);
#endif

}  // namespace slant::contact
