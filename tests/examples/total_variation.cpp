// SPDX-License-Identifier: MIT
//
// total_variation: the denoised signal beside the taut string, the shortest path in the tube
// |s_k − (y₁ + … + y_k)| ≤ μ between its fixed ends, whose slopes it has [Davies, Kovac 2001; Condat
// 2013 walks along it in the same way].
#include <slant/methods/solve_program.hpp>
#include <slant/testing/laws.hpp>
#include <total_variation/steps_signal.hpp>
#include "run_program.hpp"

namespace total_variation_programs {
namespace {

using namespace examples_test;
namespace tv = total_variation;
using Eigen::Index;
using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

vector taut_string(VectorXd const& y, long double μ) {
  Index const n = y.size();
  vector sums = vector::Zero(n + 1), slopes(n);
  for (Index k = 0; k < n; ++k) sums[k + 1] = sums[k] + static_cast<long double>(y[k]);
  Index from = 0;
  long double height = 0;
  while (from < n) {
    // The straight lines from here that stay in the tube, and where it allows no more.
    long double least = -std::numeric_limits<long double>::infinity(), most = -least;
    Index at_least = from, at_most = from, to = n;
    long double slope = 0;
    for (Index k = from + 1; k <= n; ++k) {
      long double const half = k == n ? 0 : μ, length = static_cast<long double>(k - from);
      long double const low = (sums[k] - half - height) / length;
      long double const high = (sums[k] + half - height) / length;
      if (low > most || high < least) {
        to = low > most ? at_most : at_least;
        slope = low > most ? most : least;
        break;
      }
      if (low >= least) least = low, at_least = k;
      if (high <= most) most = high, at_most = k;
      slope = low;
    }
    slopes.segment(from, to - from).setConstant(slope);
    height += slope * static_cast<long double>(to - from);
    from = to;
  }
  return slopes;
}

}  // namespace

TEST_CASE("total variation: the slopes of the taut string") {
  for (Index const n : {3, 50, 2000}) {
    auto const y = tv::with_noise(tv::steps_signal(n), 0.5);
    for (double const μ : {0.1, 1.0, 7.0, 1e4}) {
      CAPTURE(n);
      CAPTURE(μ);
      auto const run = slant::solve(tv::program(y, μ), tv::chains_inverse{n}, 1e-9);
      CHECK(run.converged());
      auto const x = tv::denoised(y, run.x());
      vector const exact = taut_string(y, μ);
      double const error = double((x.cast<long double>() - exact).cwiseAbs().maxCoeff());
      CHECK(error <= 1e-12 * static_cast<double>(n));
      for (Index i = 1; i < n; ++i)
        CHECK((std::abs(run.x()[i - 1]) == μ) == (exact[i] != exact[i - 1]));
    }
  }
}

TEST_CASE("total variation: differences and chains keep their laws, and are each other's inverse") {
  slant::testing::check_operator_laws(tv::differences{9});
  slant::testing::check_operator_laws(tv::chains_inverse{9});
  tv::chains_inverse const M{200};
  VectorXd const p = tv::with_noise(VectorXd::Zero(199), 1);
  VectorXd x(200), q(199), back(199);
  tv::differences{200}.apply_adjoint(p, x);
  tv::differences{200}.apply(x, q);
  auto w = M.workspace(q);
  M.apply(q, back, w);
  CHECK((back - p).norm() <= 1e-11 * p.norm());
}

TEST_CASE("total variation: the program") {
  auto const ran = output_of("total_variation", "--values 1000");
  std::istringstream lines(ran.substr(ran.find("status")));
  std::string line;
  std::getline(lines, line);
  double least = 1;
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    double μ = 0, jumps = 0, left = 1;
    CHECK(bool(std::istringstream(line) >> μ >> jumps >> left));
    CHECK(contains(line, "converged"));
    least = std::min(least, left);
  }
  CHECK(rows == 5);
  CHECK(least <= 0.05);  // of noise of 0.29
  check_refused(run("total_variation", "--values 2"), "--values");
}

}  // namespace total_variation_programs
