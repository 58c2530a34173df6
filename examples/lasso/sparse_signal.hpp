// SPDX-License-Identifier: MIT
//
// A signal of a few spikes seen through a random matrix, and the lasso that recovers it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <slant/operators/operators.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/support.hpp>
#include <utility>

namespace lasso {

struct sight {
  Eigen::MatrixXd M;
  Eigen::VectorXd signal;
  Eigen::VectorXd y;  ///< M signal, and noise
};

/// Entries of M and noise are uniform, of variance 1/rows and noise². The engine is that of the
/// standard, so that the numbers are the same everywhere.
[[nodiscard]] inline sight sparse_signal(int rows, int n, int spikes, double noise) {
  std::mt19937 bits(20);
  auto const uniform = [&] { return std::sqrt(12.0) * (double(bits()) / 4294967295.0 - 0.5); };
  sight s{.M = Eigen::MatrixXd::NullaryExpr(rows, n, uniform) / std::sqrt(double(rows)),
          .signal = Eigen::VectorXd::Zero(n),
          .y = {}};
  for (int k = 0; k < spikes; ++k) {
    s.signal[(n * k + n / 2) / spikes] = (k % 2 == 0 ? 1 : -1) * (1 + 0.25 * k);
  }
  s.y = s.M * s.signal + noise * Eigen::VectorXd::NullaryExpr(rows, uniform);
  return s;
}

/// minimise ½‖M x − y‖² + μ‖x‖₁; refers to s.
[[nodiscard]] inline auto program(sight const& s, double μ) {
  auto const M = slant::op<"M">(s.M);
  Eigen::VectorXd b = adjoint(M) * s.y;
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(b.size(), μ);
  return slant::minimise(slant::quadratic(adjoint(M) * M, std::move(b)) +  // MᵀM is never formed
                         slant::support(slant::intervals(std::move(weights))));
}

}  // namespace lasso
