// SPDX-License-Identifier: MIT
//
// What MSSN, IMSSN and GIMSSN have in common: the solution and the counts.
#include "mixture.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>
#include <string>

namespace modified_newton_test {

using Eigen::VectorXd;
using test::mixture;

/// f(name, method) for the three of them.
template <class QP, class F>
void for_each_method(QP const& qp, F&& f) {
  f(std::string("mssn"), slant::mssn{qp});
  f(std::string("imssn"), slant::imssn{qp});
  f(std::string("gimssn"), slant::gimssn{qp});
}

TEST_CASE("all kinds of blocks: agreement with Newton's method on dense data") {
  mixture const p(30);
  auto const reference = oracle::solve_dense(p.plain());
  auto const A = test::spd(p.A);
  auto const qp = slant::separable_qp{A, p.b, p.set()};
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = slant::solve(method, VectorXd(VectorXd::Constant(20, 1e6)),
                                slant::reduced_gradient_below(1e-13) || slant::at_most(1000));
    REQUIRE(r.converged());
    CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-10 * r.x().norm());
    VectorXd const x = r.x();
    CHECK(oracle::certify(p.plain(), x.cast<long double>()).energy_error < 1e-6);
  });
}

TEST_CASE("one product for an inner iteration, one for a start, one where λ has left the set") {
  mixture const p(300);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  auto const counting = slant::counted(A);
  auto const qp = slant::separable_qp{counting, p.b, set};
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const before = counting.applications();
    auto s = method.start(VectorXd::Zero(20));
    CHECK(counting.applications() - before == s.work.setup_applications + 1);  // P_Λ(0) ≠ 0
    slant::index inner = 0, starts = 0, left = 0, total = s.work.operator_applications;
    for (int k = 0; k < 40 && s.status == slant::status::running; ++k) {
      method.step(s);
      inner += s.inner_iterations;
      slant::index const others = s.work.operator_applications - total - s.inner_iterations;
      bool outside = false;
      if constexpr (requires { s.outside.in_use; }) outside = s.outside.in_use;
      left += outside;
      CHECK(others - outside >= 0);
      CHECK(others - outside <= 1);
      starts += others - outside;
      total = s.work.operator_applications;
      // r is that of x, although no product was spent on it.
      VectorXd const r = p.A * s.x - p.b;
      CHECK((s.unit * s.r - r).norm() <= 1e-12 * (r.norm() + p.b.norm()));
      CHECK(set.contains(s.x));
    }
    CHECK(inner > 20);
    CHECK(s.work.inner_iterations == inner);
    CHECK(total == 1 + inner + starts + left);
    CHECK(counting.applications() - before == total + s.work.setup_applications);
  });
}

TEST_CASE("a start that keeps λ keeps its gradient as well") {
  // No constraint is felt: nothing is ever frozen, so CG goes on from where it was.
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = test::random_vector(20);
  auto const A = test::spd(M);
  auto const qp = slant::separable_qp{A, b, slant::free_components(20)};
  auto const r = slant::solve(slant::imssn{qp}, VectorXd(VectorXd::Zero(20)),
                              slant::reduced_gradient_below(1e-9) || slant::at_most(40));
  REQUIRE(r.converged());
  CHECK((r.x() - VectorXd(M.ldlt().solve(b))).norm() <= 1e-6 * r.x().norm());
  // One more computes r from x before success is claimed.
  CHECK(r.state.work.operator_applications <=
        r.state.work.inner_iterations + 1 + r.state.work.inner_iterations / 50);
}

TEST_CASE("a limit of inner iterations is kept, and does not end the run") {
  mixture const p(300);
  auto const A = test::spd(p.A);
  auto const qp = slant::separable_qp{A, p.b, p.set()};
  auto const r = slant::solve(slant::gimssn{qp, {.max_inner = 2}}, VectorXd(VectorXd::Zero(20)),
                              slant::reduced_gradient_below(1e-8) || slant::at_most(5000));
  CHECK(r.converged());
  CHECK(r.state.work.inner_iterations <= 2 * r.iterations());
}

TEST_CASE("a face without a minimum: IMSSN breaks down, GIMSSN goes to the boundary") {
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd{{1.0, 0.0}}));
  VectorXd const b{{1.0, 1.0}}, zero = VectorXd::Zero(2);
  auto const set = slant::intervals(VectorXd{{5.0, 5.0}});
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(100);
  auto const qp = slant::separable_qp{A, b, set};
  auto const i = slant::solve(slant::imssn{qp, {.step_length = 1.9}}, zero, stop);
  CHECK(i.status == slant::status::breakdown);
  CHECK(i.x().allFinite());
  auto const g = slant::solve(slant::gimssn{qp, {.step_length = 1.9}}, zero, stop);
  REQUIRE(g.converged());
  CHECK(g.x()(0) == doctest::Approx(1));
  CHECK(g.x()(1) == 5.0);
}

}  // namespace modified_newton_test
