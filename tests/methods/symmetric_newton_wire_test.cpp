// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <support/effort.hpp>

#include "wire_set.hpp"

namespace symmetric_newton_wire_test {

using Eigen::VectorXd;

/// Converged to 1e-10 from zero with the printed numbers of active constraints; Newton steps.
slant::index check_cell(fem::wire_counts const& printed, std::size_t entry) {
  auto const m = static_cast<Eigen::Index>(printed.m(entry));
  CAPTURE(printed.l);
  CAPTURE(printed.g);
  CAPTURE(m);
  auto const wire = fem::make_wire(m);
  auto const set = test::wire_set(m, printed.l, printed.g);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A);
  slant::separable_qp const qp{A, wire.b, set};
  auto const r = slant::solve(
      slant::symmetric_newton{qp, slant::inverse(slant::ldlt(wire.A)), {.step_factor = 2.0}},
      VectorXd(VectorXd::Zero(4 * m)), slant::reduced_gradient_below(1e-10) || slant::at_most(400));
  CHECK(r.converged());
  CHECK(r.state.descent.count() == 0);
  if (printed.bounds[entry] != fem::wire_counts::not_printed) {
    CHECK(fem::count_active(set, wire.A, wire.b, r.x()) ==
          fem::active_counts{printed.bounds[entry], printed.circles[entry]});
  }
  return r.iterations();
}

TEST_CASE("every cell of the wire's tables from zero, those where the thesis failed included") {
  std::size_t const entries = test::effort(7, 3);  // n = 2048 or 128
  for (auto const& printed : fem::printed_wire_counts) {
    for (std::size_t entry = 0; entry < entries; ++entry) {
      // The thesis needs up to 223 steps where bounds alone are active; the front moves by a node.
      CHECK(check_cell(printed, entry) <= 8 + printed.m(entry) / 2);
    }
  }
}

}  // namespace symmetric_newton_wire_test
