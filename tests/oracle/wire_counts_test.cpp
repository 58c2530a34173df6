// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/wire_counts.hpp>
#include <optional>
#include <oracle/wire_reference.hpp>
#include <support/effort.hpp>

namespace wire_counts_test {

TEST_CASE("the wire has the printed numbers of active and free constraints up to n = 256") {
  for (auto const& printed : fem::printed_wire_counts) {
    CAPTURE(printed.l);
    CAPTURE(printed.g);
    std::optional<oracle::wire_reference> coarse;
    for (std::size_t entry = 0; printed.unknowns(entry) <= test::effort(256, 64); ++entry) {
      CAPTURE(printed.unknowns(entry));
      auto solution =
          oracle::solve_wire(printed.m(entry), printed.l, printed.g, coarse ? &*coarse : nullptr);
      auto const counts = oracle::count_active(solution.qp, solution.report.x);
      CHECK(counts.intervals == printed.bounds[entry]);
      CHECK(counts.circles == printed.circles[entry]);
      // No constraint is so near to changing sides that rounding could decide: the least distance,
      // 2.6e-6 of the solution's size, belongs to l = -1 at n = 256, where the wire just touches.
      CHECK(counts.margin > 1e-6);
      CHECK(solution.report.residual < 1e-17);
      coarse = std::move(solution);
    }
  }
}

TEST_CASE("the classification does not depend on units") {
  auto const solution = oracle::solve_wire(16, 0, 0.3);
  for (double const length : {1e-12, 1e12}) {
    auto qp = solution.qp;
    for (auto& c : qp.intervals) c.lower *= length;
    for (auto& c : qp.circles) c.radius *= length;
    qp.A *= 1e5;
    qp.b *= 1e5L * length;
    auto const report = oracle::solve_dense(qp);
    auto const counts = oracle::count_active(qp, report.x);
    CHECK(counts.intervals == 14);
    CHECK(counts.circles == 9);
  }
}

}  // namespace wire_counts_test
