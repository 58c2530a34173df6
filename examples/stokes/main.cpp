// SPDX-License-Identifier: MIT
//
// Stokes flow past a round obstacle on which the fluid sticks or slips [K §2.2, Example 4], and the
// products of the lecture's Table 4 beside ours.
#include <array>
#include <chrono>
#include <cstdio>
#include <fem/channel_flow.hpp>
#include <fem/stokes_table.hpp>
#include <support/command_line.hpp>
#include <support/text_table.hpp>

#include "channel_mesh.hpp"
#include "methods.hpp"
#include "stokes_output.hpp"

namespace {

struct settings {
  int refinement = 2;
  fem::channel_options channel{};
  std::string method = "newton";
  examples::run_limits limits{.tolerance = 1e-8};
  std::filesystem::path meshes{};  ///< empty: those beside this file
  std::filesystem::path output{};

  [[nodiscard]] std::filesystem::path mesh_folder() const {
    return meshes.empty() ? std::filesystem::path(SLANT_EXAMPLE_MESHES) : meshes;
  }
};

int solve_flow(settings const& s) {
  auto const flow = make_channel_flow(stokes::read_mesh(s.mesh_folder(), s.refinement), s.channel);
  if (!s.output.empty()) examples::make_folder("--output", s.output);

  auto const start = std::chrono::steady_clock::now();
  stokes::flow_problem const problem(flow);
  double const setup =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  auto const mesh = stokes::mesh_file(s.mesh_folder(), s.refinement).filename().string();
  stokes::print_problem(problem, s.channel, mesh, setup);

  auto const run = stokes::run(s.method, problem, s.limits);
  auto const solution = problem.dual().solution(run.dual);
  auto const field = fem::make_wall_field(problem.scene(), solution);
  stokes::print_result(s.method, run, field);
  stokes::print_balance(fem::check_balance(flow, problem.scene(), solution));
  if (!s.output.empty())
    stokes::write_output(s.output, problem.scene(), solution, field, s.channel);
  return run.work.converged() ? examples::succeeded : examples::not_converged;
}

/// "13/200 5.2s"
std::string with_seconds(stokes::flow_run const& run) {
  std::array<char, 32> seconds{};
  std::snprintf(seconds.data(), seconds.size(), " %.2fs", run.seconds);
  return examples::steps_and_products(run.work) + seconds.data();
}

/// Steps/products and seconds of every method beside the printed products.
int print_table(settings const& s) {
  std::printf(
      "Stokes flow with a stick-slip wall [K Table 4]: printed products of the active-set (AS) "
      "and\n"
      "path-following (PF) methods; ours: steps/products and seconds to a relative accuracy of "
      "%g\n\n",
      s.limits.tolerance);
  std::vector<std::string> names{"n_u/n_p/n_c", "g", "AS", "PF"};
  examples::for_each_method(stokes::methods(),
                            [&](auto const& method) { names.push_back(method.name); });
  examples::text_table const table(names);
  table.print_head();
  bool converged = true;
  for (auto const& printed : fem::lecture_table_4) {
    if (printed.refinement > s.refinement) break;
    auto const domain = stokes::read_mesh(s.mesh_folder(), printed.refinement);
    for (std::size_t column = 0; column < fem::lecture_slip_bounds.size(); ++column) {
      double const g = fem::lecture_slip_bounds[column];
      stokes::flow_problem const problem(
          fem::make_channel_flow(domain, {.slip_bound = g, .adhesion = s.channel.adhesion}));
      auto const& scene = problem.scene();
      int const as = printed.active_set[column];
      std::vector<std::string> line{
          std::to_string(scene.velocity_count()) + "/" + std::to_string(scene.pressure_count()) +
              "/" + std::to_string(scene.wall_count()),
          std::to_string(static_cast<int>(g)), as == 0 ? ">200000" : std::to_string(as),
          std::to_string(printed.path_following[column])};
      examples::for_each_method(stokes::methods(), [&](auto const& method) {
        auto const run = stokes::run(method.name, problem, s.limits);
        converged = converged && run.work.converged();
        line.push_back(with_seconds(run));
      });
      table.print_row(line);
    }
  }
  std::printf("\n%s\n", converged ? "all runs converged" : "some runs did not converge");
  return converged ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Stokes flow past an obstacle on which the fluid sticks or slips.",
                             "stokes");
  settings s;
  bool table = false;
  auto const not_negative = [](char const* expectation) {
    return examples::expects<double>(expectation,
                                     [](double x) { return x >= 0 && std::isfinite(x); });
  };
  app.option("--refinement", s.refinement, "mesh 1 to 4; 1 and 2 are shipped",
             examples::expects<int>("a whole number from 1 to 4", [](int k) {
               return k >= 1 && k <= stokes::finest_refinement;
             }));
  app.option("--g", s.channel.slip_bound, "slip bound of the obstacle, a stress",
             not_negative("a finite number >= 0"));
  app.option("--kappa", s.channel.adhesion, "adhesion of the obstacle, a stress per velocity",
             not_negative("a finite number >= 0"));
  app.option("--method", s.method, stokes::method_names(),
             examples::expects<std::string>(stokes::method_names(), [](std::string const& name) {
               return stokes::is_method(name);
             }));
  app.option("--tolerance", s.limits.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.limits.max_iterations, "steps at most",
             examples::expects_at_least(0));
  app.flag("--table", table, "Table 4 up to this refinement, all methods, instead of one flow");
  app.option("--meshes", s.meshes, "folder of channel_1.msh ...; default: beside main.cpp",
             examples::expects_name());
  app.option("--output", s.output, "folder for flow.vtu (ParaView) and the picture flow.png",
             examples::expects_name());
  return app.run(argc, argv, [&] { return table ? print_table(s) : solve_flow(s); });
}
