// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <methods/wire_set.hpp>
#include <support/effort.hpp>

namespace interior_point_wire_test {

using Eigen::VectorXd;

TEST_CASE("cells of the wire's tables from zero: the printed numbers of active constraints") {
  std::size_t const entries = test::effort(3, 1);
  for (auto const& printed : fem::printed_wire_counts) {
    for (std::size_t entry = 0; entry < entries; ++entry) {
      auto const m = static_cast<Eigen::Index>(printed.m(entry));
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(m);
      auto const wire = fem::make_wire(m);
      auto const set = test::wire_set(m, printed.l, printed.g);
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A);
      slant::separable_qp const qp{A, wire.b, set};
      auto const r = slant::solve(slant::interior_point{qp}, VectorXd(VectorXd::Zero(4 * m)),
                                  slant::reduced_gradient_below(1e-10) || slant::at_most(100));
      CHECK(r.converged());
      CHECK(r.iterations() <= 40);
      if (printed.bounds[entry] != fem::wire_counts::not_printed) {
        CHECK(fem::count_active(set, wire.A, wire.b, r.x()) ==
              fem::active_counts{printed.bounds[entry], printed.circles[entry]});
      }
    }
  }
}

}  // namespace interior_point_wire_test
