// SPDX-License-Identifier: MIT
//
// Every method on random programs with hard data, half lines × intervals × discs × ellipses × cones
// × Rᵏ: the three suites of tests/oracle/random_programs.hpp in full.
//
//     random_programs [--suite nasty|degenerate|tiny] [--method NAME] [--first K] [--count N]
//                     [--asked 1e-8,1e-15] [--steps N] [--applications N]
//
// prints comma-separated values, a row for each run, to standard output, a line for each method and
// suite to standard error; stability.py makes the table. The error is ‖x − x*‖_A / ‖x*‖_A, x* found
// in quadruple precision, or planted where A is singular. Verdicts are those of
// tests/stability/verdict.hpp: wrong is `converged` above 30 max(asked, floor),
//
//     floor = ε (‖A‖∞ ‖x*‖ + ‖b‖) / (√λ_min ‖x*‖_A),
//
// the energy of a gradient that is rounded. floors: the residual in such units,
// oracle::floors_above; the runs asked for 1e-15 show how many programs end at the floor.
//
// Exit status 1 if a run is wrong.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "random_programs/methods.hpp"
#include "support/arguments.hpp"

namespace {

using namespace random_programs;

constexpr double threshold = 30;
constexpr double ε = std::numeric_limits<double>::epsilon();

/// What is known of a program in quadruple precision.
struct reference {
  std::optional<oracle::quad_vector> x{};
  double floor = 0;
};

reference solve_in_quad(oracle::random_program const& p) {
  reference r;
  if (p.definite) r.x = oracle::exact_solution(p);
  if (!r.x && p.planted.size() > 0)
    r.x = oracle::quad_vector(p.planted.data(), p.planted.data() + p.planted.size());
  if (!r.x) return r;
  Eigen::VectorXd x(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i)
    x(i) = static_cast<double>((*r.x)[static_cast<std::size_t>(i)]);
  double const energy = std::sqrt(std::max(0.0, x.dot(p.A * x)));
  double const rounding = ε * (p.A.cwiseAbs().rowwise().sum().maxCoeff() * x.norm() + p.b.norm());
  r.floor = energy > 0 ? rounding * std::sqrt(p.condition) / energy : 0;
  return r;
}

struct tally {
  long runs = 0, at_floor = 0;
  std::map<std::string, long> said{};
};

class bench {
 public:
  explicit bench(benchmarks::arguments const& a)
      : suite_(a.get("suite", "")),
        method_(a.get("method", "")),
        first_(static_cast<int>(a.number("first", 0))),
        count_(static_cast<int>(a.number("count", 1e6))),
        asked_(a.numbers("asked", {1e-8, 1e-15})),
        limits_{.steps = static_cast<slant::index>(a.number("steps", 3000)),
                .applications = static_cast<slant::index>(a.number("applications", 20000))} {}

  /// Is no run wrong?
  [[nodiscard]] bool run() {
    std::printf(
        "suite,number,unknowns,condition,method,asked,status,verdict,error,floor,floors,claimed,"
        "iterations,applications\n");
    static constexpr std::pair<char const*, oracle::program_suite> suites[]{
        {"nasty", oracle::program_suite::nasty},
        {"degenerate", oracle::program_suite::degenerate},
        {"tiny", oracle::program_suite::tiny}};
    for (auto const& [name, suite] : suites) {
      if (!suite_.empty() && suite_ != name) continue;
      rows_.clear();
      int const last = std::min(oracle::programs_in(suite), first_ + count_);
      for (int k = first_; k < last; ++k)
        visit(name, k, oracle::make_program(suite, static_cast<std::uint64_t>(k)));
      report(name);
    }
    return wrong_ == 0;
  }

 private:
  void visit(char const* suite, int number, oracle::random_program const& p) {
    reference const exact = solve_in_quad(p);
    prepared const ready(p);
    for (auto const methods : {newton_methods(), active_set_methods(), modified_methods(),
                               natural_methods(), multiplier_methods()}) {
      for (auto const& m : methods) {
        if (!method_.empty() && method_ != m.name) continue;
        for (double const asked : asked_) measure(suite, number, ready, exact, m, asked);
      }
    }
  }

  void measure(char const* suite, int number, prepared const& ready, reference const& exact,
               method const& m, double asked) {
    request r = limits_;
    r.tolerance = asked;
    outcome o;
    char const* failed = nullptr;
    try {
      o = m.run(ready, r);
    } catch (slant::bad_input const&) {
      failed = "refused";
    } catch (std::exception const&) {
      failed = "crashed";
    }
    bool const finite = o.x.size() == ready.p.size() && o.x.allFinite();
    double const infinity = std::numeric_limits<double>::infinity();
    double const floors = finite ? oracle::floors_above(ready.p, o.x) : infinity;
    double const error = !finite   ? infinity
                         : exact.x ? oracle::energy_error(ready.p, o.x, *exact.x)
                                   : std::numeric_limits<double>::quiet_NaN();
    // Without a reference the residual decides; of a singular A, whose null space rounding gives an
    // energy of √ε, it may do so too.
    bool const at_floor = floors <= 100;
    bool const good = (exact.x && error <= threshold * std::max(asked, exact.floor)) ||
                      (at_floor && (!exact.x || !ready.p.definite));
    char const* const said = failed ? failed : !finite ? "crashed" : name_of(o.status, good);
    std::printf("%s,%d,%td,%.2g,%s,%g,%s,%s,%.3g,%.2g,%.3g,%.3g,%td,%td\n", suite, number,
                ready.p.size(), ready.p.condition, m.name.data(), asked,
                slant::to_string(o.status).data(), said, error, exact.floor, floors, o.claimed,
                o.iterations, o.applications);
    auto& t = rows_[std::string(m.name)];
    t.at_floor += asked == asked_.back() && at_floor ? 1 : 0;
    wrong_ += std::string(said) == "wrong" ? 1 : 0;
    if (asked == asked_.front()) {
      ++t.runs;
      ++t.said[said];
    }
  }

  static char const* name_of(slant::status s, bool good) {
    if (s == slant::status::converged) return good ? "right" : "wrong";
    if (s == slant::status::unbounded) return "unbounded";
    if (good) return "unclaimed";
    if (s == slant::status::stalled) return "stalled";
    return s == slant::status::iteration_limit ? "limit" : "breakdown";
  }

  void report(char const* suite) const {
    for (auto const& [name, t] : rows_) {
      std::fprintf(stderr, "%s, %s: %ld of %ld at the floor;", suite, name.c_str(), t.at_floor,
                   t.runs);
      for (auto const& [verdict, n] : t.said) std::fprintf(stderr, " %s %ld", verdict.c_str(), n);
      std::fprintf(stderr, "\n");
    }
  }

  std::string suite_, method_;
  int first_, count_;
  std::vector<double> asked_;
  request limits_;
  std::map<std::string, tally> rows_{};
  long wrong_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    bench b(benchmarks::arguments(
        argc, argv, {"suite", "method", "first", "count", "asked", "steps", "applications"}));
    return b.run() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (std::exception const& e) {
    std::fprintf(stderr, "random_programs: %s\n", e.what());
    return 2;
  }
}
