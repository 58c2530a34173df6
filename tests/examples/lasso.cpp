// SPDX-License-Identifier: MIT
//
// lasso: solutions beside coordinate descent in long double, and what the program prints.
#include <lasso/sparse_signal.hpp>
#include <slant/methods/forward_backward.hpp>
#include <slant/methods/solve_program.hpp>
#include "run_program.hpp"

namespace lasso_programs {
namespace {

using namespace examples_test;
using Eigen::Index;
using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// min ½‖M x − y‖² + μ‖x‖₁, one entry after the other until none moves.
vector by_coordinate_descent(lasso::sight const& s, double μ) {
  matrix const M = s.M.cast<long double>();
  vector const squares = M.colwise().squaredNorm();
  vector rest = s.y.cast<long double>();
  vector x = vector::Zero(M.cols());
  for (int sweep = 0; sweep < 20000; ++sweep) {
    long double largest = 0;
    for (Index i = 0; i < x.size(); ++i) {
      long double const c = M.col(i).dot(rest) + squares[i] * x[i];
      long double const size = std::max(std::abs(c) - static_cast<long double>(μ), 0.0L);
      long double const moved = std::copysign(size, c) / squares[i] - x[i];
      if (moved == 0) continue;
      rest -= moved * M.col(i);
      x[i] += moved;
      largest = std::max(largest, std::abs(moved));
    }
    if (largest <= 1e-17L * x.norm()) return x;
  }
  FAIL("coordinate descent has not come to rest");
  return x;
}

/// That x is the solution, and zero at the same entries. Returns its relative error in the energy norm.
double check_solution(lasso::sight const& s, VectorXd const& x, double μ, double accuracy) {
  vector const exact = by_coordinate_descent(s, μ), found = x.cast<long double>();
  CAPTURE(μ);
  CHECK((found - exact).norm() <= accuracy * exact.norm());
  CHECK(((found.array() != 0) == (exact.array() != 0)).all());
  matrix const M = s.M.cast<long double>();
  return double((M * (found - exact)).norm() / (M * exact).norm());
}

}  // namespace

TEST_CASE("lasso: the solution of coordinate descent, and a certificate that is no lie") {
  auto const s = lasso::sparse_signal(220, 200, 12, 0.02);
  double const largest = (s.M.transpose() * s.y).lpNorm<Eigen::Infinity>();
  for (double const share : {0.5, 0.1, 0.02}) {
    auto const run = slant::solve(lasso::program(s, share * largest), 1e-10);
    CHECK(run.converged());
    double const error = check_solution(s, run.x(), share * largest, 1e-9);
    CHECK(error <= 1.5 * run.error.relative());  // it is an estimate
  }
  auto const none = slant::solve(lasso::program(s, 1.0001 * largest), 1e-10);
  CHECK(none.converged());
  CHECK((none.x().array() == 0).all());
}

TEST_CASE("lasso: fewer measurements than entries, by forward-backward splitting") {
  auto const s = lasso::sparse_signal(80, 400, 12, 0.02);
  double const largest = (s.M.transpose() * s.y).lpNorm<Eigen::Infinity>();
  for (double const share : {0.5, 0.05}) {
    auto const program = lasso::program(s, share * largest);
    auto const run = slant::solve(slant::forward_backward{program}, VectorXd(VectorXd::Zero(400)),
                                  slant::reduced_gradient_below(1e-11) || slant::at_most(5000));
    CHECK(run.converged());
    CHECK(check_solution(s, run.x(), share * largest, 1e-9) <= 1e-9);
  }
}

TEST_CASE("lasso: the program finds all spikes and none but them") {
  auto const ran = output_of("lasso", "");
  std::istringstream lines(ran);
  int converged = 0, exact = 0;
  for (std::string line; std::getline(lines, line);) {
    double share = 0, free = 0, spikes = 0;
    if (!(std::istringstream(line) >> share >> free >> spikes)) continue;
    converged += contains(line, "  converged");
    exact += contains(line, "  converged") && free == 12 && spikes == 12;
  }
  CHECK(converged == 10);
  CHECK(exact >= 3);
  CHECK(run("lasso", "--tolerance nonsense").status == 2);
}

}  // namespace lasso_programs
