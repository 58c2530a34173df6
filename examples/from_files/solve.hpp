// SPDX-License-Identifier: MIT
//
// From the problem of a folder to its solution, with the time and the work that it took.
#pragma once

#include <functional>
#include <limits>
#include <slant/contact/certificate.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/factorize.hpp>
#include <string>
#include <utility>

#include "any_dual.hpp"
#include "methods.hpp"
#include "problem_folder.hpp"
#include "solution.hpp"

namespace from_files {

namespace detail {

/// solve(b, x) of any factorisation of K.
using solve_with_K = std::function<void(Eigen::VectorXd const&, Eigen::VectorXd&)>;

/// What it means for u that the dual problem has no minimum.
[[nodiscard]] inline std::string contradiction(slant::contact::data<double> const& c) {
  bool const sticks = (c.g.array() == std::numeric_limits<double>::infinity()).any();
  return std::string("no u satisfies N u <= d") + (sticks ? " and T u = 0 where g is inf" : "") +
         ", so the multipliers grow without bound";
}

/// λ = 0, or where the first method ends; its outcome then.
[[nodiscard]] inline outcome find_start(problem const& p, any_dual const& dual, settings const& s) {
  settings rough = s;
  rough.tolerance = 0.1;
  rough.stops_early = true;
  if (s.start == start_point::qpc) {
    return run_on_dual(slant::qpc{dual.qp()}, dual.zero(), rough);
  }
  if (s.start == start_point::interior_point) {
    return run_interior_point(p, dual, dual.zero(), rough);
  }
  return {.status = slant::status::converged,
          .reason = {},
          .iterations = 0,
          .work = {},
          .started = clock::now(),
          .λ = dual.zero()};
}

/// Is there no point in going on from where a run has ended?
[[nodiscard]] inline bool hopeless(slant::status s) {
  return s == slant::status::unbounded || s == slant::status::breakdown;
}

inline void add_work(outcome const& first, outcome& run) {
  run.work.operator_applications += first.work.operator_applications;
  run.work.setup_applications += first.work.setup_applications;
}

/// The dual problem for the law that T stands for.
template <class Factor>
[[nodiscard]] auto dual_of(problem const& p, Factor const& factor) {
  return slant::contact::dual<slant::contact::friction_of_data, Factor const&, double>(
      slant::contact::friction_of_data(p.contact.tangents()), factor, p.contact);
}

/// By contact::solve, from its own start or from that of another method.
[[nodiscard]] inline solution solve_recommended(problem const& p, settings const& s) {
  auto const begin = clock::now();
  slant::contact::solve_options<double> o{
      .tolerance = s.tolerance, .prove = s.prove, .max_steps = s.max_iterations};
  o.layout = s.layout;
  solution result;
  outcome start{.status = slant::status::converged,
                .reason = {},
                .iterations = 0,
                .work = {},
                .started = begin,
                .λ = {}};
  if (s.start == start_point::zero) {
    o.start = Eigen::VectorXd::Zero(p.contact.N.rows() + p.contact.T.rows()).eval();
  } else if (s.start != start_point::automatic) {
    auto const factor = slant::factorize(p.K);
    auto const given = dual_of(p, factor);
    auto const qp = given.qp();
    start = find_start(p, any_dual(given, qp), s);
    o.start = start.λ;
    if (hopeless(start.status)) o.max_steps = 0;
  }
  clock::time_point started{};
  o.progress = [&](auto const& step) {
    if (step.iteration == 0) started = clock::now();
  };
  auto found = slant::contact::solve(p.K, p.contact, o);
  result.run = {.status = found.status,
                .reason = std::move(found.reason),
                .iterations = found.iterations,
                .work = found.work,
                .started = started,
                .λ = std::move(found.multipliers)};
  if (hopeless(start.status)) result.run.status = start.status;
  add_work(start, result.run);
  result.u = std::move(found.u);
  result.error = found.error;
  result.condition = found.condition;
  result.factorization = std::move(found.factorization);
  result.motions = std::move(found.motions);
  if (!result.motions.free.empty()) result.solved_by = "proximal_point";
  result.take_times(begin);
  return result;
}

/// By a method for the dual problem, judged by the same certificate.
[[nodiscard]] inline solution solve_dual(problem const& p, any_dual const& dual,
                                         slant::contact::certificate<double>& error_of,
                                         solve_with_K const& solve, named_method const& method,
                                         settings s) {
  Eigen::VectorXd λ, u;
  auto const M = slant::contact::lumped_preconditioner(p.K, dual.constraints());
  slant::contact::newton_certificate by_newton(dual.qp(), M, error_of);
  s.error_of = [&](Eigen::VectorXd const& forces) {
    λ = forces;
    u = dual.displacement(slant::project(dual.set(), λ));
    auto const error = error_of(dual.set(), λ, u, s.tolerance, solve);
    return error.relative() > s.tolerance ? by_newton(λ) : error;
  };
  solution result;
  result.run = find_start(p, dual, s);
  if (!hopeless(result.run.status)) {
    outcome const start = std::move(result.run);
    result.run = method.run(p, dual, start.λ, s);
    add_work(start, result.run);
  }
  result.error = s.error_of(result.run.λ);
  result.run.work.operator_applications += by_newton.applications();
  result.u = u;
  result.run.λ = λ;
  // Whatever a method says of itself: the certificate is right.
  bool const is_accurate = result.error.relative() <= s.tolerance;
  if (result.converged() && !is_accurate) {
    result.run.status = slant::status::stalled;
    result.run.reason = result.error.sentence();
  } else if (result.run.status == slant::status::stalled) {
    result.run.reason += "; " + result.error.sentence();
  }
  return result;
}

[[nodiscard]] inline solution solve_by(named_method const& method, problem const& p,
                                       settings const& s) {
  auto const begin = clock::now();
  auto const factor = slant::factorize(p.K);
  slant::contact::certificate<double> error_of(p.K, p.contact);
  solve_with_K const solve = slant::contact::solver(factor);
  if (s.prove) error_of.prove(solve, [](auto const& K) { (void)slant::factorize(K); });
  auto const given = dual_of(p, factor);
  auto const qp = given.qp();
  solution result = solve_dual(p, any_dual(given, qp), error_of, solve, method, s);
  result.condition = error_of.condition();
  result.take_times(begin);
  result.factorization = factor.name();
  return result;
}

}  // namespace detail

/// Solves with that method. The friction law is that of T. Throws slant::bad_input if K is not
/// symmetric positive definite (naming the entry or the pivot; the recommended method takes a K
/// that is singular by free motions).
[[nodiscard]] inline solution solve(problem const& p, named_method const& method,
                                    settings const& s) {
  solution result =
      method.run == nullptr ? detail::solve_recommended(p, s) : detail::solve_by(method, p, s);
  if (result.run.status == slant::status::unbounded && result.motions.free.empty()) {
    result.run.reason = detail::contradiction(p.contact);
  }
  result.kkt_residual =
      slant::contact::check_optimality(p.K, p.contact, result.u, result.run.λ).residual();
  return result;
}

}  // namespace from_files
