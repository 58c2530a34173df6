// SPDX-License-Identifier: MIT
//
// The separable quadratic problem as plain data, for reference solutions:
//
//   min ½ xᵀA x − bᵀx,   lower ≤ x_i ≤ upper on some unknowns,   ‖(x_i, x_j)‖ ≤ radius on some
//   pairs.
//
// Unknowns that no constraint names are free. Deliberately free of the library's sets and methods,
// so that the library can be judged by it.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

namespace oracle {

using real = long double;  // 64 bits of mantissa on x86: ten bits beyond what is being judged
using real_vector = Eigen::Matrix<real, Eigen::Dynamic, 1>;

struct interval_constraint {
  Eigen::Index at;
  double lower;
  double upper = std::numeric_limits<double>::infinity();
};

struct circle_constraint {
  Eigen::Index first;
  Eigen::Index second;
  double radius;
};

struct dense_qp {
  Eigen::MatrixXd A;  ///< symmetric positive definite
  real_vector b;
  std::vector<interval_constraint> intervals{};
  std::vector<circle_constraint> circles{};

  [[nodiscard]] Eigen::Index size() const { return b.size(); }

  /// A x − b, accumulated in the long type.
  [[nodiscard]] real_vector gradient(real_vector const& x) const {
    real_vector r = -b;
    for (Eigen::Index j = 0; j < size(); ++j) {
      real const xj = x[j];
      if (xj == 0) continue;
      double const* column = A.data() + j * A.rows();
      for (Eigen::Index i = 0; i < size(); ++i) r[i] += static_cast<real>(column[i]) * xj;
    }
    return r;
  }

  /// Nearest feasible point.
  [[nodiscard]] real_vector project(real_vector x) const {
    for (auto const& c : intervals)
      x[c.at] =
          std::fmin(std::fmax(x[c.at], static_cast<real>(c.lower)), static_cast<real>(c.upper));
    for (auto const& c : circles) {
      real const length = std::hypot(x[c.first], x[c.second]);
      if (!(length > c.radius)) continue;
      x[c.first] *= c.radius / length;
      x[c.second] *= c.radius / length;
    }
    return x;
  }

  /// A step length for each unknown, 1/A_ii, equal on the two unknowns of a circle.
  [[nodiscard]] Eigen::VectorXd steps() const {
    Eigen::VectorXd ρ = A.diagonal().cwiseInverse();
    for (auto const& c : circles)
      ρ[c.first] = ρ[c.second] = 2 / (A(c.first, c.first) + A(c.second, c.second));
    return ρ;
  }

  /// x − P(x − ρ (A x − b)): zero exactly at the solution.
  [[nodiscard]] real_vector natural_residual(real_vector const& x, Eigen::VectorXd const& ρ) const {
    return x - project(x - ρ.cast<real>().cwiseProduct(gradient(x)));
  }
};

/// Which constraints carry a multiplier.
struct active_counts {
  int intervals = 0;
  int circles = 0;
  /// The least distance of any constraint from changing sides, relative to the size of the
  /// solution: how far x − ρ r lies from the boundary.
  double margin = std::numeric_limits<double>::infinity();
};

/// A constraint is active when its multiplier, times the step ρ = 1/A_ii, exceeds its slack:
/// exactly when x − ρ r lies outside the constraint. At the solution one of the two numbers is
/// zero, so this compares a rounding error with a quantity of the data and needs no threshold.
[[nodiscard]] inline active_counts count_active(dense_qp const& qp, real_vector const& x) {
  active_counts counts;
  real_vector const z = x - qp.steps().cast<real>().cwiseProduct(qp.gradient(x));
  real const scale = x.cwiseAbs().maxCoeff();
  auto const note = [&](real outside, int& active) {
    if (outside > 0) ++active;
    counts.margin = std::fmin(counts.margin, static_cast<double>(std::fabs(outside) / scale));
  };
  for (auto const& c : qp.intervals)
    note(std::fmax(c.lower - z[c.at], z[c.at] - c.upper), counts.intervals);
  for (auto const& c : qp.circles)
    note(std::hypot(z[c.first], z[c.second]) - c.radius, counts.circles);
  return counts;
}

}  // namespace oracle
