// SPDX-License-Identifier: MIT
//
// lasso: solutions beside those of linear systems in long double, and what the program prints.
#include <lasso/sparse_signal.hpp>
#include <slant/methods/solve_program.hpp>
#include "run_program.hpp"

namespace lasso_programs {
namespace {

using namespace examples_test;
using Eigen::Index;
using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The relative error of x in the energy norm. The solution is that of the linear system on the
/// entries that are not zero, if it has their signs and no other correlation exceeds μ.
double error_of(lasso::sight const& s, VectorXd const& x, double μ) {
  std::vector<Index> free;
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] != 0) free.push_back(i);
  matrix const M = s.M.cast<long double>(), F = M(Eigen::all, free);
  vector const y = s.y.cast<long double>(), signs = x(free).cwiseSign().cast<long double>();
  vector exact = vector::Zero(x.size());
  exact(free) = vector((F.transpose() * F).ldlt().solve(F.transpose() * y - μ * signs));
  CHECK(vector(exact(free).cwiseSign()) == signs);
  CHECK((M.transpose() * (y - M * exact)).lpNorm<Eigen::Infinity>() <= μ * (1 + 1e-12));
  return double((M * (x.cast<long double>() - exact)).norm() / (M * exact).norm());
}

}  // namespace

TEST_CASE("lasso: the solution, and a certificate that is no lie") {
  // More measurements than entries, and fewer: MᵀM is singular, and small weights free many entries.
  for (int const rows : {220, 80}) {
    auto const s = lasso::sparse_signal(rows, rows > 200 ? 200 : 400, 12, 0.02);
    double const largest = (s.M.transpose() * s.y).lpNorm<Eigen::Infinity>();
    for (double const share : {0.5, 0.1, 0.02, 0.001}) {
      auto const run = slant::solve(lasso::program(s, share * largest), 1e-10);
      CAPTURE(rows);
      CAPTURE(share);
      CAPTURE(run.reason);
      CHECK(run.converged());
      double const error = error_of(s, run.x(), share * largest);
      CHECK(error <= 1e-10);
      CHECK(error <= 1.5 * run.error.relative());  // it is an estimate
      bool const has_taken_over = run.method.find("forward_backward") != std::string::npos;
      CHECK(has_taken_over == (rows == 80 && share == 0.001));
    }
    auto const none = slant::solve(lasso::program(s, 1.0001 * largest), 1e-10);
    CHECK(none.converged());
    CHECK((none.x().array() == 0).all());
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
  CHECK(converged == 12);
  CHECK(exact >= 3);
  CHECK(run("lasso", "--tolerance nonsense").status == 2);
}

}  // namespace lasso_programs
