// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/product.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace kprgp_statuses_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

auto spd(VectorXd const& d) {
  return slant::diagonal<slant::positive_definite>(VectorXd(d));
}

TEST_CASE("what the constraints absorb does not make the tolerance looser") {
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100);
  VectorXd const zero = VectorXd::Zero(2), one = VectorXd::Ones(2);
  for (double pressed : {-1.0, -1e9, -1e20}) {
    CAPTURE(pressed);
    VectorXd const b{{pressed, 1.0}};
    slant::separable_qp const qp{spd(one), b, slant::half_lines(2)};
    auto const r = slant::solve(slant::kprgp{qp}, zero, stop);
    CHECK(r.converged());
    CHECK((r.x() - VectorXd{{0.0, 1.0}}).norm() <= 1e-7);
  }
  // Nearly linear: the bounds decide, not A.
  slant::separable_qp const steep{spd(1e-9 * one), one, slant::intervals(one)};
  auto const r = slant::solve(slant::kprgp{steep}, zero, stop);
  CHECK(r.converged());
  CHECK(r.x() == one);
}

TEST_CASE("nor does a start far away") {
  MatrixXd M = 2 * MatrixXd::Identity(20, 20);
  M.diagonal(1).setConstant(-1);
  M.diagonal(-1).setConstant(-1);
  auto const A = test::spd(M);
  VectorXd const b = VectorXd::Zero(20);
  VectorXd lower = VectorXd::Constant(20, -std::numeric_limits<double>::infinity());
  lower(3) = 1;
  lower(11) = 2;
  slant::separable_qp const qp{A, b, slant::half_lines(lower)};
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(5000);
  auto const near = slant::solve(slant::kprgp{qp}, b, stop);
  REQUIRE(near.converged());
  for (double size : {1e4, 1e8, 1e12}) {
    auto const r = slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Constant(20, size)), stop);
    CHECK(r.converged());
    CHECK((r.x() - near.x()).norm() <= 1e-6);
  }
}

TEST_CASE("a solution next to the origin is found there, wherever the run starts") {
  VectorXd const d{{1.0, 2.0}}, zero = VectorXd::Zero(2);
  slant::separable_qp const qp{spd(d), zero, slant::half_lines(VectorXd(VectorXd::Ones(2)))};
  auto const r = slant::solve(slant::kprgp{qp}, VectorXd{{1e8, 1e8}},
                              slant::reduced_gradient_below(1e-12) || slant::at_most(10));
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  CHECK(r.x() == VectorXd::Ones(2));
}

TEST_CASE("a huge bound elsewhere, or a tiny step, does not make the first point the solution") {
  VectorXd const b{{0.0, 1.0}}, one = VectorXd::Ones(2);
  slant::separable_qp const qp{spd(one), b, slant::half_lines(VectorXd{{1e20, 0.0}})};
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100);
  for (auto const& options :
       {slant::kprgp_options<double>{}, slant::kprgp_options<double>{.step_length = 1e-12}}) {
    auto const r = slant::solve(slant::kprgp{qp, options}, VectorXd(VectorXd::Zero(2)), stop);
    CHECK(r.converged());
    CHECK(r.x()(1) == doctest::Approx(1));
  }
}

TEST_CASE("an operator that declares to be definite is never called unbounded") {
  for (double κ : {1e14, 1e16, 1e20}) {
    VectorXd const b = VectorXd::Ones(2);
    slant::separable_qp const qp{spd(VectorXd{{κ, 1.0}}), b, slant::free_components(2)};
    auto const r = slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Zero(2)),
                                slant::reduced_gradient_below(1e-12) || slant::at_most(100));
    CHECK(r.converged());
    CHECK(r.x()(0) == doctest::Approx(1 / κ));
    CHECK(r.x()(1) == doctest::Approx(1));
  }
}

TEST_CASE("a kernel is told from a soft direction by A, not by the step length asked for") {
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd{{1.0, 1e-7}}));
  VectorXd const b = VectorXd::Ones(2);
  slant::separable_qp const qp{A, b, slant::half_lines(2)};
  for (double step : {1.0, 1e-6, 1e-10}) {
    auto const r =
        slant::solve(slant::kprgp{qp, {.step_length = step}}, VectorXd(VectorXd::Zero(2)),
                     slant::reduced_gradient_below(1e-8) || slant::at_most(100));
    CHECK(r.converged());
    CHECK(r.x()(1) == doctest::Approx(1e7));
  }
}

TEST_CASE("an eigenvalue whose reciprocal is no number is refused by name") {
  VectorXd const one = VectorXd::Ones(1);
  slant::separable_qp const qp{spd(1e-310 * one), one, slant::intervals(one)};
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::kprgp(qp).start(one)),
      "A: got largest eigenvalue 1e-310, expected one whose reciprocal is a finite number > 0",
      slant::bad_input);
}

// Discs beside free components, A singular, b not in its range: a long way along the discs.
auto discs_beside_free_components() {
  return slant::cartesian(slant::discs(VectorXd(VectorXd::Ones(4))), slant::free_components(4));
}
struct slow_problem {
  MatrixXd M;
  VectorXd b;
  explicit slow_problem(unsigned seed) {
    VectorXd spectrum = VectorXd::Zero(12);
    spectrum.head(8) = test::log_spaced(8, 25);
    M = test::with_spectrum(spectrum, seed);
    VectorXd const x = test::random_vector(12, seed),
                   p = slant::project(discs_beside_free_components(), x);
    b = M * p + 0.1 * (x - p);
    VectorXd const y = test::random_vector(12, seed + 500);
    VectorXd const kernel = y - M.completeOrthogonalDecomposition().solve(M * y);
    b += 1e-3 * b.norm() / kernel.norm() * kernel;
  }
};

TEST_CASE("slow is not stalled: q still falls where the reduced gradient does not") {
  slow_problem const p(20);
  auto const A =
      slant::declare<slant::self_adjoint, slant::positive_semidefinite>(slant::matrix(p.M));
  slant::separable_qp const qp{A, p.b, discs_beside_free_components()};
  auto const q_after = [&](slant::index steps) {
    auto const r = slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Zero(12)),
                                slant::reduced_gradient_below(1e-10) || slant::at_most(steps));
    CHECK(r.status == slant::status::iteration_limit);
    VectorXd const x = r.x();
    return 0.5 * x.dot(p.M * x) - p.b.dot(x);
  };
  CHECK(q_after(6000) < q_after(2000));
}

}  // namespace kprgp_statuses_test
