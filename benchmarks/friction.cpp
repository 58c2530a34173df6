// SPDX-License-Identifier: MIT
//
// Coulomb friction problems of other people's simulations, each by each method:
//
//     friction FOLDER [METHOD...] [--limit SECONDS] [--tolerance T] [--rank N]
//
// FOLDER holds a folder with W.mtx, q.txt, mu.txt for each problem. All methods are run unless some
// are named; the first one is the default of the library and judged: exit status 1 unless it solves
// every problem within the limit. No method has settings for a problem.
//
//     problem, dimension, contacts, unknowns, rank, asymmetry
//     zero_error          the error of r = 0, which says what others mean
//     tolerance           of error, rounding and penetration; what is above is not solved
//     method, solved_by   what was run, and for a combination what gave the result
//     status              what the method says of itself, or time_limit, failed
//     error               natural map over |q|, by slant::contact::verify from r alone
//     rounding            of the error, by the checker: an error below says nothing unless this is
//                         below as well
//     penetration         the largest −u_n over |q|: where μ is large the error sees little of it
//     sweeps              passes over the contacts, at most a product by W each
//     products            by W, besides
//     newton_steps, proximal_steps, factorizations
//     seconds             processor seconds of a process of its own, one run, reading not included
//
// The rank is left out where W has more than N = 2000 rows.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <from_files/friction_methods.hpp>
#include <slant/contact/verify.hpp>
#include <slant/io/friction_folder.hpp>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/child_process.hpp"
#include "support/cpu_clock.hpp"
#include "support/numerical_rank.hpp"

namespace {

namespace fs = std::filesystem;
using problem = slant::contact::friction_problem<>;

struct row {
  std::string status = "failed", solved_by{};
  double error = NAN, rounding = NAN, penetration = NAN, seconds = NAN;
  std::array<double, 5> work{NAN, NAN, NAN, NAN, NAN};  ///< in the order of the table
};

/// Two words behind the numbers, a character in each.
[[nodiscard]] std::vector<double> packed(std::vector<double> numbers, std::string const& status,
                                         std::string const& solved_by) {
  for (char const c : status + '\n' + solved_by) numbers.push_back(double(c));
  return numbers;
}

[[nodiscard]] row run(problem const& p, from_files::friction_method const& method, double tolerance,
                      double limit) {
  auto const child = benchmarks::in_child(limit, [&] {
    double const start = benchmarks::cpu_seconds();
    auto const out = method.run(p, {.tolerance = tolerance});
    double const seconds = benchmarks::cpu_seconds() - start;
    auto const check = slant::contact::verify(p, out.r);
    auto const& w = out.work;
    return packed({check.relative_natural_map, check.relative_rounding, check.penetration.relative,
                   seconds, double(w.sweeps), double(w.products), double(w.newton_steps),
                   double(w.proximal_steps), double(w.factorizations)},
                  std::string(slant::to_string(out.status)),
                  std::string(slant::contact::to_string(out.solved_by)));
  });
  row r;
  if (child.how == benchmarks::ending::time_limit) r.status = "time_limit";
  auto const& n = child.numbers;
  std::size_t const words_from = 4 + r.work.size();
  if (child.how != benchmarks::ending::finished || n.size() <= words_from) return r;
  r.error = n[0];
  r.rounding = n[1];
  r.penetration = n[2];
  r.seconds = n[3];
  std::copy_n(n.begin() + 4, r.work.size(), r.work.begin());
  std::string words;
  for (std::size_t i = words_from; i < n.size(); ++i) words.push_back(static_cast<char>(n[i]));
  auto const end = words.find('\n');
  r.status = words.substr(0, end);
  r.solved_by = words.substr(end + 1);
  return r;
}

/// A cell; nothing for what was not measured.
[[nodiscard]] std::string cell(char const* format, double value) {
  if (std::isnan(value) || value < 0) return "";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

[[nodiscard]] std::vector<fs::path> problem_folders(fs::path const& folder) {
  std::vector<fs::path> found;
  for (auto const& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "W.mtx")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) throw std::invalid_argument(folder.string() + ": no problem in it");
  return found;
}

int measure(benchmarks::arguments const& given) {
  if (given.words().empty()) throw std::invalid_argument("FOLDER is missing");
  double const tolerance = given.number("tolerance", 1e-8);
  double const limit = given.number("limit", 20);
  auto const largest = static_cast<Eigen::Index>(given.number("rank", 2000));
  auto const& methods = from_files::friction_methods;
  for (auto const& method : methods) (void)given.wants(std::string(method.name), 1);
  given.require_known(1);
  auto const folders = problem_folders(given.words()[0]);

  std::printf(
      "problem,dimension,contacts,unknowns,rank,asymmetry,zero_error,tolerance,method,solved_by,"
      "status,error,rounding,penetration,seconds,sweeps,products,newton_steps,proximal_steps,"
      "factorizations\n");
  bool good = true;
  for (auto const& folder : folders) {
    auto const p = slant::read_friction_problem(folder);
    auto const rank = benchmarks::numerical_rank(p.W, largest);
    Eigen::VectorXd const zero = Eigen::VectorXd::Zero(p.q.size());
    double const zero_error = slant::contact::verify(p, zero).relative_natural_map;
    for (auto const& method : methods) {
      if (!given.wants(std::string(method.name), 1)) continue;
      row const r = run(p, method, tolerance, limit);
      std::printf("%s,%td,%td,%td,%s,%.0e,%.0e,%g,%s,%s,%s,%s,%s,%s,%s",
                  folder.filename().string().c_str(), p.dimension(), p.contacts(), p.q.size(),
                  cell("%.0f", double(rank)).c_str(), slant::contact::asymmetry(p.W), zero_error,
                  tolerance, std::string(method.name).c_str(), r.solved_by.c_str(),
                  r.status.c_str(), cell("%.1e", r.error).c_str(), cell("%.0e", r.rounding).c_str(),
                  cell("%.1e", r.penetration).c_str(), cell("%.3g", r.seconds).c_str());
      for (double const count : r.work) std::printf(",%s", cell("%.0f", count).c_str());
      std::printf("\n");
      std::fflush(stdout);
      // A NaN is not at most anything.
      bool const solved = r.status == "converged" && r.error <= tolerance &&
                          r.rounding <= tolerance && r.penetration <= tolerance;
      if (&method == &methods.front()) good = good && solved;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return measure(benchmarks::arguments(argc, argv, {"limit", "tolerance", "rank"}));
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "friction: %s\n", failure.what());
    return 2;
  }
}
