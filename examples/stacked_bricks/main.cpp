// SPDX-License-Identifier: MIT
//
// A stack of floating bricks in a corner, held by contact alone, by the Schur complement algorithm
// [D]: a load that holds it, one that lifts it, one that tips it over.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fem/stacked_bricks.hpp>
#include <filesystem>
#include <slant/contact/bodies.hpp>
#include <slant/io/vtu.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/schur_contact.hpp>
#include <string>
#include <support/command_line.hpp>

namespace {

struct settings {
  int bricks = 3;
  int k = 4;
  double gap = 1e-5;
  std::string load = "hold";
  double tolerance = 1e-10;
  slant::index max_iterations = 5000;
  std::filesystem::path output{};
};

Eigen::Vector2d pressure_on_top(std::string const& load) {
  if (load == "lift") return {-1, -1};
  if (load == "tip") return {1.5, -1.2};
  return {1.5, -0.4};
}

/// stack.vtu: displacements, or the direction in which the stack goes away, and the forces of the
/// contact nodes.
void write_stack(std::filesystem::path const& file, fem::stack_scene const& scene,
                 Eigen::VectorXd const& u, Eigen::VectorXd const& λ) {
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, scene.mesh.node_count());
  for (Eigen::Index i = 0; i < λ.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    force(scene.axes[at], scene.nodes[at]) = λ[i];
  }
  slant::vtu_grid grid(scene.mesh.nodes, slant::vtu_encoding::base64);
  grid.add_cells(slant::vtu_cell::tetrahedron, scene.mesh.cells);
  grid.add_point_vectors("displacement", fem::nodal_displacement<3>(scene.unknowns, u));
  grid.add_point_vectors("contact_force", force);
  grid.write(file);
  std::printf("\nwrote %s\n", file.c_str());
}

int solve_stack(settings const& s) {
  auto const top = pressure_on_top(s.load);
  auto const scene =
      fem::make_stack({.bricks = s.bricks, .cells = {2 * s.k, s.k, s.k}, .top = top, .gap = s.gap});
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  std::printf("%d bricks of 2 x 1 x 1 in a corner, load \"%s\"\n", s.bricks, s.load.c_str());
  std::printf("  pressure       %g at x = 0 to %g at x = 2 MPa on top, 0.3 MPa towards the walls\n",
              top[0], top[1]);
  std::printf("  unknowns       %td\n  constraints    %td, gap %g\n", scene.f.size(),
              scene.c.size(), s.gap);

  slant::contact::bodies<double> const problem(scene.K, scene.f, scene.B, scene.c);
  std::printf("  factors        %td, with %td unknowns inside\n\n", problem.factorizations(),
              problem.inside_size());
  std::fflush(stdout);
  auto const qp = problem.qp();
  auto const report =
      slant::solve(slant::schur_contact{qp}, problem.zero(),
                   slant::residual_below(s.tolerance) || slant::at_most(s.max_iterations));
  auto const& state = report.state;
  bool const falls = report.status == slant::status::unbounded;
  Eigen::VectorXd const λ = state.multipliers();
  std::printf("Result\n  status         %s: %s\n", slant::to_string(report.status).data(),
              report.reason.c_str());
  std::printf("  steps          %td\n  products       %td, and %td applications of the projector\n",
              report.iterations(), state.work.operator_applications, state.projector_applications);
  std::printf("  active set     %td changes, %td of %td constraints at the end\n",
              state.rows.changes, state.rows.active.size(), scene.c.size());
  Eigen::VectorXd u = problem.displacement(report.x());
  if (falls) {
    u = problem.direction(state.descent);
    u /= u.cwiseAbs().maxCoeff();
    std::printf("  direction      K d = %.1e max K, largest B d %.1e, work of the load %.3g\n",
                (scene.K * u).cwiseAbs().maxCoeff() / scene.K.diagonal().maxCoeff(),
                (scene.B * u).maxCoeff(), scene.f.dot(u));
  } else {
    double const size = scene.f.norm();
    std::printf("  equilibrium    %.1e, relative\n  penetration    %.1e\n",
                (scene.K * u + scene.B.transpose() * λ - scene.f).norm() / size,
                std::max(0.0, (scene.B * u - scene.c).maxCoeff()));
    std::printf("  displacement   %.4g at most\n", u.cwiseAbs().maxCoeff());
  }
  if (!s.output.empty()) write_stack(s.output / "stack.vtu", scene, u, λ);
  return report.converged() ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Floating bricks on each other in a corner, held by contact alone.",
                             "stacked_bricks");
  settings s;
  app.option("--load", s.load, "hold, lift or tip; the last two have no equilibrium",
             examples::expects_one_of({"hold", "lift", "tip"}));
  app.option("--bricks", s.bricks, "one on top of the other",
             examples::expects<int>("a whole number from 1 to 100",
                                    [](int n) { return n >= 1 && n <= 100; }));
  app.option("--cells", s.k, "k of the 2k x k x k cells of each brick",
             examples::expects<int>("a whole number from 1 to 100",
                                    [](int k) { return k >= 1 && k <= 100; }));
  app.option("--gap", s.gap, "between the bricks and to the floor",
             examples::expects<double>("a number >= 0",
                                       [](double g) { return g >= 0 && std::isfinite(g); }));
  app.option("--tolerance", s.tolerance, "relative norm of the residual",
             examples::expects_tolerance());
  app.option("--max-iterations", s.max_iterations, "steps at most", examples::expects_at_least(0));
  app.option("--output", s.output, "folder for stack.vtu (ParaView)", examples::expects_name());
  return app.run(argc, argv, [&] { return solve_stack(s); });
}
