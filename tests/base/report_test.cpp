// SPDX-License-Identifier: MIT
#include <slant/base/report.hpp>

#include <support/testing.hpp>
#include "iteration/toy_method.hpp"

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

/// The state of a method on vectors.
struct vector_state {
  VectorXd x;
  slant::index iteration;
  slant::status status;
  slant::work work;
};

template <class State>
std::string printed(slant::report<State> const& run) {
  std::ostringstream out;
  out << run;
  return out.str();
}

TEST_CASE("a report prints how it ended and what was spent, and nothing that is not there") {
  using slant::status;
  toy::state last;
  last.iteration = 7;
  CHECK(printed(slant::report<toy::state>{last, status::stalled, "because"}) ==
        "stalled: because\n"
        "  steps                  7\n");
  vector_state s{VectorXd::Zero(12), 9, status::running, {}};
  s.work = {.operator_applications = 51};
  CHECK(printed(slant::report<vector_state>{s, status::converged, "done"}) ==
        "converged: done\n"
        "  unknowns               12\n"
        "  steps                  9\n"
        "  applications of A      51\n");
  s.work = {.operator_applications = 0,
            .setup_applications = 20,
            .inner_iterations = 40,
            .factorizations = 3};
  CHECK(printed(slant::report<vector_state>{s, status::iteration_limit, "no more"}) ==
        "iteration_limit: no more\n"
        "  unknowns               12\n"
        "  steps                  9\n"
        "  inner steps            40\n"
        "  applications of A      0, and 20 before the first step\n"
        "  factorizations         3\n");
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
