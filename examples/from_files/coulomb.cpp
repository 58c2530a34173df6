// SPDX-License-Identifier: MIT
#include "coulomb.hpp"

#include <limits>
#include <slant/contact/optimality.hpp>
#include <slant/contact/solve_coulomb.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <slant/operators/identity.hpp>
#include <utility>

namespace from_files {

namespace {

namespace contact = slant::contact;

/// A run, and the name of the method that its answer comes from.
struct coulomb_outcome {
  outcome run;
  std::string solved_by;
};

/// By the default of the library, or one of its parts.
template <class Dual>
[[nodiscard]] coulomb_outcome run_library(Dual& problem, Eigen::VectorXd const& F,
                                          coulomb_kind kind, coulomb_settings const& s) {
  contact::solve_coulomb_options o;
  // 0: as far as rounding lets it get.
  o.tolerance = s.tolerance > 0 ? s.tolerance : std::numeric_limits<double>::min();
  if (s.max_iterations) o.newton_steps = o.outer_steps = *s.max_iterations;
  if (kind == coulomb_kind::newton) o.outer_steps = 0;
  if (kind == coulomb_kind::radii) o.newton_steps = 0;
  auto const started = clock::now();
  auto r = contact::solve_coulomb(problem, F, o);
  return {.run = {.status = r.status,
                  .reason = std::move(r.reason),
                  .iterations = r.steps,
                  .work = r.work,
                  .started = started,
                  .λ = std::move(r.λ)},
          .solved_by = r.method == "Newton" ? "newton" : "radii"};
}

template <class Dual>
[[nodiscard]] coulomb_outcome run_cones(Dual& problem, Eigen::VectorXd const& F,
                                        coulomb_settings const& s) {
  contact::coulomb_cones family(problem, F);
  auto const start = slant::unconstrained_start(family.qp());
  slant::identity_operator const I(problem.b().size());
  slant::index const most = s.max_iterations.value_or(contact::solve_coulomb_options{}.outer_steps);
  auto run = run_until(contact::coulomb(family, I, {.goal = s.tolerance}), start.x,
                       slant::reduced_gradient_below(s.tolerance),
                       {.tolerance = s.tolerance, .max_iterations = most},
                       [&](auto const& x) { return family.by_directions(x); });
  run.work.setup_applications += start.applications;
  return {std::move(run), "cones"};
}

template <class Friction>
[[nodiscard]] solution solve_with(Friction friction, coulomb_problem const& p, coulomb_kind kind,
                                  coulomb_settings const& s) {
  auto const begin = clock::now();
  auto const factor = slant::factorize(p.body.K);
  contact::dual problem(friction, factor, p.body.contact);
  auto came =
      kind == coulomb_kind::cones ? run_cones(problem, p.F, s) : run_library(problem, p.F, kind, s);
  solution result;
  result.run = std::move(came.run);
  result.solved_by = std::move(came.solved_by);
  result.u = problem.displacement(result.run.λ);
  result.take_times(begin);
  result.factorization = factor.name();
  auto law = p.body.contact;
  law.g = p.F.cwiseProduct(result.run.λ.head(p.F.size()).cwiseMax(0));
  bool const is_number = result.run.λ.allFinite();
  if (!is_number) law.g.setZero();  // the residual is no number either
  result.kkt_residual = contact::check_optimality(p.body.K, law, result.u, result.run.λ).residual();
  return result;
}

}  // namespace

solution solve_coulomb(coulomb_problem const& p, coulomb_kind kind, coulomb_settings const& s) {
  return p.body.contact.tangents() == 1 ? solve_with(contact::friction_line{}, p, kind, s)
                                        : solve_with(contact::friction_disc{}, p, kind, s);
}

}  // namespace from_files
