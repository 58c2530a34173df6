// SPDX-License-Identifier: MIT
//
// The printed iterations of SSNM from zero [T Tables 4.1, 4.2] are reproduced, not only
// approximately.
#include <slant/newton/saddle_solvers.hpp>

#include <fem/thesis_ssnm.hpp>
#include <fem/thesis_ssnm_start.hpp>
#include <fem/thesis_tables.hpp>
#include <fem/wire_counts.hpp>
#include <support/testing.hpp>

namespace thesis_ssnm_test {

struct outcome {
  fem::ssnm_run run;
  fem::active_counts counts;
};

outcome run(std::size_t entry, double l, double g, slant::index most = 1000) {
  auto const w = fem::make_thesis_wire(fem::wire_sizes[entry] / 4);
  auto const set = fem::wire_set(w, l, g);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(w.A);
  auto r = fem::run_ssnm(slant::separable_qp{A, w.b, set}, slant::saddle_direct{}, {},
                         test::zeros(4 * w.m), 1e-6, most);
  auto const counts = fem::count_active(set, w.A, w.b, r.x);
  return {std::move(r), counts};
}

fem::active_counts printed_counts(std::size_t entry, double l, double g) {
  for (auto const& row : fem::printed_wire_counts)
    if (row.l == l && row.g == g) return {row.bounds[entry], row.circles[entry]};
  return {-1, -1};
}

/// The printed numbers of iterations that are at most `most`, for n = 32, 64, 128.
void check_table(std::array<fem::ssnm_iterations, 6> const& table, int most) {
  for (auto const& row : table) {
    for (std::size_t entry = 0; entry < 3; ++entry) {
      if (row.iterations[entry] == fem::failed || row.iterations[entry] > most) continue;
      CAPTURE(row.l);
      CAPTURE(row.g);
      CAPTURE(fem::wire_sizes[entry]);
      auto const [r, counts] = run(entry, row.l, row.g);
      CHECK(r.converged());
      CHECK(r.iterations == row.iterations[entry]);
      CHECK(counts == printed_counts(entry, row.l, row.g));
    }
  }
}

TEST_CASE("Tables 4.1 and 4.2: every number of iterations, of the second those up to 16") {
  check_table(fem::thesis_table_4_1, 1000);
  check_table(fem::thesis_table_4_2, 16);
}

TEST_CASE("a failure of Table 4.2 fails here as well, and says so") {
  auto const [r, counts] = run(1, 0, 0.3, 200);  // n = 64
  CHECK(r.status == slant::status::iteration_limit);
  CHECK(r.x.allFinite());
}

TEST_CASE("Table 4.3: from a first-order method all cells converge, those with × from zero too") {
  for (auto const& row : fem::thesis_table_4_3) {
    for (std::size_t entry = 0; entry < 3; ++entry) {
      CAPTURE(row.g);
      CAPTURE(fem::wire_sizes[entry]);
      auto const w = fem::make_thesis_wire(fem::wire_sizes[entry] / 4);
      auto const r = fem::run_started_wire_ssnm(w, 0, row.g);
      CHECK(r.run.converged());
      CHECK(r.run.iterations <= row.entries[entry].iterations + 4);
      CHECK(r.accuracy <= row.entries[entry].accuracy);
      CHECK(fem::count_active(fem::wire_set(w, 0, row.g), w.A, w.b, r.run.x) ==
            printed_counts(entry, 0, row.g));
    }
  }
}

}  // namespace thesis_ssnm_test
