// SPDX-License-Identifier: MIT
//
// Tables 4.1–4.8 of the thesis [T §4.1]: the wire over a plane and through a tube. The printed
// active sets, iterations and products stand beside ours, from zero and by nested iteration.
#include <array>
#include <string>
#include <support/command_line.hpp>

#include "tables.hpp"

namespace {

int print_tables(wire_tables::settings const& s, std::string const& only) {
  wire_tables::table_printer tables(s);
  auto const wanted = [&](char const* name) { return only == "all" || only == name; };
  std::printf(
      "The wire of [T §4.1]; ours: products/steps to a relative accuracy of %g,\n"
      "from zero, and nested: on this mesh, from the solution on the mesh before\n",
      s.limits.tolerance);
  if (wanted("4.1"))
    tables.ssnm("Table 4.1: g = 2, no circle is active; printed iterations of SSNM",
                fem::thesis_table_4_1);
  if (wanted("4.2"))
    tables.ssnm("Table 4.2: l = 0; printed iterations of SSNM, × where it failed",
                fem::thesis_table_4_2);
  if (wanted("4.3"))
    tables.after_qpc("Table 4.3: l = 0; printed iterations of SSNM after (QPC)",
                     fem::thesis_table_4_3);
  if (wanted("4.4"))
    tables.after_qpc("Table 4.4: l = 0; printed iterations of SSNM after (QPC)",
                     std::array{fem::thesis_table_4_4});
  if (wanted("4.5")) tables.variants();
  if (wanted("4.6")) tables.precision_factors();
  if (wanted("4.7")) tables.penalties();
  std::printf("\n%s\n", tables.right()
                            ? "all runs converged, to the printed active sets"
                            : "some runs did not converge, or to other active sets (marked !)");
  return tables.right() ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("The wire: tables 4.1 to 4.8 of the thesis beside ours.",
                             "wire_tables");
  wire_tables::settings s;
  std::string table = "all";
  app.option("--unknowns", s.largest, "of the finest mesh; all coarser ones are printed too",
             examples::expects<int>("32, 64, 128, 256, 512, 1024 or 2048", [](int n) {
               return std::find(fem::wire_sizes.begin(), fem::wire_sizes.end(), n) !=
                      fem::wire_sizes.end();
             }));
  app.option("--table", table, "4.1 to 4.7 (4.5 and 4.8 are one), or all",
             examples::expects<std::string>("4.1 to 4.7, or all", [](std::string const& name) {
               return name == "all" || (name.size() == 3 && name >= "4.1" && name <= "4.7");
             }));
  app.option("--tolerance", s.limits.tolerance, "relative norm of the reduced gradient",
             examples::expects_tolerance());
  app.option("--max-iterations", s.limits.max_iterations, "steps at most",
             examples::expects_at_least(0));
  return app.run(argc, argv, [&] { return print_tables(s, table); });
}
