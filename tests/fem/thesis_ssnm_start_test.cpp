// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/thesis_ssnm_start.hpp>
#include <fem/thesis_tables.hpp>
#include <fem/wire_counts.hpp>

namespace thesis_ssnm_start_test {

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
      auto const counts = fem::count_active(fem::wire_set(w, 0, row.g), w.A, w.b, r.run.x);
      for (auto const& printed : fem::printed_wire_counts) {
        if (printed.l != 0 || printed.g != row.g) continue;
        CHECK(counts == fem::active_counts{printed.bounds[entry], printed.circles[entry]});
      }
    }
  }
}

}  // namespace thesis_ssnm_start_test
