// SPDX-License-Identifier: MIT
//
// The linear solvers of SSNM for saddle-point systems: Schur's complement by BiCGSTAB, variant A, and
// by CG, variant C.
#include <slant/newton/saddle_solvers.hpp>

#include <fem/thesis_ssnm.hpp>
#include <oracle/wire_reference.hpp>
#include <support/testing.hpp>

namespace saddle_solvers_test {

using slant::schur_bicgstab;
using slant::schur_cg;

struct row {
  Eigen::Index m;
  double g;
  fem::active_counts counts;
};

/// The run ends at the solution of the wire, with the printed numbers of active constraints.
template <class Solver>
fem::ssnm_run check_wire(row const& printed, Solver const& solver) {
  auto const w = fem::make_thesis_wire(printed.m);
  auto r = fem::run_wire_ssnm(w, 0, printed.g, solver, fem::thesis_options(1, 0.01, 0.9));
  VectorXd const exact =
      oracle::solve_wire(printed.m, 0, printed.g).report.x.template cast<double>();
  CHECK(r.converged());
  CHECK((r.x - exact).cwiseAbs().maxCoeff() <= 1e-6 * exact.cwiseAbs().maxCoeff());
  CHECK(fem::count_active(fem::wire_set(w, 0, printed.g), w.A, w.b, r.x) == printed.counts);
  return r;
}

TEST_CASE("both find the solution of the wire; the work of variant A is that of Table 4.8") {
  check_wire({8, 1, {6, 4}}, schur_cg{});
  check_wire({16, 1, {11, 5}}, schur_cg{});
  auto const with_work = [](row const& printed, slant::index products, slant::index iterations) {
    auto const r = check_wire(printed, schur_bicgstab{});
    CHECK(r.iterations <= iterations);
    CHECK(r.products <= 1.1 * static_cast<double>(products));
    CHECK(r.products >= 0.8 * static_cast<double>(products));
  };
  with_work({8, 0.5, {7, 5}}, 94, 10);
  with_work({16, 0.5, {13, 6}}, 137, 11);
}

TEST_CASE("with a relative precision nothing depends on the units of A and b") {
  auto const w = fem::make_thesis_wire(8);
  auto scaled = w;
  scaled.A *= std::ldexp(1.0, 40);
  scaled.b *= std::ldexp(1.0, 40);
  slant::ssnm_options<double> o{.rho = 1};
  auto const r = fem::run_wire_ssnm(w, 0, 1, schur_bicgstab{}, o);
  o.rho = std::ldexp(1.0, 40);
  auto const s = fem::run_wire_ssnm(scaled, 0, 1, schur_bicgstab{}, o);
  REQUIRE(r.converged());
  REQUIRE(s.converged());
  CHECK(r.iterations == s.iterations);
  CHECK((r.x - s.x).norm() <= 1e-12 * r.x.norm());
}

TEST_CASE("the report of variant A is true, and a direction comes with it") {
  auto const w = fem::make_thesis_wire(8);
  auto const set = fem::wire_set(w, 0, 0.5);
  auto const F = slant::kkt(w.A, w.b, set, 1.0);
  VectorXd const y = VectorXd::LinSpaced(F.cols(), -1, 1.5);
  VectorXd const f = slant::evaluate(F, y);
  auto const G = F.slant(y);
  schur_bicgstab const solver;
  auto prepared = solver.prepare(G, f);
  VectorXd dy(F.cols()), Gdy(F.cols());
  for (double const η : {0.1, 1e-8}) {
    auto const report = solver.solve(G, f, {η, f.norm()}, dy, prepared);
    slant::apply(G, dy, Gdy);
    CHECK(report.status == slant::status::converged);
    CHECK(report.factorizations == 1);
    CHECK((f + Gdy).norm() <= η * f.norm());
    CHECK(report.residual_norm == doctest::Approx((f + Gdy).norm()));
  }
}

TEST_CASE("variant C: the same direction as by LU, whatever is active; here with a dense A") {
  auto const w = fem::make_thesis_wire(8);
  auto const set = fem::wire_set(w, -0.2, 0.6);
  auto const F = slant::kkt(MatrixXd(w.A), w.b, set, 2.0);
  schur_cg const cg;
  slant::saddle_direct const lu;
  for (double const shift : {-0.5, 0.0, 0.7}) {
    VectorXd y = VectorXd::LinSpaced(F.cols(), shift, 1.0);
    y.tail(F.multipliers()) = y.tail(F.multipliers()).cwiseMax(-0.1).eval();  // K stays definite
    VectorXd const f = slant::evaluate(F, y);
    auto const G = F.slant(y);
    VectorXd by_cg(F.cols()), by_lu(F.cols());
    auto p = cg.prepare(G, f);
    auto q = lu.prepare(G, f);
    auto const report = cg.solve(G, f, {1e-12, f.norm()}, by_cg, p);
    CHECK(report.status == slant::status::converged);
    static_cast<void>(lu.solve(G, f, {0, f.norm()}, by_lu, q));
    CHECK((by_cg - by_lu).norm() <= 1e-8 * by_lu.norm());
  }
}

TEST_CASE("K that is singular, or for CG not definite, is a breakdown: no exception, no NaN") {
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(0, 0) = 1;
  A.insert(1, 1) = 1;
  auto const set = slant::discs(VectorXd{{1.0}});
  auto const F = slant::kkt(A, VectorXd{{1.0, 2.0}}, set, 1.0);
  VectorXd const y{{0.3, 0.1, -0.5}};  // K = (1 + 2 μ) I = 0
  VectorXd const f = slant::evaluate(F, y);
  auto const G = F.slant(y);
  schur_bicgstab const solver;
  auto prepared = solver.prepare(G, f);
  VectorXd dy = VectorXd::Constant(3, std::nan(""));
  CHECK(solver.solve(G, f, {1e-6, f.norm()}, dy, prepared).status == slant::status::breakdown);
  CHECK(dy.norm() == 0);

  auto const w = fem::make_thesis_wire(8);
  auto const r = fem::run_wire_ssnm(w, 0, 0.5, schur_cg{}, fem::thesis_options(0.5, 0.01, 0.9));
  CHECK(r.status == slant::status::breakdown);
  CHECK(r.reason.find("definite") != std::string::npos);
  CHECK(r.x.allFinite());
}

}  // namespace saddle_solvers_test
