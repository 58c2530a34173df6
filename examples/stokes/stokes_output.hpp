// SPDX-License-Identifier: MIT
//
// What the program stokes shows: problem, result, proof, files.
#pragma once

#include <sys/resource.h>

#include <cstdio>
#include <fem/plots/flow_plot.hpp>
#include <fem/stokes_balance.hpp>
#include <fem/stokes_vtu.hpp>
#include <filesystem>
#include <slant/concepts/linear_operator.hpp>
#include <string>
#include <string_view>

#include "methods.hpp"

namespace stokes {

/// Largest memory that this process has used so far, in MB.
[[nodiscard]] inline double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

inline void print_problem(flow_problem const& problem, fem::channel_options const& options,
                          std::string_view mesh, double setup_seconds) {
  auto const& scene = problem.scene();
  std::printf("Stokes flow in a channel with a round obstacle on which the fluid may slip\n");
  std::printf("  mesh           %.*s, %td triangles\n", static_cast<int>(mesh.size()), mesh.data(),
              scene.mesh.cell_count());
  std::printf("  wall           slip bound g = %g, adhesion kappa = %g\n", options.slip_bound,
              options.adhesion);
  std::printf("  unknowns       %td velocities, %td pressures, %td wall nodes\n",
              scene.velocity_count(), scene.pressure_count(), scene.wall_count());
  std::printf("  dual problem   %td unknowns, %td of them bounded\n", problem.dual().b().size(),
              scene.wall_count());
  std::printf("  factorisation  %s, %.3f seconds set-up\n\n", problem.factor().name().data(),
              setup_seconds);
  std::fflush(stdout);
}

inline void print_result(std::string_view method, flow_run const& run,
                         fem::wall_field const& field) {
  std::printf("Result\n");
  std::printf("  method         %.*s\n", static_cast<int>(method.size()), method.data());
  std::printf("  status         %s", slant::to_string(run.work.status).data());
  if (!run.work.converged()) std::printf(": %s", run.reason.c_str());
  std::printf("\n  accuracy       %.1e, relative norm of the reduced gradient\n", run.accuracy);
  std::printf("  steps          %td\n", run.work.steps);
  std::printf("  products       %td, and %td to prepare\n", run.work.products, run.work.setup);
  std::printf("  seconds        %.3f\n", run.seconds);
  std::printf("  memory         %.0f MB\n", peak_memory());
  std::printf("  wall nodes     %td stick, %td slip\n", field.count(fem::wall_state::stick),
              field.count(fem::wall_state::slip));
  std::printf("  shear stress   from %.4g to %.4g; fastest slip %.4g\n\n", field.shear.minCoeff(),
              field.shear.maxCoeff(), field.along.cwiseAbs().maxCoeff());
}

inline void print_balance(fem::stokes_balance const& b) {
  std::printf("Is it a solution? (relative violations)\n");
  std::printf("  momentum       A u + C'lambda = l               %.1e\n", b.momentum);
  std::printf("  mass           B u - E p = c                    %.1e\n", b.mass);
  std::printf("  wall           u_n = 0                          %.1e\n", b.penetration);
  std::printf("                 |sigma_t + kappa u_t| <= g       %.1e\n", b.above_bound);
  std::printf("                 stick or slip                    %.1e\n", b.wrong_slip);
  std::printf("  flow           in %.10g, out %.10g\n", b.inflow, b.outflow);
}

/// flow.vtu and flow.png; a picture that cannot be drawn costs one line.
inline void write_output(std::filesystem::path const& folder, fem::stokes_scene const& scene,
                         fem::stokes_solution const& solution, fem::wall_field const& field,
                         fem::channel_options const& options) {
  if (!solution.u.allFinite() || !solution.p.allFinite()) {
    std::printf("\nno files: the velocity is not finite\n");
    return;
  }
  auto const vtu = folder / "flow.vtu";
  fem::write_stokes_vtu(vtu, scene, solution, field);
  std::printf("\nwrote %s\n", vtu.c_str());
  char title[100];
  std::snprintf(title, sizeof title, "Flow past an obstacle, slip bound g = %g, adhesion κ = %g",
                options.slip_bound, options.adhesion);
  auto const picture =
      fem::flow_plot(folder / "flow.png", scene, solution, field, {{-0.2, -0.2}, {2, 0.2}},
                     {{-0.13, -0.13}, {0.13, 0.13}}, title);
  std::printf("%s\n", picture.message.c_str());
}

}  // namespace stokes
