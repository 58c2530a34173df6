// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fem/thesis_ssnm.hpp>
#include <slant/newton/saddle_solvers.hpp>

namespace schur_cg_test {

using Eigen::VectorXd;

TEST_CASE("variant C finds the solution of the wire, as LU does") {
  struct row {
    Eigen::Index m;
    fem::active_counts counts;
  };
  for (row const& printed : {row{8, {6, 4}}, row{16, {11, 5}}}) {
    auto const w = fem::make_thesis_wire(printed.m);
    auto const r =
        fem::run_wire_ssnm(w, 0, 1, slant::schur_cg{}, fem::thesis_options(1, 0.01, 0.9));
    auto const direct = fem::run_wire_ssnm(w, 0, 1, slant::saddle_direct{}, {});
    REQUIRE(direct.converged());
    CHECK(r.converged());
    CHECK((r.x - direct.x).norm() <= 1e-6 * direct.x.norm());
    CHECK(fem::count_active(fem::wire_set(w, 0, 1), w.A, w.b, r.x) == printed.counts);
  }
}

TEST_CASE("the same direction as by LU, whatever is active; here with a dense A") {
  auto const w = fem::make_thesis_wire(8);
  auto const set = fem::wire_set(w, -0.2, 0.6);
  auto const F = slant::kkt(Eigen::MatrixXd(w.A), w.b, set, 2.0);
  slant::schur_cg const cg;
  slant::saddle_direct const lu;
  for (double const shift : {-0.5, 0.0, 0.7}) {
    VectorXd y = VectorXd::LinSpaced(F.cols(), shift, 1.0);
    y.tail(F.multipliers()) = y.tail(F.multipliers()).cwiseMax(-0.1).eval();  // K stays definite
    VectorXd const f = slant::evaluate(F, y);
    auto const G = F.slant(y);
    VectorXd by_cg(F.cols()), by_lu(F.cols());
    auto p = cg.prepare(G, f);
    auto q = lu.prepare(G, f);
    auto const report = cg.solve(G, f, {1e-12, f.norm(), 0}, by_cg, p);
    CHECK(report.status == slant::status::converged);
    static_cast<void>(lu.solve(G, f, {0, f.norm(), 0}, by_lu, q));
    CHECK((by_cg - by_lu).norm() <= 1e-8 * by_lu.norm());
  }
}

TEST_CASE("K that is not definite is refused: a status with words, where A and LU go on") {
  auto const w = fem::make_thesis_wire(8);
  auto const r =
      fem::run_wire_ssnm(w, 0, 0.5, slant::schur_cg{}, fem::thesis_options(0.5, 0.01, 0.9));
  CHECK(r.status == slant::status::breakdown);
  CHECK(r.reason.find("definite") != std::string::npos);
  CHECK(r.x.allFinite());
}

}  // namespace schur_cg_test
