// SPDX-License-Identifier: MIT
#include "mixture.hpp"
#include "support/message.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <oracle/dense_newton.hpp>
#include <string>
#include <utility>

namespace symmetric_newton_statuses_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("where Newton's method fails KPRGP takes over, and hands back") {
  test::mixture const p(1e3);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  VectorXd const exact = oracle::solve_dense(p.plain()).x.cast<double>();
  // A search that is never content: every step with ‖F‖ above 1 % of the last one is a failure.
  slant::symmetric_newton_options<double> o;
  o.halvings = 0;
  o.sufficient = 0.99;
  auto const r = slant::solve(slant::symmetric_newton{qp, o}, VectorXd(VectorXd::Zero(20)),
                              slant::reduced_gradient_below(1e-11) || slant::at_most(5000));
  CHECK(r.converged());
  CHECK(r.state.descent.count() >= 1);
  CHECK((r.x() - exact).norm() <= 1e-8 * exact.norm());
  // σ_max once, however often it takes over.
  CHECK(r.state.work.setup_applications <= 20);
}

TEST_CASE(
    "no minimum, found at any takeover; in float a search ends where β is no number any more") {
  // Descent without end along (1, 1, 0); the third unknown alone has work to do.
  MatrixXd const M{{1.0, -1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 3.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b{{1.0, 1.0, 2.0}};
  slant::separable_qp const qp{A, b, slant::half_lines(3)};
  slant::symmetric_newton_options<double> o;
  o.halvings = 0;
  o.sufficient = 0.999;
  auto const r = slant::solve(slant::symmetric_newton{qp, o}, VectorXd(VectorXd::Zero(3)),
                              slant::reduced_gradient_below(1e-10) || slant::at_most(5000));
  CHECK(r.status == slant::status::unbounded);

  test::mixture const p(1e3);
  Eigen::MatrixXf const single = p.A.cast<float>();
  auto const Af = slant::matrix<slant::self_adjoint, slant::positive_definite>(single);
  Eigen::VectorXf const bf = p.b.cast<float>(), lower = p.lower.cast<float>(),
                        g = p.g.cast<float>();
  auto const set =
      slant::cartesian(slant::half_lines(lower), slant::discs(g), slant::free_components<float>(6));
  slant::symmetric_newton_options<float> of;
  of.sufficient = 0.95F;
  auto const rf = slant::solve(slant::symmetric_newton{slant::separable_qp{Af, bf, set}, of},
                               Eigen::VectorXf(Eigen::VectorXf::Zero(20)),
                               slant::reduced_gradient_below(1e-3F) || slant::at_most(5000));
  CHECK(rf.converged());
}

TEST_CASE("the precision is exhausted: stalled, at the floor") {
  for (double κ : {1e2, 1e8}) {
    CAPTURE(κ);
    test::mixture const p(κ);
    auto const A = test::spd(p.A);
    slant::separable_qp const qp{A, p.b, p.set()};
    auto const r = slant::solve(slant::symmetric_newton{qp}, VectorXd(VectorXd::Zero(20)),
                                slant::reduced_gradient_below(0.0) || slant::at_most(3000));
    CHECK((r.status == slant::status::stalled || r.status == slant::status::converged));
    CHECK(r.iterations() <= 1000);
    // 100 ε times what the entries of A x − b are rounded against.
    CHECK(r.state.reduced_gradient_norm <=
          100 * std::numeric_limits<double>::epsilon() * (p.b.norm() + p.A.norm() * r.x().norm()));
    CHECK(std::string(r.reason).size() > 10);
  }
}

TEST_CASE("no minimum: unbounded, with the direction") {
  // x₁ + x₂ costs nothing and its sum is wanted as large as possible.
  MatrixXd const M{{1.0, -1.0}, {-1.0, 1.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b = VectorXd::Ones(2);
  slant::separable_qp const qp{A, b, slant::half_lines(2)};
  auto const r = slant::solve(slant::symmetric_newton{qp}, VectorXd(VectorXd::Zero(2)),
                              slant::reduced_gradient_below(1e-10) || slant::at_most(1000));
  CHECK(r.status == slant::status::unbounded);
  REQUIRE(r.state.descent.state().has_value());
  VectorXd const d = -r.state.descent.state()->directions.p;
  CHECK((M * d).norm() <= 1e-12 * d.norm());
  CHECK(b.dot(d) > 0);
  CHECK(d.minCoeff() >= 0);
}

TEST_CASE("a matrix that breaks its promise is no convergence") {
  MatrixXd const M = VectorXd{{1.0, -1.0, 1.0}}.asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  VectorXd const b{{1.0, 1.0, 1.0}};
  slant::separable_qp const qp{A, b, slant::free_components(3)};
  auto const message = test::complaint([&] {
    auto const r =
        slant::solve(slant::symmetric_newton{qp, {.step_length = 0.3}}, VectorXd(VectorXd::Zero(3)),
                     slant::reduced_gradient_below(1e-10) || slant::at_most(1000));
    CHECK_FALSE(r.converged());
    CHECK(r.status != slant::status::running);
  });
  CHECK((message == "nothing thrown" || message.find("semidefinite") != std::string::npos));
}

TEST_CASE("slip bounds of zero and infinity, discs that are hardly touched") {
  auto const A = test::spd(test::with_spectrum(test::log_spaced(8, 50), 4));
  VectorXd const b = 2 * test::random_vector(8, 9);
  VectorXd const free = MatrixXd(test::with_spectrum(test::log_spaced(8, 50), 4)).ldlt().solve(b);
  VectorXd const zero = VectorXd::Zero(8);
  auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(100);
  auto const solve_with = [&](VectorXd const& g) {
    return slant::solve(slant::symmetric_newton{slant::separable_qp{A, b, slant::discs(g)}}, zero,
                        stop);
  };
  auto const none = solve_with(VectorXd::Zero(4));
  CHECK(none.converged());
  CHECK(none.x() == zero);
  auto const all = solve_with(VectorXd::Constant(4, infinity));
  CHECK(all.converged());
  CHECK((all.x() - free).norm() <= 1e-10 * free.norm());
  // The free solution lies exactly on the boundary of every disc: weak contact.
  VectorXd g(4);
  for (int i = 0; i < 4; ++i) g(i) = free.segment<2>(2 * i).norm();
  auto const weak = solve_with(g);
  CHECK(weak.converged());
  CHECK((weak.x() - free).norm() <= 1e-10 * free.norm());
}

TEST_CASE("bad input names argument, value and expectation") {
  VectorXd const one = VectorXd::Ones(2);
  auto const A = slant::diagonal<slant::positive_definite>(one);
  slant::separable_qp const qp{A, one, slant::half_lines(2)};
  slant::symmetric_newton const method{qp};
  CHECK(test::complaint([&] { static_cast<void>(method.start(VectorXd(VectorXd::Zero(3)))); }) ==
        "x0: got 3, expected the size of b, 2");
  CHECK(test::complaint([&] {
          static_cast<void>(method.start(VectorXd{{1.0, nan}}));
        }).starts_with("x0[1]: got nan"));
  auto const wrong = slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Ones(3)));
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, wrong};
        }) == "rows of the preconditioner: got 3, expected size 2");
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, {.step_length = -1.0}};
        }) == "step_length: got -1, expected a number > 0");
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, {.step_factor = nan}};
        }).starts_with("step_factor: got nan"));
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, {.inner_steps = 0}};
        }).starts_with("inner_steps: got 0"));
  CHECK(test::complaint([&] {
          slant::symmetric_newton const m{qp, {.sufficient = 1.0}};
        }).starts_with("sufficient: got 1"));
}

}  // namespace symmetric_newton_statuses_test
