// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <fem/string_1d.hpp>

namespace imssn_test {

using Eigen::VectorXd;

TEST_CASE("the inner accuracy is min(r_tol err/err⁰, c_fact tol), relative to err⁰") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  slant::imssn const method{qp, {.forcing = {.r_tol = 0.1, .c_fact = 0.9}}};
  auto s = method.start(p.zero());
  double const err0 = s.reduced_gradient_norm;
  double tol = 0.1 / 0.9;
  VectorXd φ(12);
  for (int k = 0; k < 8; ++k) {
    tol = std::min(0.1 * (s.reduced_gradient_norm / err0), 0.9 * tol);
    method.step(s);
    CHECK(s.forcing.last_tolerance == doctest::Approx(tol).epsilon(1e-14));
    CHECK(s.last_inner == slant::inner_end::accurate);
    if (s.outside.in_use) continue;
    s.face.keep(s.r, φ);
    CHECK(s.unit * φ.norm() <= tol * err0 * (1 + 1e-14));
  }
}

TEST_CASE("one step by hand: a bound is frozen, a free component solved for") {
  // A = [2 1; 1 2], b = (3, −3), x ≥ 0: z = −ρ r = ρ b, so component 2 is frozen at 0 and
  // component 1 becomes 3/2, where r = (0, 9/2): the solution.
  Eigen::MatrixXd const M{{2.0, 1.0}, {1.0, 2.0}};
  VectorXd const b{{3.0, -3.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  auto const set = slant::half_lines(2);
  slant::imssn const method{slant::separable_qp{A, b, set}};
  auto s = method.start(VectorXd::Zero(2));
  method.step(s);
  CHECK(s.x == VectorXd{{1.5, 0.0}});
  CHECK(s.inner_iterations == 1);
  CHECK(s.work.operator_applications == 2);  // the second one: r̃ = 0 by an r computed from x
  CHECK(s.status == slant::status::converged);
}

TEST_CASE("a sliding disc moves by one fixed step at a time: measured, not hidden") {
  // A = I: the exact rotation of x to b/‖b‖ takes one projection with ρ = 1, and many with less.
  VectorXd const b{{0.0, 1e3}}, x0{{1.0, 0.0}};
  auto const A = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Ones(2)));
  auto const set = slant::discs(VectorXd(VectorXd::Ones(1)));
  auto const qp = slant::separable_qp{A, b, set};
  auto const steps = [&](double ρ) {
    auto const r = slant::solve(slant::imssn{qp, {.step_length = ρ}}, x0,
                                slant::reduced_gradient_below(1e-8) || slant::at_most(10000));
    CHECK(r.converged());
    CHECK(r.state.work.inner_iterations == 0);
    return r.iterations();
  };
  CHECK(steps(1.0) <= 4);
  CHECK(steps(1e-3) >= 10);
  CHECK(steps(1e-4) >= 5 * steps(1e-3));
}

TEST_CASE("active sets that recur end as stalled, with a reason") {
  auto const wire = fem::make_wire(32);
  auto const set = slant::cartesian(slant::half_lines(VectorXd::Constant(32, 0.0).eval()),
                                    slant::discs(VectorXd::Constant(32, 0.1).eval()),
                                    slant::free_components(32));
  auto const qp = slant::separable_qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A), wire.b, set};
  VectorXd const zero = VectorXd::Zero(128);
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100000);
  auto const r = slant::solve(slant::imssn{qp, {.step_length = 30 * wire.h() / 4, .patience = 50}},
                              zero, stop);
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason.find("active sets may recur") != std::string::npos);
  CHECK(r.iterations() < 1000);
  // With a smaller parameter the same run converges.
  CHECK(
      slant::solve(slant::imssn{qp, {.step_length = 1.9 * wire.h() / 4}}, zero, stop).converged());
}

}  // namespace imssn_test
