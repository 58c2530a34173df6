// SPDX-License-Identifier: MIT
//
// Coulomb friction problems of other people's simulations, each by each method:
//
//     friction FOLDER [METHOD...] [--limit SECONDS] [--tolerance T] [--rank N] [--variants yes]
//
// FOLDER holds a folder with W.mtx, q.txt, mu.txt for each problem. All methods are run unless some
// are named; the first one is the default of the library and judged: exit status 1 unless it solves
// every problem within the limit. No method has settings for a problem; their defaults have been
// found with problems as they are given. With --variants yes each is solved with other data as
// well, where only a crash is judged: none of them need have a solution.
//
//     problem, variant    as given; μ times a factor; or q with one per cent of noise
//     dimension, contacts, unknowns, rank, asymmetry
//     zero_error          the error of r = 0, which says what others mean
//     tolerance           of error, rounding and penetration; what is above is not solved
//     method, solved_by   what was run, and for a combination what gave the result
//     status              what the method says of itself, or time_limit, failed
//     error               natural map over |q|, by slant::contact::verify from r alone
//     rounding            of the error, by the checker: an error below says nothing unless this is
//                         below as well
//     penetration         the largest −u_n over |q|: where μ is large the error sees little of it
//     unit_free_error     natural map with ρ = 1/w at each contact, w the size of its block of W:
//                         the measure of the method's own verdict, whatever the units
//     unit_free_rounding  of that
//     sweeps              passes over the contacts, at most a product by W each
//     products            by W, besides
//     newton_steps        interior_steps included, the steps of the interior-point method
//                         factorizations
//     seconds             processor seconds of a process of its own, one run, reading not included
//
// The rank is left out where W has more than N = 2000 rows.
#include <cstdio>
#include <cstdlib>
#include <from_files/friction_methods.hpp>
#include <random>
#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/arguments.hpp"
#include "support/friction_measurement.hpp"
#include "support/numerical_rank.hpp"

namespace {

using problem = slant::contact::friction_problem<>;

[[nodiscard]] benchmarks::friction_row run(problem const& p,
                                           from_files::friction_method const& method,
                                           double tolerance, double limit) {
  return benchmarks::measure_friction(p, 5, limit, [&] {
    auto out = method.run(p, {.tolerance = tolerance});
    auto const& w = out.work;
    return benchmarks::friction_outcome{
        .r = std::move(out.r),
        .status = std::string(slant::to_string(out.status)),
        .solved_by = std::string(slant::contact::to_string(out.solved_by)),
        .counts = {double(w.sweeps), double(w.products), double(w.newton_steps),
                   double(w.interior_steps), double(w.factorizations)}};
  });
}

struct variant {
  std::string name;
  problem p;
};

[[nodiscard]] std::vector<variant> variants(problem const& given, bool all) {
  std::vector<variant> list{{"given", given}};
  if (!all) return list;
  for (double const factor : {0.5, 0.8, 1.25, 2.0}) {
    list.push_back({"mu times " + benchmarks::cell("%g", factor), given});
    list.back().p.mu *= factor;
  }
  for (unsigned seed = 1; seed <= 3; ++seed) {
    list.push_back({"noise " + std::to_string(seed), given});
    std::mt19937 random(seed);
    Eigen::VectorXd noise(given.q.size());
    for (double& x : noise) x = double(random()) / double(std::mt19937::max()) - 0.5;
    list.back().p.q += 0.01 * given.q.norm() / noise.norm() * noise;
  }
  return list;
}

/// All methods that were asked for; true if the default has solved the problem, or, of a variant,
/// has not crashed.
bool measure(std::string const& name, variant const& v, benchmarks::arguments const& given) {
  auto const& p = v.p;
  double const tolerance = given.number("tolerance", 1e-8);
  double const limit = given.number("limit", 20);
  auto const rank =
      benchmarks::numerical_rank(p.W, static_cast<Eigen::Index>(given.number("rank", 2000)));
  Eigen::VectorXd const zero = Eigen::VectorXd::Zero(p.q.size());
  double const zero_error = slant::contact::verify(p, zero).relative_natural_map;
  bool good = true;
  for (auto const& method : from_files::friction_methods) {
    if (!given.wants(std::string(method.name), 1)) continue;
    auto const r = run(p, method, tolerance, limit);
    std::printf("%s,%s,%td,%td,%td,%s,%.0e,%.0e,%g,%s,%s,%s,%s,%s,%s,%s,%s,%s", name.c_str(),
                v.name.c_str(), p.dimension(), p.contacts(), p.q.size(),
                benchmarks::cell("%.0f", double(rank)).c_str(), slant::contact::asymmetry(p.W),
                zero_error, tolerance, std::string(method.name).c_str(), r.solved_by.c_str(),
                r.status.c_str(), benchmarks::cell("%.1e", r.error).c_str(),
                benchmarks::cell("%.0e", r.rounding).c_str(),
                benchmarks::cell("%.1e", r.penetration).c_str(),
                benchmarks::cell("%.1e", r.unit_free_error).c_str(),
                benchmarks::cell("%.0e", r.unit_free_rounding).c_str(),
                benchmarks::cell("%.3g", r.seconds).c_str());
    for (double const count : r.counts) std::printf(",%s", benchmarks::cell("%.0f", count).c_str());
    std::printf("\n");
    std::fflush(stdout);
    if (&method != &from_files::friction_methods.front()) continue;
    good = v.name == "given" ? r.solved(tolerance) : r.status != "failed";
  }
  return good;
}

int measure(benchmarks::arguments const& given) {
  if (given.words().empty()) throw std::invalid_argument("FOLDER is missing");
  bool const all = given.get("variants", "no") == "yes";
  for (auto const& method : from_files::friction_methods)
    (void)given.wants(std::string(method.name), 1);
  given.require_known(1);

  std::printf(
      "problem,variant,dimension,contacts,unknowns,rank,asymmetry,zero_error,tolerance,method,"
      "solved_by,status,error,rounding,penetration,unit_free_error,unit_free_rounding,seconds,"
      "sweeps,products,newton_steps,interior_steps,factorizations\n");
  bool good = true;
  for (auto const& folder : benchmarks::friction_folders(given.words()[0])) {
    auto const name = folder.filename().string();
    for (auto const& v : variants(slant::read_friction_problem(folder), all))
      good = measure(name, v, given) && good;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return measure(benchmarks::arguments(argc, argv, {"limit", "tolerance", "rank", "variants"}));
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "friction: %s\n", failure.what());
    return 2;
  }
}
