// SPDX-License-Identifier: MIT
//
// What the program brick shows: problem, result, proof, files.
#pragma once

#include <algorithm>
#include <cstdio>
#include <fem/contact_field.hpp>
#include <fem/contact_vtu.hpp>
#include <fem/plots/contact_plot.hpp>
#include <fem/plots/history_plot.hpp>
#include <fem/steel_brick.hpp>
#include <filesystem>
#include <slant/base/report.hpp>
#include <slant/contact/optimality.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brick {

inline void print_problem(fem::contact_scene<3> const& scene, fem::brick_load load,
                          std::string_view factorization) {
  auto const loading = fem::loading_of(load);
  fem::steel_brick_options const defaults;
  std::printf("Steel brick on a rigid foundation, load \"%s\"\n", fem::name_of(load).data());
  std::printf("  body           3 x 1 x 1, E = %g MPa, nu = %g; fixed at x = 0, contact on z = 0\n",
              defaults.E, defaults.nu);
  for (auto const& side : loading.tractions)
    std::printf("  traction       (%g, %g, %g) MPa on the %s\n", side.traction[0], side.traction[1],
                side.traction[2], side.side.axis == 2 ? "top" : "right end");
  std::printf("  slip bound     %g MPa (Tresca)\n", loading.slip_bound);
  std::printf("  mesh           %td tetrahedra, %td unknowns\n", scene.mesh.cell_count(),
              scene.unknowns.count);
  std::printf("  contact        %td nodes: %td multipliers in %td half lines and %td discs\n",
              scene.contact_count(), 3 * scene.contact_count(), scene.contact_count(),
              scene.contact_count());
  std::printf("  factorisation  %.*s\n\n", static_cast<int>(factorization.size()),
              factorization.data());
  std::fflush(stdout);
}

/// States of the contact nodes, and what is largest.
inline void print_field(fem::contact_field<3> const& field, Eigen::Matrix3Xd const& displacement) {
  std::printf("  contact nodes  %td open, %td stick, %td slip\n",
              field.count(fem::contact_state::open), field.count(fem::contact_state::stick),
              field.count(fem::contact_state::slip));
  std::printf("  largest        pressure %.4g MPa, friction %.4g MPa, displacement %.4g\n\n",
              field.normal.maxCoeff(), field.friction.colwise().norm().maxCoeff(),
              displacement.colwise().norm().maxCoeff());
}

template <class State>
void print_result(slant::report<State> const& report, double setup_seconds, double solve_seconds,
                  fem::contact_field<3> const& field, Eigen::Matrix3Xd const& displacement) {
  auto const& work = report.state.work;
  std::printf("Result\n");
  std::printf("  status         %s", slant::to_string(report.status).data());
  if (!report.converged()) std::printf(": %s", report.reason.c_str());
  std::printf("\n  accuracy       %.1e, relative norm of the reduced gradient\n",
              report.state.reduced_gradient_norm / report.state.gradient_scale);
  std::printf("  steps          %td\n", report.iterations());
  std::printf("  products       %td, and %td for the step length\n", work.operator_applications,
              work.setup_applications);
  std::printf("  seconds        %.3f set-up, %.3f solve\n", setup_seconds, solve_seconds);
  print_field(field, displacement);
}

inline void print_optimality(slant::contact::optimality<double> const& o) {
  std::printf("Optimality conditions (relative violations)\n");
  std::printf("  equilibrium    K u + B'lambda = f               %.1e\n", o.equilibrium);
  std::printf("  contact        pressure >= 0, gap >= 0, one 0   %.1e\n", o.normal);
  std::printf("  friction       Tresca's law                     %.1e\n", o.friction);
  std::printf("  largest node   penetration                      %.1e\n", o.penetration);
  std::printf("                 tension                          %.1e\n", o.adhesion);
  std::printf("                 friction above its bound         %.1e\n", o.cone);
  std::printf("  residual       the largest of the first three   %.1e\n", o.residual());
}

/// The course of the iteration, for a picture.
struct named_history {
  std::string label;
  std::vector<fem::history_point> points;
};

/// brick.vtu, contact.png, history.png; a picture that cannot be drawn costs one line.
inline void write_output(std::filesystem::path const& folder, fem::contact_scene<3> const& scene,
                         fem::contact_field<3> const& field, Eigen::VectorXd const& u,
                         named_history history) {
  if (!u.allFinite()) {
    std::printf("\nno files: the displacement is not finite\n");
    return;
  }
  std::printf("\n");
  auto const vtu = folder / "brick.vtu";
  fem::write_contact_vtu(vtu, scene, field, u);
  std::printf("wrote %s\n", vtu.c_str());
  std::string const title = "Steel brick, load \"" + history.label + "\"";
  auto const contact = fem::contact_plot(folder / "contact.png", field, {.title = title});
  std::printf("%s\n", contact.message.c_str());
  // The other picture would fail for the same reason.
  if (!contact.written || history.points.empty()) return;
  std::vector<fem::history_series> series;
  series.push_back({history.label, std::move(history.points)});
  auto const course = fem::history_plot(
      folder / "history.png", series,
      {.title = title + ": Newton steps", .vertical = "relative reduced gradient"});
  std::printf("%s\n", course.message.c_str());
}

}  // namespace brick
