// SPDX-License-Identifier: MIT
//
// A steel brick cut into cubes that are solved one by one: Total-FETI with the semismooth Newton
// method for multipliers and equilibrium together, or SMALSE-M, beside the brick that is not cut.
#include <fem/decomposed_brick.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/total_feti.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <support/command_line.hpp>
#include <support/floating_parts.hpp>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

using vector = Eigen::VectorXd;

struct settings {
  std::vector<int> cubes{4, 2, 2};
  int cells = 4;
  std::string load = "pull";
  std::string method = "newton";
  bool frictionless = false;
  double tolerance = 1e-9;
  long max_iterations = 100;
};

/// Displacements of the brick that is not cut, and whether they are as accurate as asked for.
template <class Friction>
std::pair<vector, bool> whole_brick(Friction friction, fem::contact_scene<3> const& scene,
                                    bool tresca, double tolerance) {
  auto const factor = slant::factorize(scene.K);
  auto const data = examples::contact_data(scene, tresca);
  slant::contact::dual const dual(friction, factor, data);
  auto const r = slant::solve(slant::symmetric_newton{dual.qp()}, dual.zero(),
                              slant::reduced_gradient_below(tolerance) || slant::at_most(200));
  return {dual.displacement(r.x()), r.converged()};
}

/// Solves the brick in parts by one method, and says how; true if it converged.
template <class Problem, class Method>
bool run(settings const& s, fem::decomposed_brick const& brick, Problem const& problem,
         vector const& expected, Method const& method) {
  auto const r = slant::solve(
      method, problem.zero(),
      (slant::reduced_gradient_below(s.tolerance) && slant::feasibility_below(s.tolerance)) ||
          slant::at_most(s.max_iterations));
  vector const u = problem.displacement(r.x(), method.multipliers(r.state));
  std::printf("status                 %s\n", std::string(slant::to_string(r.status)).c_str());
  std::printf("outer steps            %ld\n", static_cast<long>(r.iterations()));
  std::printf("inner steps            %ld\n", static_cast<long>(r.state.work.inner_iterations));
  std::printf("products by B K+ B'    %ld + %ld before\n",
              static_cast<long>(r.state.work.operator_applications),
              static_cast<long>(r.state.work.setup_applications));
  std::printf("largest jump           %.2e of |u|\n",
              (brick.parts.glue * u).cwiseAbs().maxCoeff() / u.cwiseAbs().maxCoeff());
  std::printf("beside the whole brick %.2e of |u|\n",
              (brick.parts.mean * u - expected).norm() / expected.norm());
  return r.converged();
}

template <class Friction>
bool solve_brick(Friction friction, settings const& s, fem::decomposed_brick const& brick) {
  bool const tresca = !s.frictionless;
  auto const [expected, known] = whole_brick(friction, brick.scene, tresca, s.tolerance / 100);
  if (!known) std::printf("the whole brick        not solved to %.0e\n", s.tolerance / 100);
  auto const bodies = examples::floating_parts(brick.parts);
  auto const data = examples::contact_data(brick.scene, brick.parts, tresca);
  slant::contact::total_feti const problem(friction, bodies, data);
  std::printf("subdomains             %zu\n", bodies.K.size());
  std::printf("unknowns               %ld, of the whole %ld\n",
              static_cast<long>(brick.parts.unknowns()), static_cast<long>(expected.size()));
  std::printf("multipliers            %ld, of them %ld glue and hold\n",
              static_cast<long>(problem.zero().size()), static_cast<long>(bodies.B.rows()));
  std::printf("coarse problem         %ld equations\n",
              static_cast<long>(problem.constraints().rows()));
  auto const qp = problem.qp();
  if (s.method == "smalse") {
    return run(s, brick, problem, expected, slant::smalse{qp, problem.constraints()}) && known;
  }
  auto const M = slant::contact::dirichlet_preconditioner(slant::contact::block_stiffness(bodies),
                                                          problem.rows());
  return run(s, brick, problem, expected,
             slant::constrained_newton{qp, problem.constraints(), M}) &&
         known;
}

int solve(settings const& s) {
  auto const brick =
      fem::make_decomposed_brick({.cubes = {s.cubes.at(0), s.cubes.at(1), s.cubes.at(2)},
                                  .cells = s.cells,
                                  .load = *fem::brick_load_named(s.load)});
  std::printf("load                   %s, %s\n", s.load.c_str(),
              s.frictionless ? "frictionless" : "Tresca friction");
  bool const converged = s.frictionless ? solve_brick(slant::contact::frictionless{}, s, brick)
                                        : solve_brick(slant::contact::friction_disc{}, s, brick);
  return converged ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("A steel brick cut into cubes, solved by Total-FETI.",
                             "decomposed_brick");
  settings s;
  app.option("--cubes", s.cubes, "cubes along each axis, one for each subdomain",
             examples::expects<int>("a whole number from 1 to 100",
                                    [](int n) { return n >= 1 && n <= 100; }),
             3, 3);
  app.option("--cells", s.cells, "cells along the edge of a cube, H/h",
             examples::expects<int>("a whole number from 1 to 100",
                                    [](int n) { return n >= 1 && n <= 100; }));
  app.option("--load", s.load, "press, pull or lift",
             examples::expects_one_of({"press", "pull", "lift"}));
  app.option("--method", s.method, "newton, for all multipliers together, or smalse",
             examples::expects_one_of({"newton", "smalse"}));
  app.flag("--frictionless", s.frictionless, "no friction");
  app.option("--tolerance", s.tolerance, "relative accuracy", examples::expects_tolerance());
  app.option("--max-iterations", s.max_iterations, "outer steps at most",
             examples::expects_at_least(0));
  return app.run(argc, argv, [&] { return solve(s); });
}
