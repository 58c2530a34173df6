// SPDX-License-Identifier: MIT
//
// Obstacle problems of the literature on grids, matrix-free: elastic–plastic torsion, journal
// bearing, a membrane over an obstacle and between two; printed optimal values beside ours.
#include <algorithm>
#include <array>
#include <cstdio>
#include <fem/membrane_contact.hpp>
#include <fem/membrane_vtu.hpp>
#include <fem/plots/membrane_plot.hpp>
#include <ranges>
#include <support/command_line.hpp>
#include <support/measured.hpp>
#include <support/text_table.hpp>

#include "runs.hpp"

namespace {

using membranes::settings;

std::string formatted(char const* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// "100 × 100".
std::string grid_name(fem::rectangle_grid<> const& grid) {
  return std::to_string(grid.nx) + " × " + std::to_string(grid.ny);
}

template <class Report>
void print_level(examples::text_table const& table, std::string const& problem, settings const& s,
                 fem::membrane<> const& membrane, Report const& report) {
  auto const contact = fem::find_contact(membrane, report.x());
  auto const run = examples::measure(report);
  auto const printed = membranes::printed(problem, s, membrane.grid);
  auto const nodes = [&](fem::membrane_state state) {
    return std::to_string(contact.count(state));
  };
  table.print_row(
      {grid_name(membrane.grid), formatted("%.9g", fem::membrane_energy(membrane, report.x())),
       printed ? formatted("%g", printed->value) + " " + printed->source : "-",
       nodes(fem::membrane_state::on_lower), nodes(fem::membrane_state::free),
       nodes(fem::membrane_state::on_upper), std::to_string(run.steps),
       std::to_string(run.products),
       formatted("%.1e", report.state.reduced_gradient_norm / report.state.gradient_scale),
       std::string(to_string(run.status))});
}

void write_output(std::string const& problem, settings const& s, fem::membrane<> const& membrane,
                  Eigen::VectorXd const& v) {
  auto const contact = fem::find_contact(membrane, v);
  std::filesystem::path const folder(s.output);
  auto const file = folder / (problem + ".vtu");
  fem::write_membrane_vtu(file, membrane, v, contact);
  std::printf("wrote %s\n", file.string().c_str());
  auto const plot = fem::membrane_plot(folder / (problem + ".png"),
                                       problem + ", " + grid_name(membrane.grid) + " nodes",
                                       membrane, v, contact);
  std::printf("%s\n", plot.message.c_str());
}

template <class Method>
bool solve_problem(std::string const& problem, settings const& s, Method const& method) {
  auto const problems = membranes::make_levels(problem, s);
  auto const levels =
      std::views::iota(std::size_t(0), problems.size()) | std::views::transform([&](std::size_t l) {
        return membranes::membrane_level<Method>(method, s.limits, problems[l],
                                                 l == 0 ? nullptr : &problems[l - 1]);
      });
  auto const report = slant::solve_nested(levels, problems.front().zero());

  std::printf("\n%s, %s %s\n", problem.c_str(), method.name.c_str(),
              s.from_zero ? "from zero" : "by nested iteration");
  examples::text_table const table({"nodes", "value", "printed", "lower", "free", "upper", "steps",
                                    "products", "r. gradient", "status"},
                                   9);
  table.print_head();
  for (std::size_t l = 0; l < report.levels.size(); ++l)
    print_level(table, problem, s, problems[l].membrane(), report.levels[l]);
  if (!s.output.empty()) write_output(problem, s, problems.back().membrane(), report.x());
  return report.converged();
}

int solve_problems(settings const& s) {
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  bool all = true;
  for (std::string_view const name : membranes::problems) {
    std::string const problem(name);
    if (s.problem != "all" && s.problem != problem) continue;
    all = (s.method == "newton" ? solve_problem(problem, s, membranes::newton(s.limits.tolerance))
                                : solve_problem(problem, s, membranes::kprgp())) &&
          all;
  }
  std::printf("\n%s\n", all ? "all problems converged" : "not all problems converged");
  return all ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app(
      "Obstacle problems of the literature, with the numbers of nodes on their bounds.",
      "membranes");
  settings s;
  std::vector<std::string> names(membranes::problems.begin(), membranes::problems.end());
  names.emplace_back("all");
  app.option("--problem", s.problem, "torsion, bearing, lower_obstacle, double_obstacle or all",
             examples::expects_one_of(names));
  app.option("--method", s.method, "newton or kprgp",
             examples::expects_one_of({"newton", "kprgp"}));
  app.option("--size", s.size, "interior nodes in x and, if given, another number in y",
             examples::expects<int>("a whole number from 1 to 2000",
                                    [](int n) { return n >= 1 && n <= 2000; }),
             1, 2);
  app.option("--twist", s.twist, "c of the torsion; the literature has 5, 10 and 20",
             examples::expects<double>("a number > 0 below infinity",
                                       [](double c) { return c > 0 && c < HUGE_VAL; }));
  app.option(
      "--eccentricity", s.eccentricity, "ε of the bearing",
      examples::expects<double>("a number in (0, 1)", [](double ε) { return ε > 0 && ε < 1; }));
  app.flag("--from-zero", s.from_zero, "only the finest grid, from zero");
  app.option("--tolerance", s.limits.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.limits.max_iterations, "steps at most, on each grid",
             examples::expects_at_least(0));
  app.option("--output", s.output, "folder for a VTU file (ParaView) and a PNG of each problem",
             examples::expects_name());
  return app.run(argc, argv, [&] { return solve_problems(s); });
}
