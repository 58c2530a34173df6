// SPDX-License-Identifier: MIT
#include "spd_matrices.hpp"

#include <slant/krylov/spectral_bound.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/diagonal.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <support/effort.hpp>

namespace gradient_step_test {

using Eigen::VectorXd;

TEST_CASE(
    "the length is best for small condition numbers, near 2/σ_max for large ones, always safe") {
  for (double κ : {1.0, 1.5, 3.0, 10.0, 1e6}) {
    for (Eigen::Index n : {5, 40, test::effort(200, 60)}) {
      auto const M = test::with_spectrum(test::log_spaced(n, κ));
      double const σ = M.operatorNorm();
      auto const step = slant::safe_gradient_step(test::spd(M), VectorXd(n), 1.9);
      CHECK(step.length * σ < 2);
      CHECK(step.length * σ <= 1.9 + 1e-12);
      CHECK(step.length * σ > 0.6 * std::min(1.9, 2 / (1 + 1 / κ)));
      CHECK(step.σ == doctest::Approx(σ).epsilon(0.02));
      CHECK(step.applications <= n);
    }
  }
}

TEST_CASE("zero operator, operators out of range") {
  auto const nothing = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd(VectorXd::Zero(3))));
  CHECK(slant::safe_gradient_step(nothing, VectorXd(3), 1.9).length == 1);
  auto const tiny =
      slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Constant(3, 1e-310)));
  CHECK_THROWS_AS(static_cast<void>(slant::safe_gradient_step(tiny, VectorXd(3), 1.9)),
                  slant::bad_input);
}

}  // namespace gradient_step_test
