// SPDX-License-Identifier: MIT
//
// The natural residual with bounds and discs by all linear solvers, judged by the duality gap.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>

#include <newton/newton_scene.hpp>
#include <oracle/certificate.hpp>

#include <doctest/doctest.h>

namespace semismooth_newton_solvers_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int m = 8;
constexpr double smallest_radius = 1e-3;

oracle::dense_qp dense(newton_scene::data const& d) {
  oracle::dense_qp qp{.A = d.A, .b = d.b.cast<oracle::real>()};
  for (int i = 0; i < m; ++i) {
    qp.intervals.push_back({.at = i, .lower = 0});
    double const part = double(i) / (m - 1);
    qp.circles.push_back({.first = m + 2 * i,
                          .second = m + 2 * i + 1,
                          .radius = smallest_radius * std::pow(3 / smallest_radius, part)});
  }
  return qp;
}

TEST_CASE("all solvers and globalisations find the same solution, which is proved to be one") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const set = newton_scene::contact_set(m, smallest_radius);
  auto const F = slant::natural_residual(A, d.b, set, d.ρ);
  auto const stop = slant::residual_below(1e-14) || slant::at_most(60);
  auto const reference = slant::solve(slant::semismooth_newton{F}, d.zero(), stop);
  REQUIRE(reference.converged());
  auto const certificate = oracle::certify(dense(d), reference.x().cast<oracle::real>());
  CHECK(certificate.infeasibility <= 1e-13);
  CHECK(certificate.energy_error <= 1e-8);  // √ε: the gap is known to ε
  // Something of everything: free and active bounds, sticking and sliding discs.
  auto const G = F.slant(reference.x());
  auto const& state = slant::slant_of_projection(G);
  int free = 0, sticking = 0;
  for (int i = 0; i < m; ++i) {
    free += state.part<0>().block(i)(0, 0) > 0;
    sticking += state.part<1>().block(i) == MatrixXd(MatrixXd::Identity(2, 2));
  }
  REQUIRE((free > 0 && free < m && sticking < m));

  auto const check = [&](auto const& method) {
    auto const r = slant::solve(method, d.zero(), stop);
    CHECK(r.converged());
    CHECK(r.iterations() <= 20);
    CHECK((r.x() - reference.x()).norm() <= 1e-12 * reference.x().norm());
  };
  check(slant::semismooth_newton{F, slant::symmetrized_cg{.warm_start = true}});
  check(slant::semismooth_newton{F, slant::bicgstab_solver{}});
  check(slant::semismooth_newton{F, slant::bicgstab_solver{.warm_start = true}});
  check(slant::semismooth_newton{F, slant::direct_solver{}});
  check(slant::semismooth_newton{F, slant::by_laws{}, slant::halving_line_search{},
                                 slant::adaptive_precision{}});
  check(slant::semismooth_newton{F, slant::direct_solver{}, slant::full_step{}});
}

TEST_CASE("units do not matter: powers of two give the same bits") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const F =
      slant::natural_residual(A, d.b, newton_scene::contact_set(m, smallest_radius), d.ρ);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(60);
  auto const reference = slant::solve(slant::semismooth_newton{F}, d.zero(), stop);
  REQUIRE(reference.converged());
  for (int of_A : {0, 400, -400}) {
    for (int of_x : {0, 400, -400}) {
      MatrixXd const matrix = std::ldexp(1.0, of_A) * d.A;
      VectorXd const b = std::ldexp(1.0, of_A) * (std::ldexp(1.0, of_x) * d.b);
      auto const B = slant::matrix<slant::self_adjoint, slant::positive_definite>(matrix);
      auto const set = newton_scene::contact_set(m, smallest_radius, std::ldexp(1.0, of_x));
      auto const H = slant::natural_residual(B, b, set, std::ldexp(d.ρ, -of_A));
      auto const r = slant::solve(slant::semismooth_newton{H}, d.zero(), stop);
      CAPTURE(of_A);
      CAPTURE(of_x);
      CHECK(r.converged());
      CHECK(r.state.work == reference.state.work);
      CHECK(VectorXd(std::ldexp(1.0, -of_x) * r.x()) == reference.x());
    }
  }
}

}  // namespace semismooth_newton_solvers_test
