// SPDX-License-Identifier: MIT
//
// The steel brick of [T §4.2, K Ex 3] in frictional contact with a rigid foundation, by the
// symmetric Newton method on the dual problem; with --refine on a fine mesh by contact::solve with
// multigrid, where a factorisation would take most of the time or not fit.
#include <unistd.h>

#include <chrono>
#include <fem/steel_brick.hpp>
#include <iostream>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <support/command_line.hpp>

#include "brick_output.hpp"

namespace {

struct settings {
  int k = 6;
  std::optional<int> refined{};  ///< k of the mesh for multigrid
  std::string load = "lift";
  double tolerance = 1e-10;
  slant::index max_iterations = 1000;
  std::filesystem::path output{};
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int solve_brick(settings const& s) {
  auto const load = fem::brick_load_named(s.load).value();
  auto const scene = fem::make_steel_brick({.k = s.k, .load = load});
  if (!s.output.empty()) examples::make_folder("--output", s.output);

  auto const begin = std::chrono::steady_clock::now();
  slant::contact::data<double> const contact{scene.N, scene.T, scene.f, scene.d, scene.g};
  slant::static_condensation const factor(scene.K, slant::contact::contact_unknowns(contact));
  slant::contact::dual const dual(slant::contact::friction_disc{}, factor, contact);
  double const setup_seconds = seconds_since(begin);
  brick::print_problem(scene, load, factor.name());

  auto const accuracy = [](auto const& state) {
    return fem::history_point{.products = static_cast<double>(state.work.operator_applications),
                              .residual = state.reduced_gradient_norm / state.gradient_scale};
  };
  slant::history<decltype(accuracy), fem::history_point> history(accuracy);
  auto const start = std::chrono::steady_clock::now();
  auto const report = [&] {
    slant::progress_bar bar("newton", s.tolerance,
                            {.enabled = isatty(STDERR_FILENO) != 0, .every = 1});
    slant::symmetric_newton_options<double> options;
    options.forcing.goal = s.tolerance;
    auto const M = slant::contact::lumped_preconditioner(scene.K, dual.constraints());
    auto const qp = dual.qp();
    return slant::solve(
        slant::symmetric_newton{qp, M, options}, slant::unconstrained_start(qp, M).x,
        slant::reduced_gradient_below(s.tolerance) || slant::at_most(s.max_iterations), history,
        bar);
  }();
  Eigen::VectorXd const& λ = report.x();
  Eigen::VectorXd const u = dual.displacement(λ);
  double const solve_seconds = seconds_since(start);

  Eigen::Index const m = scene.contact_count();
  auto const field = fem::make_contact_field(scene, u, λ.head(m), λ.tail(2 * m));
  brick::print_result(report, setup_seconds, solve_seconds, field, scene.displacement(u));
  brick::print_optimality(slant::contact::check_optimality(scene.K, contact, u, λ));
  if (!s.output.empty()) brick::write_output(s.output, scene, field, u, {s.load, history.values()});
  return report.converged() ? examples::succeeded : examples::not_converged;
}

/// To a relative energy error of `tolerance`.
int solve_refined(settings const& s) {
  auto const load = fem::brick_load_named(s.load).value();
  auto const scene = fem::make_steel_brick({.k = *s.refined, .load = load});
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  slant::contact::data<double> const contact{scene.N, scene.T, scene.f, scene.d, scene.g};
  brick::print_problem(scene, load, "none: multigrid");

  auto const begin = std::chrono::steady_clock::now();
  slant::contact::solve_options<double> options{.tolerance = s.tolerance,
                                                .max_steps = s.max_iterations};
  options.layout = slant::contact::layout_of(scene.mesh.nodes, scene.unknowns.first);
  options.route = slant::contact::solution_route::iterate;
  auto const run = slant::contact::solve(scene.K, contact, options);
  double const seconds = seconds_since(begin);

  Eigen::Index const m = scene.contact_count();
  auto const field =
      fem::make_contact_field(scene, run.u, run.multipliers.head(m), run.multipliers.tail(2 * m));
  std::cout << run << "  levels                 " << run.factorization << "\n"
            << "  seconds                " << seconds << "\n";
  brick::print_field(field, scene.displacement(run.u));
  brick::print_optimality(
      slant::contact::check_optimality(scene.K, contact, run.u, run.multipliers));
  if (!s.output.empty()) brick::write_output(s.output, scene, field, run.u, {s.load, {}});
  return run.converged() ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("A steel brick with Tresca friction on a rigid foundation.", "brick");
  settings s;
  app.option("--load", s.load, "press, pull or lift",
             examples::expects_one_of({"press", "pull", "lift"}));
  app.option("--cells", s.k, "k of the 3k x k x k cells", examples::expects_at_least(1));
  app.option("--refine", s.refined, "k of a fine mesh: multigrid, without factors",
             examples::expects_at_least(1));
  app.option("--tolerance", s.tolerance,
             "relative norm of the reduced gradient; with --refine relative energy error",
             examples::expects_tolerance());
  app.option("--max-iterations", s.max_iterations, "steps at most", examples::expects_at_least(0));
  app.option("--output", s.output,
             "folder for brick.vtu (ParaView) and the pictures contact.png and history.png",
             examples::expects_name());
  return app.run(argc, argv, [&] { return s.refined ? solve_refined(s) : solve_brick(s); });
}
