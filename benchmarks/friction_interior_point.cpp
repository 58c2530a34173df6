// SPDX-License-Identifier: MIT
//
// Does an interior-point method pay on Coulomb friction problems of other people's simulations?
//
//     friction_interior_point FOLDER [METHOD...] [--limit SECONDS] [--tolerance T]
//
// FOLDER as for friction.cpp. The methods, without settings for a problem; all of them unless some
// are named:
//
//     coulomb             the default of the library
//     interior_point      support/friction_interior.hpp, with the same rule for when to stop
//     crossover           the same with tolerance 1e-4, then the default from its r
//
//     problem, contacts, unknowns
//     variant             the problem as given; μ times a factor; or q with one per cent of noise.
//                         The settings have been found with the given ones, not with the others
//     tolerance           of error, rounding and penetration; what is above is not solved
//     method
//     status              what the method says of itself, or time_limit, failed
//     error               natural map over |q|, by slant::contact::verify from r alone
//     rounding            of the error, by the checker
//     penetration         the largest −u_n over |q|
//     seconds             processor seconds of a process of its own, one run, reading not included
//     steps               of Newton's method: factorisations. The default makes sweeps besides
//
// Exit status 1 unless the interior-point method, where it is run, says of every problem how it
// ended: a crash or the time limit are failures, a problem that it cannot solve is a result.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <slant/contact/solve_friction.hpp>
#include <slant/io/friction_folder.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/friction_interior.hpp"
#include "support/friction_measurement.hpp"

namespace {

using problem = slant::contact::friction_problem<>;
using benchmarks::friction_outcome;

template <int N>
[[nodiscard]] friction_outcome interior_point(problem const& p, double tolerance) {
  slant::contact::friction_blocks<N> const blocks(p);
  auto const out = benchmarks::friction_interior<N>(blocks, {.tolerance = tolerance}).run();
  return {.r = blocks.force(out.r),
          .status = std::string(slant::to_string(out.status)),
          .counts = {double(out.steps)}};
}

[[nodiscard]] friction_outcome interior_point(problem const& p, double tolerance) {
  return p.dimension() == 2 ? interior_point<2>(p, tolerance) : interior_point<3>(p, tolerance);
}

/// The default of the library; an empty start is none.
[[nodiscard]] friction_outcome coulomb(problem const& p, double tolerance,
                                       Eigen::VectorXd const& start) {
  auto const out = slant::contact::solve_friction(p, {.tolerance = tolerance}, start);
  return {.r = out.r,
          .status = std::string(slant::to_string(out.status)),
          .counts = {double(out.work.newton_steps)}};
}

[[nodiscard]] friction_outcome crossover(problem const& p, double tolerance) {
  auto const first = interior_point(p, std::max(tolerance, 1e-4));
  auto out = coulomb(p, tolerance, first.r);
  out.counts[0] += first.counts[0];
  return out;
}

struct variant {
  std::string name;
  problem p;
};

[[nodiscard]] std::vector<variant> variants(problem const& given) {
  std::vector<variant> all{{"given", given}};
  for (double const factor : {0.5, 0.8, 1.25, 2.0}) {
    all.push_back({"mu times " + benchmarks::cell("%g", factor), given});
    all.back().p.mu *= factor;
  }
  for (unsigned seed = 1; seed <= 3; ++seed) {
    all.push_back({"noise " + std::to_string(seed), given});
    std::mt19937 random(seed);
    Eigen::VectorXd noise(given.q.size());
    for (double& x : noise) x = double(random()) / double(std::mt19937::max()) - 0.5;
    all.back().p.q += 0.01 * given.q.norm() / noise.norm() * noise;
  }
  return all;
}

int measure(benchmarks::arguments const& given) {
  if (given.words().empty()) throw std::invalid_argument("FOLDER is missing");
  double const tolerance = given.number("tolerance", 1e-8);
  double const limit = given.number("limit", 20);
  std::string const methods[] = {"coulomb", "interior_point", "crossover"};
  for (auto const& method : methods) (void)given.wants(method, 1);
  given.require_known(1);

  std::printf(
      "problem,contacts,unknowns,variant,tolerance,method,status,error,rounding,penetration,"
      "seconds,steps\n");
  bool good = true;
  for (auto const& folder : benchmarks::friction_folders(given.words()[0])) {
    for (auto const& [name, p] : variants(slant::read_friction_problem(folder))) {
      for (auto const& method : methods) {
        if (!given.wants(method, 1)) continue;
        auto const r = benchmarks::measure_friction(p, 1, limit, [&] {
          return method == "coulomb"          ? coulomb(p, tolerance, {})
                 : method == "interior_point" ? interior_point(p, tolerance)
                                              : crossover(p, tolerance);
        });
        std::printf("%s,%td,%td,%s,%g,%s,%s,%s,%s,%s,%s,%s\n", folder.filename().string().c_str(),
                    p.contacts(), p.q.size(), name.c_str(), tolerance, method.c_str(),
                    r.status.c_str(), benchmarks::cell("%.1e", r.error).c_str(),
                    benchmarks::cell("%.0e", r.rounding).c_str(),
                    benchmarks::cell("%.1e", r.penetration).c_str(),
                    benchmarks::cell("%.3g", r.seconds).c_str(),
                    benchmarks::cell("%.0f", r.counts[0]).c_str());
        std::fflush(stdout);
        bool const ended = r.status != "failed" && r.status != "time_limit";
        if (method == "interior_point") good = good && ended;
      }
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return measure(benchmarks::arguments(argc, argv, {"limit", "tolerance"}));
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "friction_interior_point: %s\n", failure.what());
    return 2;
  }
}
