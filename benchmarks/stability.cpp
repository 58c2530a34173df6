// SPDX-License-Identifier: MIT
//
// Every method on every adversity, judged by references in quadruple precision:
//
//     stability [--adversity NAME] [--method NAME] [--tolerances 1e-4,1e-8] [--starts yes|no]
//               [--variants N] [--steps N] [--applications N] [--shrink yes]
//
// prints comma-separated values, a row for each run, to standard output, the summary line to
// standard error; stability.py makes the tables:
//
//     ratio    (relative energy error) / max(tolerance, floor); above 30 behind `converged` is
//              wrong
//     floor    what rounding permits, see tests/stability/reference.hpp
//     kkt      relative residual of the optimality conditions, in double, from the data alone
//     claimed  what the method says of its own error, if it does
//
// A program without an exact reference is a row with the verdict `inexact`. With --shrink yes the
// runs that are wrong at 1e-8 from zero come last: for each method and adversity the mildest one,
// with as few blocks of unknowns as are still wrong, as a line for tests/stability/regressions.hpp.
//
// Exit status 1 if a run that says `converged` is above 30, one says `unbounded`, or a claimed bound
// is below the true error.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stability/scenes.hpp>
#include <stability/verdict.hpp>
#include <string>
#include <utility>

#include "support/arguments.hpp"

namespace {

using namespace stability;

/// Runs and tallies of a call.
class bench {
 public:
  explicit bench(benchmarks::arguments const& a)
      : adversity_(a.get("adversity", "")),
        method_(a.get("method", "")),
        tolerances_(a.numbers("tolerances", {1e-2, 1e-5, 1e-8, 1e-15})),
        starts_(a.get("starts", "yes") == "yes"),
        variants_(static_cast<std::size_t>(a.number("variants", 100))),
        steps_(static_cast<slant::index>(a.number("steps", 3000))),
        applications_(static_cast<slant::index>(a.number("applications", 10000))),
        shrink_(a.get("shrink", "no") == "yes") {}

  void run() {
    std::printf(
        "adversity,parameter,variant,unknowns,condition,plain_condition,floor,method,start,"
        "tolerance,"
        "status,verdict,error,ratio,kkt,claimed,iterations,applications,seconds\n");
    for (auto const& f : families()) {
      if (!adversity_.empty() && f.name != adversity_) continue;
      for (double const parameter : f.parameters)
        for (std::size_t v = 0; v < std::min(variants_, f.variants.size()); ++v)
          visit(make_program(f.name, parameter, f.variants[v]));
    }
  }

  /// Prints the first wrong run of each method and adversity, made as small as it can be.
  void shrink() const {
    if (!shrink_) return;
    for (auto const& [key, p] : wrong_) {
      auto const& [name, adversity] = key;
      std::string variant = p.variant;
      for (int blocks = 1; !p.contact() && adversity != "cases" && blocks < 6; ++blocks) {
        std::string const smaller = p.variant + "/" + std::to_string(blocks);
        if (!is_wrong(name, make_program(adversity, p.parameter, smaller))) continue;
        variant = smaller;
        break;
      }
      std::fprintf(stderr, "    regression{\"%s\", \"%s\", %g, \"%s\"},\n", name.c_str(),
                   adversity.c_str(), p.parameter, variant.c_str());
    }
  }

  /// The summary line; is all well?
  [[nodiscard]] bool report() const {
    if (inexact_ > 0)
      std::fprintf(stderr, "%ld programs are left out: their reference is not exact enough\n",
                   inexact_);
    std::fprintf(stderr, "%s\n", summary_line(all_).c_str());
    return all_.count(verdict::wrong) == 0 && all_.count(verdict::unbounded) == 0 &&
           all_.claims_broken == 0 && inexact_ == 0;
  }

 private:
  static bool is_wrong(std::string const& name, program const& p) {
    reference const exact = solve_in_quad(p);
    if (!exact.exact()) return false;
    prepared const ready(p);
    bool wrong = false;
    request const asked{.tolerance = 1e-8};
    for_each_method([&](method const& m) {
      if (m.name != name) return;
      wrong = judge(ready, exact, m, asked, stability::run(m, ready, asked)).said == verdict::wrong;
    });
    return wrong;
  }

  void visit(program const& p) {
    judge_all(p, false);
    if (!p.contact()) judge_all(p.rounded(), true);
  }

  /// The methods for programs as they are, or for those that were rounded to floats.
  void judge_all(program const& p, bool rounded) {
    if (!is_wanted(p, rounded)) return;
    reference const exact = solve_in_quad(p);
    if (!exact.exact()) {
      // Rounding to floats may leave an indefinite A, or nothing but infinities and zeros.
      if (rounded) return;
      std::fprintf(stderr, "%s: bound %.1e of the reference, floor %.1e\n", p.name().c_str(),
                   exact.bound, exact.floor);
      std::printf("%s,%g,%s,%td,%.2g,%.2g,%.2g,,,,,inexact,,,,,,,\n", p.adversity.c_str(),
                  p.parameter, p.variant.c_str(), p.size(), exact.condition, exact.plain_condition,
                  exact.floor);
      ++inexact_;
      return;
    }
    // Rounded until it is singular a program is another one: what tells its rows apart is noise.
    if (rounded && !std::isfinite(exact.condition) && has_definite_original(p)) return;
    prepared const ready(p);
    for_each_method([&](method const& m) {
      if (!is_wanted(m, p, rounded)) return;
      for (double const tolerance : tolerances_)
        measure(p, ready, exact, m, request_at(tolerance, start_point::zero));
      if (!starts_) return;
      for (auto const start : {start_point::far, start_point::extreme, start_point::boundary})
        measure(p, ready, exact, m, request_at(1e-8, start));
    });
  }
  [[nodiscard]] request request_at(double tolerance, start_point start) const {
    return {.tolerance = tolerance, .start = start, .steps = steps_, .applications = applications_};
  }

  static bool has_definite_original(program const& p) {
    return std::isfinite(
        solve_in_quad(make_program(p.adversity, p.parameter, p.variant)).condition);
  }

  [[nodiscard]] bool is_wanted(method const& m, program const& p, bool rounded) const {
    return (method_.empty() || m.name == method_) && takes(m, p) &&
           (m.programs == scope::rounded) == rounded;
  }
  [[nodiscard]] bool is_wanted(program const& p, bool rounded) const {
    bool wanted = false;
    for_each_method([&](method const& m) { wanted = wanted || is_wanted(m, p, rounded); });
    return wanted;
  }

  void measure(program const& p, prepared const& ready, reference const& exact, method const& m,
               request const& asked) {
    static constexpr char const* starts[]{"zero", "1e16", "1e300", "boundary"};
    auto const begin = std::chrono::steady_clock::now();
    outcome const o = stability::run(m, ready, asked);
    double const seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    judgement const j = judge(ready, exact, m, asked, o);
    std::printf("%s,%g,%s,%td,%.2g,%.2g,%.2g,%s,%s,%g,%s,%s,%.3g,%.3g,%.3g,%.3g,%td,%td,%.3g\n",
                p.adversity.c_str(), p.parameter, p.variant.c_str(), p.size(), exact.condition,
                exact.plain_condition, j.floor, m.name.data(),
                starts[static_cast<int>(asked.start)], asked.tolerance,
                slant::to_string(o.status).data(), name_of(j.said).data(), j.error, j.ratio, j.kkt,
                o.claimed, o.iterations, o.applications, seconds);
    std::fflush(stdout);
    all_.add(o, j);
    if (j.said == verdict::wrong && asked.tolerance == 1e-8 && asked.start == start_point::zero &&
        m.programs != scope::rounded)
      wrong_.try_emplace({std::string(m.name), p.adversity}, p);
  }

  std::string adversity_, method_;
  std::vector<double> tolerances_;
  bool starts_;
  std::size_t variants_;
  slant::index steps_, applications_;
  bool shrink_;
  tally all_{};
  long inexact_ = 0;
  std::map<std::pair<std::string, std::string>, program> wrong_{};  ///< method, adversity
};

}  // namespace

int main(int argc, char** argv) {
  try {
    bench b(benchmarks::arguments(argc, argv,
                                  {"adversity", "method", "tolerances", "starts", "variants",
                                   "steps", "applications", "shrink"}));
    b.run();
    b.shrink();
    return b.report() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (std::exception const& e) {
    std::fprintf(stderr, "stability: %s\n", e.what());
    return 2;
  }
}
