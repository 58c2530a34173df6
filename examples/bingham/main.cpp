// SPDX-License-Identifier: MIT
//
// Bingham flow in a round pipe: on finer and finer meshes, and for yield stresses up to those at
// which nothing flows, beside the closed form of Buckingham and Reiner.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <support/command_line.hpp>

#include "pipe.hpp"

namespace {

bool print_row(bingham::fluid const& p, int rings, double tolerance) {
  auto const d = bingham::discretised(p, rings);
  auto const flow = bingham::solve(d, tolerance);
  double error = 0;
  for (Eigen::Index i = 0; i < flow.u.size(); ++i) {
    double const exact = bingham::velocity(p, d.nodes.col(i).norm());
    error = std::max(error, std::abs(flow.u[i] - exact));
  }
  std::printf("%5g  %5d  %8td  %9.6f %9.6f  %6.3f %6.3f  %8.1e  %8.1e  %5td  %8td  %s\n", p.g,
              rings, d.areas.size(), flow.rate, bingham::flow_rate(p), flow.plug_radius,
              bingham::plug_radius(p), error, flow.energy_error, flow.steps, flow.products,
              slant::to_string(flow.status).data());
  return flow.status == slant::status::converged;
}

int show(double g, double tolerance) {
  std::printf("Bingham flow in a pipe: radius 1, viscosity 1, pressure gradient 1\n\n");
  std::printf("                           flow rate           plug radius  velocity    energy\n");
  std::printf(
      "    g  rings  triangles      ours     exact    ours  exact     error     error  "
      "steps  products  status\n");
  bool good = true;
  for (int const rings : {4, 8, 16, 32}) good = print_row({.g = g}, rings, tolerance) && good;
  for (double const other : {0.0, 0.1, 0.3, 0.45, 0.5, 0.6}) {
    good = print_row({.g = other}, 16, tolerance) && good;
  }
  return good ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Flow of a Bingham fluid in a pipe beside its closed form.",
                             "bingham");
  double g = 0.25, tolerance = 1e-8;
  app.option("--yield", g, "yield stress of the runs on four meshes",
             examples::expects<double>("a number >= 0", [](double x) { return x >= 0; }));
  app.option("--tolerance", tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  return app.run(argc, argv, [&] { return show(g, tolerance); });
}
