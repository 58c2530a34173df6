// SPDX-License-Identifier: MIT
//
// Table 4.9 of the thesis [T §4.2] and Table 3 of the lecture [K Ex 3]: the steel brick on a rigid
// foundation. The tractions of the originals are not printed, so the printed numbers and ours
// belong to the same body and mesh but not to the same load.
#include <algorithm>
#include <cstdio>
#include <fem/contact_field.hpp>
#include <fem/steel_brick.hpp>
#include <fem/thesis_tables.hpp>
#include <iterator>
#include <string>
#include <support/command_line.hpp>
#include <support/problem_ladder.hpp>
#include <support/text_table.hpp>
#include <vector>

#include "methods.hpp"

namespace {

using cells = std::vector<std::string>;

struct settings {
  int largest = 6;
  std::string load = "all";
  examples::run_limits limits{};
};

/// products/iterations as the thesis prints it.
std::string printed(fem::printed_work const& work) {
  if (work.products < 0) return "×";
  return std::to_string(work.products) + "/" + std::to_string(work.steps);
}

/// Our columns for one mesh, and whether all runs converged.
template <class Ladder>
cells ours(Ladder& problems, int k, examples::run_limits const& limits, bool& converged) {
  cells result;
  examples::for_each_method(brick_tables::methods(), [&](auto const& method) {
    auto const add = [&](examples::measured const& run) {
      result.push_back(products_and_steps(run));
      converged = converged && (run.converged() || !method.ours);
    };
    add(examples::measure(examples::run_from_zero(method, problems.at(k), limits)));
    if (method.nested)
      add(examples::measure(examples::run_nested(method, problems.ladder(k), limits).finest()));
  });
  return result;
}

cells joined(cells a, cells const& b) {
  std::copy(b.begin(), b.end(), std::back_inserter(a));
  return a;
}

/// The rows k = 4 … 16 of one load: those of both documents.
bool print_load(fem::brick_load load, settings const& s) {
  auto problems = examples::make_ladder<3>(
      [load](int k) { return fem::make_steel_brick({.k = k, .load = load}); });
  std::printf("\nload \"%s\"\n", fem::name_of(load).data());
  examples::text_table const table(
      joined({"k", "n_u/m", "A", "B", "C", "KPRGP [K]", "PF(0.3,0.99)"},
             examples::names_of(brick_tables::methods())));
  table.print_head();
  bool converged = true;
  for (int k = 4; k <= s.largest; ++k) {
    auto const& variants = fem::thesis_table_4_9;
    auto const& lecture = fem::lecture_table_3;
    auto const of_thesis =
        std::find_if(variants.begin(), variants.end(), [&](auto const& row) { return row.k == k; });
    auto const of_lecture =
        std::find_if(lecture.begin(), lecture.end(), [&](auto const& row) { return row.k == k; });
    if (of_thesis == variants.end() && of_lecture == lecture.end()) continue;
    cells line{std::to_string(k),
               std::to_string(9 * k * (k + 1) * (k + 1)) + "/" + std::to_string(9 * k * (k + 1))};
    if (of_thesis == variants.end())
      line = joined(line, {"-", "-", "-"});
    else
      line = joined(line, {printed(of_thesis->a), printed(of_thesis->b), printed(of_thesis->c)});
    if (of_lecture == lecture.end())
      line = joined(line, {"-", "-"});
    else
      line = joined(line, {std::to_string(of_lecture->kprgp), printed(of_lecture->pf_03_099)});
    table.print_row(joined(line, ours(problems, k, s.limits, converged)));
  }
  return converged;
}

int print_tables(settings const& s) {
  std::printf(
      "Steel brick of 3k x k x k cells: [T Table 4.9] and [K Table 3]; the loads are ours, those\n"
      "of the documents are not printed. Products/steps to a relative accuracy of %g;\n"
      "nested: on this mesh, from the solution for k/2\n",
      s.limits.tolerance);
  bool converged = true;
  for (fem::brick_load const load : fem::brick_loads)
    if (s.load == "all" || s.load == fem::name_of(load))
      converged = print_load(load, s) && converged;
  std::printf("\n%s\n", converged ? "all runs converged" : "some runs did not converge");
  return converged ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("The steel brick: tables of the thesis and the lecture beside ours.",
                             "brick_tables");
  settings s;
  app.option("--cells", s.largest, "largest k of the 3k x k x k cells; rows from 4 on",
             examples::expects<int>("a whole number from 4 to 16",
                                    [](int k) { return k >= 4 && k <= 16; }));
  app.option("--load", s.load, "press, pull, lift or all",
             examples::expects_one_of({"press", "pull", "lift", "all"}));
  app.option("--tolerance", s.limits.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.limits.max_iterations, "steps at most",
             examples::expects_at_least(0));
  return app.run(argc, argv, [&] { return print_tables(s); });
}
