// SPDX-License-Identifier: MIT
#include <slant/contact/solve.hpp>
#include <slant/slant.hpp>

#include <stability/methods.hpp>
#include <stability/stopping.hpp>

namespace stability {

namespace {

auto preconditioner(prepared const& p) {
  return slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.approximate_inverse());
}

auto options(request const& r) {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = r.tolerance;
  return o;
}

Eigen::VectorXd same(Eigen::VectorXd const& x) {
  return x;
}

outcome plain(prepared const& p, request const& r) {
  return run_until(slant::symmetric_newton{p.qp(), options(r)}, p.start(r.start), p, r, same);
}

outcome preconditioned(prepared const& p, request const& r) {
  return run_until(slant::symmetric_newton{p.qp(), preconditioner(p), options(r)}, p.start(r.start),
                   p, r, same);
}

outcome in_equal_units(prepared const& p, request const& r) {
  auto const qp = p.qp();
  Eigen::VectorXd const diagonal = p.dense().diagonal();
  slant::equilibrated const scaled(qp, slant::block_factors(p.set(), diagonal));
  return run_until(slant::symmetric_newton{scaled.qp(), options(r)}, scaled.from(p.start(r.start)),
                   p, r, [&](Eigen::VectorXd const& y) { return Eigen::VectorXd(scaled.back(y)); });
}

outcome inside(prepared const& p, request const& r) {
  return run_until(slant::interior_point{p.qp(), preconditioner(p)}, p.start(r.start), p, r, same);
}

/// slant::solve, which chooses for itself; limits of applications do not reach it.
outcome program_door(prepared const& p, request const& r) {
  auto const found = slant::solve(p.qp(), r.tolerance, r.steps);
  outcome o;
  o.status = found.status;
  o.reason = found.reason;
  o.iterations = found.iterations();
  o.applications = found.work.operator_applications;
  o.x = found.x();
  o.claimed = found.error.relative();
  return o;
}

outcome contact_run(prepared const& p, slant::contact::solve_options<double> const& options) {
  auto const found =
      slant::contact::solve(slant::contact::friction_disc{}, p.source().K, p.contact(), options);
  outcome o;
  o.status = found.status;
  o.reason = found.reason;
  o.iterations = found.iterations;
  o.applications = found.work.operator_applications;
  o.x = found.multipliers;
  if (found.choice.route == slant::contact::solution_route::iterate) o.u = found.u;
  o.claimed = found.error.relative();
  return o;
}

outcome contact_door(prepared const& p, request const& r) {
  slant::contact::solve_options<double> options{.tolerance = r.tolerance, .max_steps = r.steps};
  if (r.start != start_point::zero) options.start = p.start(r.start);
  return contact_run(p, options);
}

/// Without factors, on levels as small as those of large problems; starts are not for
/// displacements.
outcome contact_levels(prepared const& p, request const& r) {
  return contact_run(p, {.tolerance = r.tolerance,
                         .max_steps = r.steps,
                         .layout = slant::contact::layout_of(p.source().nodes, p.source().first),
                         .route = slant::contact::solution_route::iterate,
                         .multigrid = {.coarsest = 40}});
}

}  // namespace

std::span<method const> newton_methods() {
  static constexpr method list[]{
      {"symmetric_newton", preconditioned},
      {"symmetric_newton_plain", plain},
      {"symmetric_newton_equilibrated", in_equal_units},
      {"interior_point", inside},
      {"solve", program_door, scope::dense},
      {"contact_solve", contact_door, scope::contact},
      {"contact_solve_iterated", contact_levels, scope::contact},
  };
  return list;
}

}  // namespace stability
