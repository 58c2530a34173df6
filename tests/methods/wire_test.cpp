// SPDX-License-Identifier: MIT
//
// The wire [T §4.1] from zero: every method finds the printed numbers of active constraints, the
// cells where the thesis failed included; from coarser meshes; and the brick. Others than these run
// in tests/scenes.
#include <slant/slant.hpp>

#include <fem/active_counts.hpp>
#include <fem/thesis_ssnm.hpp>
#include <fem/wire_counts.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "brick_runs.hpp"
#include "nested_newton.hpp"

namespace wire_test {

/// run(program, wire) for the first `entries` cells of each row of the tables.
template <class Run>
void check_cells(std::size_t entries, Run const& run) {
  for (auto const& printed : fem::printed_wire_counts) {
    for (std::size_t entry = 0; entry < entries; ++entry) {
      Eigen::Index const m = printed.m(entry);
      CAPTURE(printed.l);
      CAPTURE(printed.g);
      CAPTURE(m);
      auto const wire = fem::make_wire(m);
      auto const set = fem::wire_set(wire, printed.l, printed.g);
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A);
      auto const r = run(slant::separable_qp{A, wire.b, set}, wire);
      CHECK(r.converged());
      if (printed.bounds[entry] == fem::wire_counts::not_printed) continue;
      CHECK(fem::count_active(set, wire.A, wire.b, r.x()) ==
            fem::active_counts{printed.bounds[entry], printed.circles[entry]});
    }
  }
}

VectorXd zero(fem::wire<> const& wire) {
  return VectorXd::Zero(wire.b.size());
}

TEST_CASE("mssn") {
  check_cells(2, [](auto const& qp, auto const& wire) {
    return test::minimise(slant::mssn{qp, {.step_length = 1.9 * wire.h() / 4}}, zero(wire), 1e-9,
                          20000);
  });
}

TEST_CASE("symmetric_newton with A⁻¹: no descent step is needed") {
  check_cells(test::effort(7, 3), [](auto const& qp, auto const& wire) {  // n = 2048 or 128
    slant::symmetric_newton const method{
        qp, slant::inverse(slant::ldlt(wire.A)), {.step_factor = 2.0}};
    auto const r = test::minimise(method, zero(wire), 1e-10, 400);
    CHECK(r.state.descent.count() == 0);
    // The thesis needs up to 223 steps where bounds alone are active; the front moves by a node.
    CHECK(r.iterations() <= 8 + wire.m / 2);
    return r;
  });
}

TEST_CASE("symmetric_newton: error 1e-8 within 250 products, half of them with a preconditioner") {
  for (auto const load : fem::brick_loads)
    test::check_newton_brick(test::effort(4, 2), load, 250, 125);
}

TEST_CASE("interior_point: error 1e-6 in 30 steps and 300 products") {
  for (auto const load : fem::brick_loads) {
    for (int k = 2; k <= test::effort(4, 2); ++k) {
      test::check_brick(
          k, load, {1e-6, 300, 1e-7, 30}, [](auto const&, auto const& dual, auto const& watch) {
            auto const qp = dual.qp();
            return slant::solve(slant::interior_point{qp}, dual.zero(),
                                slant::reduced_gradient_below(1e-9) || slant::at_most(60), watch);
          });
    }
  }
}

TEST_CASE("nested Newton on the wire: at most 6 steps on every mesh up to n = 256") {
  test::check_nested_newton(4);
}

}  // namespace wire_test
