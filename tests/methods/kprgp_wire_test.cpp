// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <fem/string_1d.hpp>
#include <oracle/wire_counts.hpp>

namespace {

struct active_counts {
  int bounds = 0;
  int circles = 0;
};

// Active: a gradient step of one over the diagonal entry leaves the constraint.
active_counts count_active(fem::wire<> const& w, double l, double g, Eigen::VectorXd const& x) {
  Eigen::VectorXd const z = x - (w.A * x - w.b).cwiseQuotient(w.A.diagonal());
  active_counts n;
  for (Eigen::Index i = 0; i < w.m; ++i) {
    n.bounds += z(i) < l;
    n.circles += std::hypot(z(w.m + 2 * i), z(w.m + 2 * i + 1)) > g;
  }
  return n;
}

TEST_CASE("the wire has the printed numbers of active constraints up to n = 256") {
  for (auto const& printed : oracle::printed_wire_counts) {
    for (std::size_t entry = 0; printed.unknowns(entry) <= 256; ++entry) {
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(printed.unknowns(entry));
      auto const w = fem::make_wire(printed.m(entry));
      auto const a = slant::matrix<slant::law::self_adjoint, slant::law::positive_definite>(w.A);
      auto const set = slant::cartesian(slant::power(slant::half_line<>{printed.l}, w.m),
                                        slant::power(slant::ball<2>{printed.g}, w.m),
                                        slant::free_components(w.m));
      auto const qp = slant::separable_qp{a, w.b, set};
      auto const r = slant::solve(slant::kprgp{qp}, Eigen::VectorXd(Eigen::VectorXd::Zero(4 * w.m)),
                                  slant::reduced_gradient_below(1e-10) || slant::at_most(200000));
      REQUIRE(r.converged());
      auto const counts = count_active(w, printed.l, printed.g, r.x());
      CHECK(counts.bounds == printed.bounds[entry]);
      CHECK(counts.circles == printed.circles[entry]);
    }
  }
}

}  // namespace
