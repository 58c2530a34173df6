// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <support/effort.hpp>

#include "wire_set.hpp"

namespace kprgp_wire_test {

TEST_CASE("KPRGP finds the printed numbers of active constraints of the wire up to n = 256") {
  for (auto const& printed : fem::printed_wire_counts)
    for (std::size_t entry = 0; printed.unknowns(entry) <= test::effort(256, 64); ++entry) {
      auto const m = static_cast<Eigen::Index>(printed.m(entry));
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(m);
      auto const wire = fem::make_wire(m);
      auto const set = test::wire_set(m, printed.l, printed.g);
      auto const qp = slant::separable_qp{
          slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
      auto const report =
          slant::solve(slant::kprgp{qp, {.step_length = 1.9 * wire.h() / 4}},
                       Eigen::VectorXd::Zero(4 * m).eval(),
                       slant::reduced_gradient_below(1e-9) || slant::at_most(100000));
      CHECK(report.converged());
      CHECK(report.state.work.setup_applications == 0);
      CHECK(fem::count_active(set, wire.A, wire.b, report.x()) ==
            fem::active_counts{printed.bounds[entry], printed.circles[entry]});
    }
}

}  // namespace kprgp_wire_test
