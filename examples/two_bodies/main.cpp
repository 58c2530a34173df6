// SPDX-License-Identifier: MIT
//
// Tables 5 and 6 of the lecture [K Ex 5, 6]: two plates and two bricks in contact with Tresca
// friction, the printed numbers beside ours.
#include <fem/lecture_tables.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/command_line.hpp>

#include "methods.hpp"
#include "runs.hpp"

namespace {

using two_bodies::cells;
using two_bodies::joined;

struct settings {
  std::vector<int> plates{60, 80};
  std::vector<int> bricks{16};
  examples::run_limits limits{};
  std::filesystem::path output{};
};

/// The row of a printed table for which `key` is `size`, or null.
template <class Table, class Row>
Row const* row_of(Table const& table, int Row::*key, int size) {
  for (auto const& row : table)
    if (row.*key == size) return &row;
  return nullptr;
}

std::string sizes(Eigen::Index unknowns, Eigen::Index m) {
  return std::to_string(unknowns) + "/" + std::to_string(m);
}

std::string printed(fem::printed_work const& work) {
  return std::to_string(work.steps) + "/" + std::to_string(work.products);
}

bool print_plates(settings const& s) {
  std::printf("\nTable 5, two plates in 2D; printed products for step lengths 1.9, 15, 20/σ_max\n");
  auto const methods = two_bodies::plane_methods();
  examples::text_table const table(
      joined({"n_u/m", "GIMSSN 1.9", "AS-S 1.9", "AS 1.9", "GIMSSN 15", "AS-S 20", "AS 15"},
             examples::names_of(methods)));
  table.print_head();
  auto problems = examples::make_ladder<2>(fem::make_two_plates);
  bool converged = true;
  for (int const k : s.plates) {
    auto const& problem = problems.at(k);
    cells line{sizes(problem.scene().K.rows(), 2 * problem.scene().contact_count())};
    auto const* const row = row_of(fem::lecture_table_5, &fem::lecture_plates::k, k);
    if (row == nullptr)
      line = joined(line, {"-", "-", "-", "-", "-", "-"});
    else
      for (int const products :
           {row->gimssn, row->as_s, row->as, row->gimssn_15, row->as_s_20, row->as_15})
        line.push_back(std::to_string(products));
    table.print_row(joined(line, two_bodies::run_row(methods, problems, k, s.limits, converged)));
  }
  if (!s.output.empty() && !s.plates.empty())
    two_bodies::draw(methods, problems.at(s.plates.back()), s.limits, s.output, "plates", "Pa");
  return converged;
}

bool print_bricks(settings const& s) {
  std::printf("\nTable 6, two bricks in 3D; printed steps/products for step lengths 1.9/σ_max\n");
  auto const methods = two_bodies::space_methods();
  examples::text_table const table(
      joined({"n_u/m", "SSN", "IMSSN", "GIMSSN"}, examples::names_of(methods)));
  table.print_head();
  auto problems = examples::make_ladder<3>(fem::make_two_bricks);
  bool converged = true;
  for (int const p : s.bricks) {
    auto const& problem = problems.at(p);
    cells line{sizes(problem.scene().K.rows(), problem.scene().contact_count())};
    auto const* const row = row_of(fem::lecture_table_6, &fem::lecture_bricks::p, p);
    if (row == nullptr)
      line = joined(line, {"-", "-", "-"});
    else
      line = joined(line, {printed(row->ssn), printed(row->imssn), printed(row->gimssn)});
    table.print_row(joined(line, two_bodies::run_row(methods, problems, p, s.limits, converged)));
  }
  if (!s.output.empty() && !s.bricks.empty())
    two_bodies::draw(methods, problems.at(s.bricks.back()), s.limits, s.output, "bricks", "MPa");
  return converged;
}

int print_tables(settings const& s, std::string const& scene) {
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  std::printf(
      "Two bodies with Tresca friction [K Ex 5, 6]; ours: steps/products to a relative\n"
      "accuracy of %g, from zero, and nested: from the solution on a mesh twice as coarse\n",
      s.limits.tolerance);
  bool converged = true;
  if (scene != "bricks") converged = print_plates(s);
  if (scene != "plates") converged = print_bricks(s) && converged;
  std::printf("\n%s\n", converged ? "all runs converged" : "some runs did not converge");
  return converged ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app(
      "Two plates and two bricks in contact: tables 5 and 6 of the lecture beside ours.",
      "two_bodies");
  settings s;
  std::string scene = "both";
  app.option("--scene", scene, "plates, bricks or both",
             examples::expects_one_of({"plates", "bricks", "both"}));
  app.option("--plates", s.plates, "k of 3k x k cells per plate; printed: 60 80 100 120 130",
             examples::expects<int>("a whole number from 2 to 1000",
                                    [](int k) { return k >= 2 && k <= 1000; }));
  app.option("--bricks", s.bricks,
             "p of p x (p-1) x (p-1) cells per brick; printed: 16 21 26 31 36 41",
             examples::expects<int>("a whole number from 2 to 100",
                                    [](int p) { return p >= 2 && p <= 100; }));
  app.option("--tolerance", s.limits.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.limits.max_iterations, "steps at most",
             examples::expects_at_least(0));
  app.option("--output", s.output, "folder for pictures of histories and of the contact",
             examples::expects_name());
  return app.run(argc, argv, [&] { return print_tables(s, scene); });
}
