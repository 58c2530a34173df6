// SPDX-License-Identifier: MIT
//
// MSSN on the wire; its relatives run in tests/scenes.
#include <slant/iteration/solve.hpp>

#include <slant/methods/mssn.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>

#include "wire_set.hpp"

namespace mssn_wire_test {

using Eigen::VectorXd;

TEST_CASE("the wire: the printed numbers of active constraints for n = 32 and 64") {
  auto const stop = slant::reduced_gradient_below(1e-9) || slant::at_most(20000);
  for (auto const& printed : fem::printed_wire_counts) {
    for (std::size_t entry = 0; printed.unknowns(entry) <= 64; ++entry) {
      auto const m = static_cast<Eigen::Index>(printed.m(entry));
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(m);
      auto const wire = fem::make_wire(m);
      auto const set = test::wire_set(m, printed.l, printed.g);
      auto const qp = slant::separable_qp{
          slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
      VectorXd const zero = VectorXd::Zero(4 * m);
      double const ρ = 1.9 * wire.h() / 4;
      auto const r = slant::solve(slant::mssn{qp, {.step_length = ρ}}, zero, stop);
      CHECK(r.converged());
      CHECK(fem::count_active(set, wire.A, wire.b, r.x()) ==
            fem::active_counts{printed.bounds[entry], printed.circles[entry]});
    }
  }
}

}  // namespace mssn_wire_test
