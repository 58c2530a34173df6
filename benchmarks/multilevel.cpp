// SPDX-License-Identifier: MIT
//
// Bricks in contact, without friction, with Tresca's and with Coulomb's (F = 0.3), by contact::solve
// and contact::certified_coulomb with multigrid, K never factored:
//
//     multilevel [--no-dual | --no-direct] [--load NAME] [K...]     sizes of the brick, 8 12 16
//                                                                   without any
//
// under the loads of the brick, with Tresca's friction also by the interpolation of nested meshes
// in place of aggregation (`press nested`, …), and `loose`, the brick without its clamp, pressed
// onto the floor from a gap and pulled, `bricks`, two of 3K/2 nodes along an edge, and `plates`, two
// in the plane of 10K × 10K/3 cells; with --load only the one of that name, and its nested meshes. It
// prints comma-separated values: friction,
// load, size, unknowns, Newton steps (of Coulomb's law together with problems of Tresca's), cycles,
// products by K, processor seconds of the hierarchy, of everything from K, N, T, f, d, g and the
// coordinates to a certified u (the hierarchy included; the least of three runs), of factoring K
// and solving once by slant::factorize (for each size, the least of three up to K = 16), and, where
// a body is loose or there are two, of the dual method with factors to the same tolerance; the most
// memory that the process has held at once while it solved, in MiB, K and all data included (Linux;
// elsewhere nan); the relative error in the energy norm, as certified, and against a reference: the
// dual method with factors at 1e-12, or with --no-dual, where its factors take too long, the same
// method at 1e-11. --no-direct: as --no-dual, but K is not factored at all, and each solution is
// timed once. Exit status 1 if a run does not converge, or an error is above 1e-8 or above what is
// certified by more than a tenth.

#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/solve.hpp>

#include <fem/box_prolongations.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/cpu_clock.hpp"
#include "support/peak_memory.hpp"

namespace {

using vector = Eigen::VectorXd;
namespace contact = slant::contact;
using benchmarks::stopwatch;

enum class law : unsigned char { none, tresca, coulomb };

struct answer {
  vector u;
  double certified;
  bool converged;
  slant::index steps;
  slant::work work;
};

using interpolation = std::vector<Eigen::SparseMatrix<double>>;

/// Levels by aggregation if there is no interpolation.
template <int D>
answer run(fem::contact_scene<D> const& s, law friction, contact::solution_route route,
           double tolerance, interpolation const& nested = {}) {
  contact::data<double> c{s.N, s.T, s.f, s.d, s.g};
  auto const layout = contact::layout_of(s.mesh.nodes, s.unknowns.first);
  if (friction == law::coulomb) {
    vector const F = vector::Constant(c.nodes(), 0.3);
    using disc_or_line = std::conditional_t<D == 3, contact::friction_disc, contact::friction_line>;
    auto r = contact::certified_coulomb(disc_or_line{}, s.K, std::move(c), F,
                                        {.tolerance = tolerance, .layout = layout, .route = route});
    return {std::move(r.u), r.error.relative(), r.converged(), r.steps, r.work};
  }
  if (friction == law::none) {
    c.T.resize(0, s.f.size());
    c.g.resize(0);
  }
  contact::solve_options<double> o{.tolerance = tolerance};
  if (nested.empty()) o.layout = layout;
  o.multigrid.prolongations = nested;
  o.route = route;
  auto r = contact::solve(s.K, c, o);
  return {std::move(r.u), r.error.relative(), r.converged(), r.iterations, r.work};
}

template <int D>
double energy(fem::contact_scene<D> const& s, vector const& u) {
  return std::sqrt(u.dot(vector(s.K * u)));
}

/// The brick of K × 3K × K cells on the floor, without its clamp.
fem::contact_scene<3> loose_brick(int k) {
  fem::contact_scene<3> s;
  auto const mesh = fem::make_box_mesh<3>({3 * k, k, k}, {3, 1, 1});
  s.mesh = mesh;
  s.unknowns = fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
  s.K = fem::stiffness<3>(mesh, s.unknowns, fem::lame(2.119e5, 0.277));
  s.f = vector::Zero(s.K.rows());
  fem::add_tractions<3>(mesh, s.unknowns, {{{2, true}, {0, 0, -0.3}}, {{0, true}, {-0.1, 0.05, 0}}},
                        s.f);
  s.contact_nodes = mesh.nodes_on({2, false});
  auto const m = static_cast<Eigen::Index>(s.contact_nodes.size());
  s.N.resize(m, s.K.rows());
  s.T.resize(2 * m, s.K.rows());
  for (Eigen::Index i = 0; i < m; ++i) {
    int const first = s.unknowns.first[s.contact_nodes[static_cast<std::size_t>(i)]];
    s.N.insert(i, first + 2) = -1;
    s.T.insert(2 * i, first) = 1;
    s.T.insert(2 * i + 1, first + 1) = 1;
  }
  s.d = vector::Constant(m, 1e-4);
  s.g = vector::Constant(m, 0.5 / double(m));
  return s;
}

/// How much is factored.
enum class factors : unsigned char { none, of_one_solve, all };

/// Processor seconds of factoring K and solving once, the least of so many runs.
double linear_seconds(fem::contact_scene<3> const& s, int runs) {
  double least = std::numeric_limits<double>::infinity();
  for (; runs > 0; --runs) {
    stopwatch const linear;
    vector u(s.f.size());
    slant::apply(slant::inverse(slant::factorize(s.K)), s.f, u);
    least = std::min(least, linear.seconds());
  }
  return least;
}

/// linear: seconds of one linear solve with the same K.
template <int D>
bool measure(fem::contact_scene<D> const& scene, std::string const& load, law friction, int k,
             factors direct, double linear, interpolation const& nested = {}) {
  using contact::solution_route;
  bool const is_loose = load == "loose", is_pair = load == "bricks" || load == "plates";
  benchmarks::forget_peak_memory();
  answer r;
  double seconds = std::numeric_limits<double>::infinity(), memory = 0;
  int const repetitions = direct == factors::none ? 1 : 3;
  for (int i = repetitions; i > 0; --i) {
    stopwatch const whole;
    r = run(scene, friction, solution_route::iterate, 1e-8, nested);
    seconds = std::min(seconds, whole.seconds());
    memory = benchmarks::peak_memory_mib();
  }

  auto const layout = contact::layout_of(scene.mesh.nodes, scene.unknowns.first);
  double setup_seconds = std::nan("");  // a loose brick has levels of K and springs
  if (!is_loose) {
    setup_seconds = std::numeric_limits<double>::infinity();
    for (int i = repetitions; i > 0; --i) {
      stopwatch const setup;
      slant::multigrid const hierarchy(scene.K, contact::detail::rigid_motions(layout),
                                       {.prolongations = nested});
      setup_seconds = std::min(setup_seconds, setup.seconds());
    }
  }

  double dual_seconds = std::nan("");
  if (direct == factors::all && (is_loose || is_pair)) {
    stopwatch const dual;
    run(scene, friction, solution_route::factor, 1e-8);
    dual_seconds = dual.seconds();
  }
  auto const reference = direct == factors::all
                             ? run(scene, friction, solution_route::factor, 1e-12)
                             : run(scene, friction, solution_route::iterate, 1e-11, nested);
  double const error = energy(scene, r.u - reference.u) / energy(scene, reference.u);
  char const* const name = friction == law::none     ? "none"
                           : friction == law::tresca ? "tresca"
                                                     : "coulomb";
  std::printf("%s,%s,%d,%td,%td,%td,%td,%.3f,%.3f,%.3f,%.3f,%.0f,%.1e,%.1e\n", name, load.c_str(),
              k, scene.f.size(), r.steps, r.work.inner_iterations, r.work.operator_applications,
              setup_seconds, seconds, linear, dual_seconds, memory, r.certified, error);
  std::fflush(stdout);
  return r.converged && error <= 1e-8 && error <= 1.1 * r.certified;
}

}  // namespace

int main(int argc, char** argv) {
  factors direct = factors::all;
  std::string only;
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    std::string_view const argument = argv[i];
    if (argument == "--no-direct") {
      direct = factors::none;
    } else if (argument == "--no-dual") {
      direct = factors::of_one_solve;
    } else if (argument == "--load" && i + 1 < argc) {
      only = argv[++i];
      if (std::ranges::none_of(fem::brick_loads,
                               [&](auto load) { return name_of(load) == only; })) {
        std::fprintf(stderr, "multilevel: --load: got %s, expected press, pull or lift\n",
                     only.c_str());
        return 2;
      }
    } else if (int const k = std::atoi(argv[i]); k > 0) {
      sizes.push_back(k);
    } else {
      std::fprintf(stderr, "usage: multilevel [--no-dual | --no-direct] [--load NAME] [K...]\n");
      return 2;
    }
  }
  if (sizes.empty()) sizes = {8, 12, 16};
  std::printf(
      "friction,load,k,unknowns,steps,cycles,products,setup_seconds,seconds,linear_solve_seconds,"
      "dual_seconds,memory_MiB,certified,error\n");
  bool good = true;
  double const unknown = std::nan("");
  std::map<int, double> linear;  // one K for all loads
  for (law const friction : {law::tresca, law::coulomb, law::none}) {
    for (int const k : sizes) {
      for (auto const load : fem::brick_loads) {
        std::string const name(name_of(load));
        if (!only.empty() && name != only) continue;
        auto const scene = fem::make_steel_brick({.k = k, .load = load});
        if (!linear.contains(k)) {
          linear[k] = direct == factors::none ? unknown : linear_seconds(scene, k <= 16 ? 3 : 1);
        }
        good = measure(scene, name, friction, k, direct, linear[k]) && good;
        if (friction != law::tresca || k % 2 != 0) continue;
        auto const mesh = fem::make_brick_mesh(k, {3, 1, 1});
        good = measure(scene, name + " nested", friction, k, direct, linear[k],
                       fem::box_prolongations(mesh, scene.unknowns)) &&
               good;
      }
      if (friction != law::tresca || !only.empty()) continue;
      good = measure(loose_brick(k), "loose", friction, k, direct, unknown) && good;
      good =
          measure(fem::make_two_bricks(3 * k / 2), "bricks", friction, k, direct, unknown) && good;
      good =
          measure(fem::make_two_plates(10 * k / 3), "plates", friction, k, direct, unknown) && good;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
