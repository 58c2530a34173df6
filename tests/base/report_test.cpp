// SPDX-License-Identifier: MIT
#include "iteration/toy_method.hpp"

#include <slant/base/report.hpp>

#include <doctest/doctest.h>

namespace report_test {

TEST_CASE("a report answers from its state, and only success is convergence") {
  using slant::status;
  for (status const s : {status::converged, status::iteration_limit, status::stalled,
                         status::unbounded, status::breakdown, status::interrupted}) {
    toy::state last;
    last.x = 0.25;
    last.iteration = 7;
    slant::report<toy::state> const r{last, s, "because"};
    CHECK(r.x() == 0.25);
    CHECK(r.iterations() == 7);
    CHECK(r.converged() == (s == status::converged));
    CHECK(!slant::to_string(s).empty());
    CHECK(slant::to_string(s) != "unknown");
  }
}

TEST_CASE("counts of work start at zero and compare") {
  slant::work a, b;
  CHECK(a == b);
  CHECK(a.operator_applications + a.setup_applications + a.inner_iterations + a.factorizations ==
        0);
  ++a.setup_applications;
  CHECK(a != b);
}

}  // namespace report_test
