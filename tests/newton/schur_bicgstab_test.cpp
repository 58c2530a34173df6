// SPDX-License-Identifier: MIT
#include "saddle_scene.hpp"

namespace schur_bicgstab_test {

using Eigen::VectorXd;

TEST_CASE("variant A finds the solution of the wire; its work is that of Table 4.8") {
  struct row {
    Eigen::Index m;
    fem::active_counts counts;
    slant::index products, iterations;  // printed
  };
  for (row const& printed : {row{8, {7, 5}, 94, 10}, row{16, {13, 6}, 137, 11}}) {
    auto const w = fem::make_thesis_wire(printed.m);
    auto const reference = oracle::solve_wire(printed.m, 0, 0.5);
    auto const r =
        fem::run_wire_ssnm(w, 0, 0.5, slant::schur_bicgstab{}, fem::thesis_options(1, 0.01, 0.9));
    test::check_wire(r, reference, w, 0, 0.5, printed.counts);
    CHECK(r.iterations <= printed.iterations);
    CHECK(r.products <= 1.1 * static_cast<double>(printed.products));
    CHECK(r.products >= 0.8 * static_cast<double>(printed.products));
  }
}

TEST_CASE("with a relative precision nothing depends on the units of A and b") {
  auto const w = fem::make_thesis_wire(8);
  auto scaled = w;
  scaled.A *= std::ldexp(1.0, 40);
  scaled.b *= std::ldexp(1.0, 40);
  slant::ssnm_options<double> o{.rho = 1};
  auto const r = fem::run_wire_ssnm(w, 0, 1, slant::schur_bicgstab{}, o);
  o.rho = std::ldexp(1.0, 40);
  auto const s = fem::run_wire_ssnm(scaled, 0, 1, slant::schur_bicgstab{}, o);
  REQUIRE(r.converged());
  REQUIRE(s.converged());
  CHECK(r.iterations == s.iterations);
  CHECK((r.x - s.x).norm() <= 1e-12 * r.x.norm());
}

TEST_CASE("the report is true, and a direction comes with it") {
  auto const w = fem::make_thesis_wire(8);
  auto const set = fem::wire_set(w, 0, 0.5);
  auto const F = slant::kkt(w.A, w.b, set, 1.0);
  VectorXd y = VectorXd::LinSpaced(F.cols(), -1, 1.5);
  VectorXd const f = slant::evaluate(F, y);
  auto const G = F.slant(y);
  slant::schur_bicgstab const solver;
  auto prepared = solver.prepare(G, f);
  VectorXd dy(F.cols());
  for (double const η : {0.1, 1e-8}) {
    auto const report = solver.solve(G, f, {η, f.norm(), 0}, dy, prepared);
    VectorXd Gdy(F.cols());
    slant::apply(G, dy, Gdy);
    CHECK(report.status == slant::status::converged);
    CHECK(report.factorizations == 1);
    CHECK((f + Gdy).norm() <= η * f.norm());
    CHECK(report.residual_norm == doctest::Approx((f + Gdy).norm()));
  }
}

TEST_CASE("K that is singular has no factors: breakdown, no exception, no NaN") {
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(0, 0) = 1;
  A.insert(1, 1) = 1;
  auto const set = slant::discs(VectorXd{{1.0}});
  auto const F = slant::kkt(A, VectorXd{{1.0, 2.0}}, set, 1.0);
  VectorXd const y{{0.3, 0.1, -0.5}};  // K = (1 + 2 μ) I = 0
  VectorXd const f = slant::evaluate(F, y);
  auto const G = F.slant(y);
  slant::schur_bicgstab const solver;
  auto prepared = solver.prepare(G, f);
  VectorXd dy = VectorXd::Constant(3, std::nan(""));
  auto const report = solver.solve(G, f, {1e-6, f.norm(), 0}, dy, prepared);
  CHECK(report.status == slant::status::breakdown);
  CHECK(dy.norm() == 0);
}

}  // namespace schur_bicgstab_test
