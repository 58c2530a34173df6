// SPDX-License-Identifier: MIT
#include <slant/newton/newton.hpp>

#include <fem/thesis_ssnm.hpp>
#include <support/testing.hpp>

namespace ssnm_test {

/// Bounds 0 and circles of radius g.
auto program(fem::wire<> const& w, double g) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(w.A), w.b,
                             fem::wire_set(w, 0, g)};
}

/// Variant B, and its steps, allocate nothing.
TEST_CASE("variant B: BiCGSTAB on the whole system, nothing factored, nothing allocated") {
  auto const w = fem::make_thesis_wire(8);
  auto const qp = program(w, 0.5);
  slant::ssnm const method{qp, slant::bicgstab_solver{}, fem::thesis_options(1, 0.01, 0.9)};
  auto s = method.start(VectorXd::Zero(32).eval());
  method.step(s);
  slant::testing::allocation_guard guard;
  for (int i = 0; i < 4; ++i) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.iteration == 5);
  CHECK(s.work.factorizations == 0);
  for (int i = 0; i < 20 && !(s.step_norm <= 1e-8); ++i) method.step(s);
  // [T Table 4.8] prints 415 products, 11 iterations to 1e−6.
  CHECK(s.iteration <= 14);
  CHECK(s.work.operator_applications <= 600);
  auto const direct = fem::run_wire_ssnm(w, 0, 0.5, slant::saddle_direct{}, {});
  CHECK((s.x - direct.x).norm() <= 1e-6 * direct.x.norm());
  CHECK(s.active == 12);
  CHECK(s.x == s.y.head(32));
  CHECK(s.multipliers == s.y.tail(16));
}

TEST_CASE("the function of [T] with the generic Newton method ends at the same point") {
  auto const w = fem::make_thesis_wire(8);
  auto const set = fem::wire_set(w, 0, 0.5);
  auto const F = slant::kkt(w.A, w.b, set, 1.0);
  slant::semismooth_newton const method{F, slant::saddle_direct{}, slant::full_step{},
                                        slant::fixed_forcing{1e-10}};
  auto const r = slant::solve(method, test::zeros(F.cols()),
                              slant::residual_below(1e-12) || slant::at_most(50));
  REQUIRE(r.converged());
  auto const direct = fem::run_wire_ssnm(w, 0, 0.5, slant::saddle_direct{}, {});
  CHECK((r.x().head(32) - direct.x).norm() <= 1e-9 * direct.x.norm());
  CHECK(r.iterations() <= direct.iterations);
  CHECK(r.state.work.factorizations == r.iterations());
}

TEST_CASE("estimated multipliers: a solution is recognised as one") {
  auto const w = fem::make_thesis_wire(32);
  auto const qp = program(w, 0.3);
  auto const solution = fem::run_wire_ssnm(w, 0, 0.3, slant::saddle_direct{}, {});
  REQUIRE(solution.converged());
  VectorXd const x = slant::project(qp.set(), solution.x);
  slant::ssnm const method{
      qp, slant::saddle_direct{}, {.multipliers = slant::ssnm_multipliers::estimated}};
  auto s = method.start(x);
  CHECK(s.residual_norm <= 1e-6 * w.b.norm());
  CHECK(s.multipliers.minCoeff() >= 0);
  method.step(s);
  CHECK(s.step_norm <= 1e-6 * x.norm());
  // and those of another start are what is given
  VectorXd const z = VectorXd::LinSpaced(64, 0, 1);
  CHECK(method.start(x, z).multipliers == z);
}

TEST_CASE(
    "circles of radius 0 have no gradient at the solution: linear convergence, each step halves") {
  auto const w = fem::make_thesis_wire(4);
  auto const r = fem::run_wire_ssnm(w, 0, 0, slant::saddle_direct{}, {});
  CHECK(r.converged());
  CHECK(r.iterations >= 15);
  CHECK(r.x.segment(4, 8).norm() <= 2e-6 * (1 + r.x.norm()));
}

TEST_CASE("an empty choice: bounds at −∞, circles without end") {
  auto const w = fem::make_thesis_wire(4);
  auto const r = fem::run_wire_ssnm(w, -infinity, infinity, slant::saddle_direct{}, {});
  CHECK(r.converged());
  CHECK((w.A * r.x - w.b).norm() <= 1e-12 * w.b.norm());
}

TEST_CASE("at the last digits the run stalls, with a residual of rounding errors") {
  auto const w = fem::make_thesis_wire(8);
  auto const qp = program(w, 0.5);
  slant::ssnm const method{qp, slant::saddle_direct{}};
  std::optional owner(slant::ssnm{slant::separable_qp(qp), slant::saddle_direct{}});
  auto const copy = *owner;  // refers to nothing of the other one
  owner.reset();
  auto const r = slant::solve(copy, test::zeros(32), slant::at_most(100));
  CHECK((r.status == slant::status::stalled || r.status == slant::status::converged ||
         r.status == slant::status::iteration_limit));
  CHECK(r.state.residual_norm <= 1e-14 * r.state.residual_scale);
  auto const to =
      slant::solve(method, test::zeros(32), slant::residual_below(1e-12) || slant::at_most(100));
  CHECK(to.converged());
}

TEST_CASE("bad input") {
  auto const w = fem::make_thesis_wire(4);
  auto const qp = program(w, 1);
  auto const with = [&](slant::ssnm_options<double> const& o) {
    static_cast<void>(slant::ssnm{qp, slant::saddle_direct{}, o});
  };
  CHECK_THROWS_WITH_AS(with({.rho = 0}), "rho: got 0, expected a finite number > 0",
                       slant::bad_input);
  CHECK_THROWS_AS(with({.precision = {.r_tol = 2}}), slant::bad_input);
  CHECK_THROWS_AS(with({.inner_tolerance = -1}), slant::bad_input);
  slant::ssnm const method{qp, slant::saddle_direct{}};
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(3))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Constant(16, std::nan("")))),
                  slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(16), VectorXd::Zero(3))),
                  slant::bad_input);
}

}  // namespace ssnm_test
