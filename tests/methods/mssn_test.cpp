// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

namespace mssn_test {

using Eigen::VectorXd;

/// λ^(k+1) of [K (57)–(61)] with dense algebra: discs of radii g at the components (i, i+6).
VectorXd dense_step(test::example_one<double> const& p, VectorXd const& λ, double ρ) {
  Eigen::MatrixXd const A = p.A;
  VectorXd const z = λ - ρ * (A * λ - p.b);
  VectorXd next = VectorXd::Zero(12);
  std::vector<Eigen::Index> active, frozen;
  for (Eigen::Index i = 0; i < 6; ++i) {
    double const length = std::hypot(z(i), z(i + 6));
    for (auto j : {i, i + 6}) {
      (length <= p.g(i) ? active : frozen).push_back(j);
      if (length > p.g(i)) next(j) = p.g(i) / length * z(j);
    }
  }
  VectorXd const right = (p.b - A * next)(active);
  VectorXd const exact = Eigen::MatrixXd(A(active, active)).llt().solve(right);
  next(active) = exact;
  return next;
}

TEST_CASE("every step is that of the algorithm, done with dense algebra") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  auto const set = p.set();
  double const ρ = 0.3;
  slant::mssn const method{qp, {.forcing = {.tolerance = 1e-13}, .step_length = ρ}};
  auto s = method.start(p.zero());
  VectorXd λ = p.zero();
  int outside = 0;
  for (int k = 0; k < 12 && s.status == slant::status::running; ++k) {
    CAPTURE(k);
    λ = dense_step(p, λ, ρ);
    method.step(s);
    CHECK((s.x - slant::project(set, λ)).norm() <= 1e-11 * λ.norm());
    outside += s.outside.in_use;
    if (s.outside.in_use) CHECK((s.outside.x - λ).norm() <= 1e-11 * λ.norm());
  }
  CHECK(outside > 0);
  test::example_one_solution<double> const solution;
  CHECK((s.x - solution.x).norm() <= 1e-3 * solution.x.norm());
}

TEST_CASE("the parts combine freely: a projected start, unlimited CG, another forcing rule") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  using problem = decltype(qp);
  slant::modified_newton<problem&, slant::projected_start, slant::unlimited_cg,
                         slant::eisenstat_walker> const mixed{qp};
  auto const r =
      slant::solve(mixed, p.zero(), slant::reduced_gradient_below(1e-12) || slant::at_most(100));
  REQUIRE(r.converged());
  CHECK((r.x() - solution.x).norm() <= 1e-10 * solution.x.norm());
}

}  // namespace mssn_test
