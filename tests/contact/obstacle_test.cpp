// SPDX-License-Identifier: MIT
#include <slant/contact/obstacle.hpp>

#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

namespace obstacle_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using obstacle = slant::contact::obstacle<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A chain of n springs.
sparse chain(Eigen::Index n) {
  MatrixXd K = 2 * MatrixXd::Identity(n, n);
  K.diagonal(1).setConstant(-1);
  K.diagonal(-1).setConstant(-1);
  return K.sparseView();
}

sparse rows(MatrixXd const& m) {
  return m.sparseView();
}

VectorXd solve(obstacle const& problem) {
  auto const r = slant::solve(slant::symmetric_newton{problem.qp()}, problem.zero(),
                              slant::reduced_gradient_below(1e-14) || slant::at_most(100));
  CHECK(r.status != slant::status::iteration_limit);
  return r.x();
}

/// The conditions of a solution, in the units of the data.
void check_solution(sparse const& K, VectorXd const& f, sparse const& N, VectorXd const& d,
                    obstacle const& problem, double unit_of_u = 1, double unit_of_f = 1) {
  VectorXd const v = solve(problem);
  VectorXd const u = problem.displacement(v), λ = problem.multipliers(v);
  VectorXd const balance = f - K * u - N.transpose() * λ;
  CHECK(balance.lpNorm<Eigen::Infinity>() <= 1e-12 * unit_of_f);
  VectorXd const slack = d - N * u;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    CHECK(slack[i] >= -1e-13 * unit_of_u);
    CHECK(λ[i] >= 0);
    CHECK((λ[i] == 0 || slack[i] <= 1e-13 * unit_of_u));
  }
}

TEST_CASE("rows of one entry of either sign and any size, far and infinite gaps") {
  sparse const K = chain(6);
  VectorXd const f = VectorXd::Constant(6, 1);
  MatrixXd N = MatrixXd::Zero(4, 6);
  N(0, 1) = 1;
  N(1, 2) = 4;
  N(2, 4) = -1;
  N(3, 5) = 1;
  VectorXd const d{{1.5, 5.0, -9.0, infinity}};
  obstacle const problem(K, f, rows(N), d);
  CHECK(!problem.reflects());
  check_solution(K, f, rows(N), d, problem);
  VectorXd const u = problem.displacement(solve(problem));
  CHECK(u[1] == 1.5);
  CHECK(u[2] == 1.25);
  CHECK(u[4] == 9);  // pulled up to it
}

TEST_CASE("rows of several entries with supports of their own") {
  sparse const K = chain(7);
  VectorXd const f{{1, 2, -1, 3, 1, 1, 2}};
  MatrixXd N = MatrixXd::Zero(3, 7);
  N.row(0).head(3) << 1, 1, -0.5;
  N.row(1).segment(3, 2) << -2, 0.25;
  N(2, 6) = 1;
  VectorXd const d{{0.5, 1, 0.1}};
  obstacle const problem(K, f, rows(N), d);
  CHECK(problem.reflects());
  check_solution(K, f, rows(N), d, problem);
  MatrixXd const H = problem.coordinates(MatrixXd(MatrixXd::Identity(7, 7)));
  CHECK((H * H - MatrixXd::Identity(7, 7)).norm() <= 1e-15 * 7);
  CHECK((MatrixXd(problem.matrix()) - H * MatrixXd(K) * H).norm() <= 1e-14);
}

TEST_CASE("redundant rows and bounds on both sides: the tightest row has the force") {
  sparse const K = chain(3);
  VectorXd const f{{5, 0, -5}};
  MatrixXd N = MatrixXd::Zero(5, 3);
  N(0, 0) = 1;
  N(1, 0) = 2;
  N(2, 0) = 1;
  N(3, 2) = -1;
  N(4, 2) = 1;
  VectorXd const d{{3, 2, 4, 0.5, 0.5}};
  obstacle const problem(K, f, rows(N), d);
  check_solution(K, f, rows(N), d, problem);
  VectorXd const λ = problem.multipliers(solve(problem));
  CHECK(λ[0] == 0);
  CHECK(λ[1] > 0);
  CHECK(λ[3] > 0);
  CHECK(λ[4] == 0);
}

TEST_CASE("units of forces, lengths and rows") {
  sparse const K = chain(4);
  MatrixXd N = MatrixXd::Zero(2, 4);
  N.row(0).head(2) << 0.6, 0.8;
  N(1, 3) = 1;
  for (double const unit : {1e-100, 1e100}) {
    VectorXd const f = VectorXd::Constant(4, unit);
    VectorXd const d = VectorXd::Constant(2, 0.3 * unit);
    obstacle const problem(K, f, rows(N), d);
    check_solution(K, f, rows(N), d, problem, unit, unit);
    sparse const scaled = rows(MatrixXd(unit * N));
    VectorXd const gaps = VectorXd::Constant(2, 0.3 * unit);
    VectorXd const load = VectorXd::Ones(4);
    VectorXd const u = problem.displacement(solve(obstacle(K, load, scaled, gaps)));
    CHECK((N * u).maxCoeff() == doctest::Approx(0.3).epsilon(1e-13));
  }
}

TEST_CASE("what cannot be used is named") {
  sparse const K = chain(3);
  VectorXd const f = VectorXd::Ones(3);
  MatrixXd N = MatrixXd::Zero(2, 3);
  N.row(0) << 1, 1, 0;
  N.row(1) << 0, 1, 1;
  CHECK_THROWS_WITH_AS(obstacle(K, f, rows(N), VectorXd::Ones(2)),
                       "N: got rows 0 and 1 of N share unknown 1, expected rows of one entry, or "
                       "of disjoint supports",
                       slant::bad_input);
  MatrixXd E = MatrixXd::Zero(2, 3);
  E(0, 1) = 1;
  E(1, 1) = -1;
  CHECK_THROWS_WITH_AS(obstacle(K, f, rows(E), VectorXd{{1, -2}}),
                       "d[1]: got -2, expected one that row 0 of N does not exclude",
                       slant::bad_input);
  VectorXd const d = VectorXd::Ones(2);
  CHECK_THROWS_AS(obstacle(chain(4), f, rows(E), d), slant::bad_input);
  CHECK_THROWS_AS(obstacle(K, f, rows(E), VectorXd::Ones(3)), slant::bad_input);
  CHECK_THROWS_AS(obstacle(K, VectorXd::Constant(3, std::nan("")), rows(E), d), slant::bad_input);
  CHECK_THROWS_AS(obstacle(K, f, rows(E), VectorXd{{1, std::nan("")}}), slant::bad_input);
  sparse skew = K;
  skew.coeffRef(0, 1) = 7;
  CHECK_THROWS_AS(obstacle(skew, f, rows(E), d), slant::bad_input);
}

}  // namespace obstacle_test
