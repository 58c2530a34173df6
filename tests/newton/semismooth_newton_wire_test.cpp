// SPDX-License-Identifier: MIT
//
// The wire [T §4.1] from a zero start, the cells that Table 4.2 marks by × included.
#include <slant/iteration/solve.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/slanting/natural_residual.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <support/effort.hpp>

#include "methods/wire_set.hpp"

namespace semismooth_newton_wire_test {

TEST_CASE("all printed numbers of active constraints up to n = 256, in at most 30 steps") {
  for (auto const& printed : fem::printed_wire_counts) {
    for (std::size_t entry = 0; printed.unknowns(entry) <= test::effort(256, 64); ++entry) {
      auto const m = static_cast<Eigen::Index>(printed.m(entry));
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(m);
      auto const wire = fem::make_wire(m);
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A);
      auto const set = test::wire_set(m, printed.l, printed.g);
      auto const F = slant::natural_residual(A, wire.b, set, 5 * wire.h());
      auto const r = slant::solve(slant::semismooth_newton{F, slant::sparse_direct_solver{}},
                                  Eigen::VectorXd::Zero(4 * m).eval(),
                                  slant::residual_below(1e-11) || slant::at_most(30));
      CHECK(r.converged());
      CHECK(r.state.work.operator_applications <= 2 * r.iterations() + 8);  // few halvings
      CHECK(fem::count_active(set, wire.A, wire.b, r.x()) ==
            fem::active_counts{printed.bounds[entry], printed.circles[entry]});
    }
  }
}

}  // namespace semismooth_newton_wire_test
