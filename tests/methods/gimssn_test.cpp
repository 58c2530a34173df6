// SPDX-License-Identifier: MIT
#include "example_one.hpp"
#include "mixture.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gimssn_test {

using Eigen::VectorXd;
using test::mixture;

double q_of(Eigen::MatrixXd const& A, VectorXd const& b, VectorXd const& x) {
  return x.dot(0.5 * (A * x) - b);
}

TEST_CASE("q falls in every step, and all iterates lie in the set") {
  mixture const p(1000);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  int half_steps = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    VectorXd const x0 = 100 * test::random_vector(20, seed);
    double last = std::numeric_limits<double>::infinity();
    int seen = 0;
    for (auto const& s : slant::iterates(slant::gimssn{qp}, x0)) {
      CHECK(set.contains(s.x));
      double const q = q_of(p.A, p.b, s.x);
      CHECK(q <= last + 1e-13 * std::abs(last));
      last = q;
      half_steps += s.last_inner == slant::inner_end::boundary;
      if (++seen == 60) break;
    }
    CHECK(seen > 20);
  }
  CHECK(half_steps > 20);
}

TEST_CASE("the bounds of Theorem 7, on both sides of 1/σ_max") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  Eigen::MatrixXd const M = p.A;
  VectorXd const σ = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues();
  double const σ_min = σ(0), σ_max = σ(11), q_min = q_of(M, p.b, solution.x);
  for (double β : {0.5, 1.0, 1.5, 1.9}) {
    CAPTURE(β);
    double const ρ = β / σ_max, η = 1 - std::min(ρ, 2 / σ_max - ρ) * σ_min;
    double const gap0 = q_of(M, p.b, p.zero()) - q_min;
    double last = gap0, bound = 2 * gap0 / σ_min;
    int seen = 0;
    for (auto const& s : slant::iterates(slant::gimssn{qp, {.step_length = ρ}}, p.zero())) {
      double const gap = q_of(M, p.b, s.x) - q_min;
      if (!(gap > 1e-13 * gap0)) break;  // rounding errors of q
      if (seen > 0) {
        CHECK(gap <= η * last);
        bound *= η;
      }
      CHECK((s.x - solution.x).squaredNorm() <= bound);
      last = gap;
      ++seen;
    }
    CHECK(seen > 3);
  }
}

TEST_CASE("the parameter of Lemma 7 is insisted on, unless it is given") {
  test::example_one<double> const p;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  CHECK_THROWS_WITH_AS((slant::gimssn{qp, {.step_factor = 2.0}}),
                       "step_factor: got 2, expected a number in (0, 2)", slant::bad_input);
  slant::gimssn const given{qp, {.step_length = 3.0, .step_factor = 2.0}};
  CHECK(given.start(p.zero()).step_length == 3.0);
  auto const s = slant::gimssn{qp}.start(p.zero());
  double const σ_max = 4 + 2 * std::cos(std::acos(-1.0) / 13);
  CHECK(s.step_length * σ_max == doctest::Approx(1.9));
  CHECK(s.step_length * σ_max < 2);
}

TEST_CASE("a singular A: consistent, held by the constraints, unbounded") {
  VectorXd const d{{1.0, 2.0, 0.0}};
  auto const A =
      slant::declare<slant::self_adjoint, slant::positive_semidefinite>(slant::diagonal(d));
  auto const run = [&](VectorXd const& b, auto const& set) {
    auto const qp = slant::separable_qp{A, b, set};
    return slant::solve(slant::gimssn{qp}, VectorXd(VectorXd::Zero(3)),
                        slant::reduced_gradient_below(1e-12) || slant::at_most(1000));
  };
  auto const consistent = run(VectorXd{{1.0, 1.0, 0.0}}, slant::free_components(3));
  CHECK(consistent.converged());
  CHECK(consistent.x()(0) == doctest::Approx(1));
  auto const held = run(VectorXd{{1.0, 1.0, 1.0}}, slant::intervals(VectorXd{{9.0, 9.0, 5.0}}));
  CHECK(held.converged());
  CHECK(held.x()(2) == doctest::Approx(5));
  auto const unbounded = run(VectorXd{{1.0, 1.0, 1.0}}, slant::half_lines(3));
  CHECK(unbounded.status == slant::status::unbounded);
  VectorXd const down = -unbounded.state.directions.p;
  CHECK(down(2) > 0);
  CHECK(std::abs(down(0)) + std::abs(down(1)) <= 1e-10 * down(2));
}

}  // namespace gimssn_test
