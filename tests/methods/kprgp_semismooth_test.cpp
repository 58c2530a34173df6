// SPDX-License-Identifier: MIT
#include "example_one.hpp"
#include "mixture.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <oracle/dense_newton.hpp>

namespace kprgp_semismooth_test {

using Eigen::VectorXd;

double q_of(Eigen::MatrixXd const& A, VectorXd const& b, VectorXd const& x) {
  return x.dot(0.5 * (A * x) - b);
}

/// Does q fall by the factor of [K Theorem 1] in every step? Returns the number of steps seen.
template <class Method>
int check_decrease(Method const& method, Eigen::MatrixXd const& M, VectorXd const& b,
                   VectorXd const& x0, VectorXd const& solution, double η) {
  double const q_min = q_of(M, b, solution);
  double const gap0 = q_of(M, b, x0) - q_min;
  double last = gap0;
  int seen = 0;
  for (auto const& s : slant::iterates(method, x0)) {
    double const gap = q_of(M, b, s.x) - q_min;
    if (!(gap > 1e-12 * gap0)) break;  // rounding errors of q
    if (seen > 0) CHECK(gap <= η * last);
    last = gap;
    ++seen;
  }
  return seen;
}

TEST_CASE("AS-S: the decrease of q of Theorem 1, discs and intervals") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  Eigen::MatrixXd const M = p.A;
  VectorXd const σ = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues();
  auto const box = slant::intervals(VectorXd(VectorXd::Constant(12, 1.5)));
  auto const plane = slant::separable_qp{p.a(), p.b, box};
  oracle::dense_qp plain{M, p.b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 12; ++i) plain.intervals.push_back({i, -1.5, 1.5});
  VectorXd const corner = oracle::solve_dense(plain).x.cast<double>();
  for (double Γ : {0.5, 1.0, 3.0}) {
    for (double β : {0.5, 1.0, 1.9}) {
      CAPTURE(Γ);
      CAPTURE(β);
      double const α = β / σ(11), Γ_max = std::max(Γ, 1 / Γ);
      double const η = 1 - α * σ(0) / (2 + 2 * Γ_max * Γ_max);
      slant::kprgp_options<double> const o{.proportioning = Γ, .step_length = α};
      CHECK(check_decrease(slant::as_s(qp, o), M, p.b, p.zero(), solution.x, η) > 5);
      CHECK(check_decrease(slant::as_s(plane, o), M, p.b, p.zero(), corner, η) > 1);
      CHECK(check_decrease(slant::as(plane, o), M, p.b, p.zero(), corner, η) > 1);
    }
  }
}

TEST_CASE("AS-S agrees with Newton's method on dense data, whatever its options") {
  test::mixture const p(30);
  auto const reference = oracle::solve_dense(p.plain());
  auto const A = test::spd(p.A);
  auto const qp = slant::separable_qp{A, p.b, p.set()};
  for (auto const& o :
       {slant::kprgp_options<double>{}, slant::kprgp_options<double>{.proportioning = 0.01},
        slant::kprgp_options<double>{.proportioning = 100},
        slant::kprgp_options<double>{.half_step = false}}) {
    auto const r = slant::solve(slant::as_s(qp, o), VectorXd(VectorXd::Zero(20)),
                                slant::reduced_gradient_below(1e-13) || slant::at_most(20000));
    REQUIRE(r.converged());
    CHECK((r.x() - reference.x.cast<double>()).norm() <= 1e-10 * r.x().norm());
  }
}

TEST_CASE("a block on its boundary that the gradient pulls inside is free for AS-S at once") {
  VectorXd const b{{3.0, 1.0}};
  Eigen::MatrixXd const M{{2.0, 1.0}, {1.0, 2.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  auto const set = slant::half_lines(2);
  auto const qp = slant::separable_qp{A, b, set};
  VectorXd const zero = VectorXd::Zero(2);
  auto const first_step = [&](auto const& method) {
    auto s = method.start(zero);
    method.step(s);
    return s.last_step;
  };
  CHECK(first_step(slant::as_s(qp)) == slant::kprgp_step::conjugate_gradient);
  CHECK(first_step(slant::as(qp)) == slant::kprgp_step::proportioning);
}

}  // namespace kprgp_semismooth_test
