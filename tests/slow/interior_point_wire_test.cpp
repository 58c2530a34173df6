// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
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
      auto const set = slant::cartesian(slant::half_lines(VectorXd::Constant(m, printed.l).eval()),
                                        slant::discs(VectorXd::Constant(m, printed.g).eval()),
                                        slant::free_components(m));
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
