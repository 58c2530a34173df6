// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gimssn_test {

using Eigen::VectorXd;

double q_of(Eigen::MatrixXd const& A, VectorXd const& b, VectorXd const& x) {
  return x.dot(0.5 * (A * x) - b);
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

}  // namespace gimssn_test
