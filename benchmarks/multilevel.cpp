// SPDX-License-Identifier: MIT
//
// Bricks in contact without friction, iterated on u with multigrid, K never factored:
//
//     multilevel [--no-direct] [K...]     sizes of the brick, 8 12 16 without any
//
// prints comma-separated values: unknowns, Newton steps, cycles (one product by K each), processor
// seconds of the hierarchy, of everything from K, f, N, d to u (the hierarchy included), and of
// factoring K and solving once by slant::factorize, the route that the cost model takes, and the
// error of u in the energy norm, relative, against a reference: the dual method with factors at
// 1e-13, or with --no-direct, where factors take too long, the same method at 1e-12. Exit status 1
// if a run does not converge, an error is above 1e-8, or k = 12 takes 0.9 s or more.

#include <slant/contact/rigid_body_modes.hpp>
#include <slant/contact/solve_obstacle.hpp>

#include <fem/steel_brick.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
namespace contact = slant::contact;

/// Processor seconds of this process; everything here is of one thread.
class stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t start_ = std::clock();
};

/// Coordinates of the nodes that can move, in the order of their unknowns.
Eigen::MatrixXd moving_nodes(fem::contact_scene<3> const& scene) {
  Eigen::MatrixXd nodes(3, scene.f.size() / 3);
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < scene.mesh.node_count(); ++i) {
    if (!scene.unknowns.is_fixed(i)) nodes.col(next++) = scene.mesh.nodes.col(i);
  }
  return nodes;
}

contact::obstacle_solution<double> run(fem::contact_scene<3> const& s, contact::solution_route r,
                                       double tolerance) {
  contact::obstacle_options<double> o{.route = r, .tolerance = tolerance};
  if (r == contact::solution_route::iterate) {
    o.near_kernel = contact::rigid_body_modes(moving_nodes(s));
  }
  return contact::solve_obstacle(s.K, s.f, s.N, s.d, o);
}

double energy(fem::contact_scene<3> const& s, vector const& u) {
  return std::sqrt(u.dot(vector(s.K * u)));
}

bool measure(fem::brick_load load, int k, bool direct) {
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  stopwatch const whole;
  auto const r = run(scene, contact::solution_route::iterate, 1e-8);
  double const seconds = whole.seconds();

  stopwatch const setup;
  slant::multigrid const hierarchy(scene.K, contact::rigid_body_modes(moving_nodes(scene)));
  double const setup_seconds = setup.seconds();

  double linear_seconds = std::nan("");
  if (direct) {
    stopwatch const linear;
    vector u(scene.f.size());
    slant::apply(slant::inverse(slant::factorize(scene.K)), scene.f, u);
    linear_seconds = linear.seconds();
  }
  auto const reference = direct ? run(scene, contact::solution_route::factor, 1e-13)
                                : run(scene, contact::solution_route::iterate, 1e-12);
  double const error = energy(scene, r.u - reference.u) / energy(scene, reference.u);
  auto const choice = contact::choose_route(scene.K, scene.N);
  bool const iterates = choice.route == contact::solution_route::iterate;
  std::printf("%s,%d,%td,%td,%td,%.3f,%.3f,%.3f,%s,%.1e\n", std::string(name_of(load)).c_str(), k,
              scene.f.size(), r.steps, r.work.inner_iterations, setup_seconds, seconds,
              linear_seconds, iterates ? "iterate" : "factor", error);
  std::fflush(stdout);
  bool const fast = k != 12 || seconds < 0.9;
  if (!fast) std::fprintf(stderr, "k = 12 took %.3f s, expected less than 0.9 s\n", seconds);
  return r.converged() && error <= 1e-8 && fast;
}

}  // namespace

int main(int argc, char** argv) {
  bool direct = true;
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    std::string_view const argument = argv[i];
    if (argument == "--no-direct") {
      direct = false;
    } else if (int const k = std::atoi(argv[i]); k > 0) {
      sizes.push_back(k);
    } else {
      std::fprintf(stderr, "usage: multilevel [--no-direct] [K...]\n");
      return 2;
    }
  }
  if (sizes.empty()) sizes = {8, 12, 16};
  std::printf(
      "load,k,unknowns,steps,cg_steps,setup_seconds,seconds,linear_solve_seconds,route,error\n");
  bool good = true;
  for (int const k : sizes) {
    for (auto const load : fem::brick_loads) good = measure(load, k, direct) && good;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
