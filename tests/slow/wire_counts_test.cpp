// SPDX-License-Identifier: MIT
#include <fem/wire_counts.hpp>
#include <methods/nested_newton.hpp>
#include <oracle/certificate.hpp>
#include <oracle/wire_reference.hpp>
#include <support/testing.hpp>

namespace wire_counts_test {

TEST_CASE("the wire has the printed numbers of active and free constraints up to n = 2048") {
  for (auto const& printed : fem::printed_wire_counts) {
    CAPTURE(printed.l);
    CAPTURE(printed.g);
    std::optional<oracle::wire_reference> coarse;
    for (std::size_t entry = 0; entry < printed.bounds.size(); ++entry) {
      CAPTURE(printed.unknowns(entry));
      auto solution =
          oracle::solve_wire(printed.m(entry), printed.l, printed.g, coarse ? &*coarse : nullptr);
      auto const counts = oracle::count_active(solution.qp, solution.report.x);
      if (printed.bounds[entry] != fem::wire_counts::not_printed) {
        CHECK(counts.intervals == printed.bounds[entry]);
        CHECK(counts.circles == printed.circles[entry]);
      }
      // The distance from changing sides falls with the cube of the mesh width; it stays far above
      // the accuracy of the reference.
      CHECK(counts.margin > 1e-10);
      CHECK(oracle::certify(solution.qp, solution.report.x).energy_error < 1e-9);
      coarse = std::move(solution);
    }
  }
}

TEST_CASE("nested Newton on the wire: at most 6 steps on every mesh up to n = 2048") {
  test::check_nested_newton(7);
}

}  // namespace wire_counts_test
