// SPDX-License-Identifier: MIT
//
// Quadratic programs with a few linear inequalities, solved by trying every active set. No code of
// the library is used.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <support/dense_algebra.hpp>
#include <vector>

namespace oracle {

struct kkt_point {
  Eigen::VectorXd u;
  Eigen::VectorXd λ;
};

/// A minimum of ½ uᵀKu − fᵀu over B u ≤ c with multipliers λ ≥ 0, or nothing: for each subset of
/// rows the equations [K Bᵀ; B 0] are solved by least squares, and the first consistent solution
/// that satisfies the inequalities is the answer. For up to 12 rows.
[[nodiscard]] inline std::optional<kkt_point> minimum_over_polyhedron(Eigen::MatrixXd const& K,
                                                                      Eigen::VectorXd const& f,
                                                                      Eigen::MatrixXd const& B,
                                                                      Eigen::VectorXd const& c,
                                                                      double tolerance = 1e-9) {
  Eigen::Index const n = K.rows();
  Eigen::Index const m = B.rows();
  double const size = f.norm() + c.norm() + 1e-300;
  for (unsigned subset = 0; subset < (1U << m); ++subset) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < m; ++i)
      if ((subset >> i & 1U) != 0) rows.push_back(i);
    auto const k = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + k, n + k);
    A.topLeftCorner(n, n) = K;
    A.bottomLeftCorner(k, n) = B(rows, Eigen::all);
    A.topRightCorner(n, k) = B(rows, Eigen::all).transpose();
    Eigen::VectorXd b(n + k);
    b << f, c(rows);
    Eigen::VectorXd const x = test::least_squares(A, b);
    if ((A * x - b).norm() > tolerance * size) continue;
    if (k > 0 && x.tail(k).minCoeff() < -tolerance * size) continue;
    if (m > 0 && (B * x.head(n) - c).maxCoeff() > tolerance * size) continue;
    kkt_point point{x.head(n), Eigen::VectorXd::Zero(m)};
    for (Eigen::Index i = 0; i < k; ++i) point.λ[rows[static_cast<std::size_t>(i)]] = x[n + i];
    return point;
  }
  return std::nullopt;
}

}  // namespace oracle
