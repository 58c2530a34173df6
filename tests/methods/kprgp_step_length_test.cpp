// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>

#include <doctest/doctest.h>

#include <cmath>

namespace kprgp_step_length_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// α̃ that kprgp takes for the matrix M, and the largest eigenvalue of M.
double step_times_norm(MatrixXd const& M, slant::kprgp_options<double> const& options = {}) {
  auto const A = test::spd(M);
  auto const n = M.rows();
  slant::separable_qp const qp{A, VectorXd(VectorXd::Ones(n)), slant::half_lines(n)};
  return slant::kprgp(qp, options).start(VectorXd::Zero(n)).step_length * M.operatorNorm();
}

TEST_CASE("the default step is the best of the gradient method, at most step_factor / σ_max") {
  for (double κ : {1.0, 1.5, 3.0, 10.0}) {
    MatrixXd const M = test::with_spectrum(test::log_spaced(20, κ));
    double const best = 2 / (1 + 1 / κ);
    CHECK(step_times_norm(M) == doctest::Approx(std::min(1.9, best)).epsilon(1e-10));
    CHECK(step_times_norm(M, {.step_factor = 0.5}) == doctest::Approx(0.5).epsilon(1e-10));
  }
}

TEST_CASE("a projection is found in one step, whatever the units") {
  // min ½ s ‖x‖² − s cᵀx over Λ is P_Λ(c).
  auto const set = slant::cartesian(slant::discs(VectorXd{{1.0, 2.0, 0.5}}), slant::half_lines(4));
  VectorXd const c = test::random_vector(10);
  for (double s : {1e-9, 1.0, 1e9}) {
    MatrixXd const M = s * MatrixXd::Identity(10, 10);
    auto const A = test::spd(M);
    slant::separable_qp const qp{A, VectorXd(s * c), set};
    auto const r = slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Zero(10)),
                                slant::reduced_gradient_below(1e-14) || slant::at_most(10));
    CHECK(r.converged());
    CHECK(r.iterations() <= 2);
    VectorXd expected(10);
    set.project(c, expected);
    CHECK((r.x() - expected).norm() <= 1e-14);
  }
}

}  // namespace kprgp_step_length_test
