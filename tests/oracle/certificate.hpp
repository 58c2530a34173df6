// SPDX-License-Identifier: MIT
//
// Proof that a point is nearly the solution of a dense_qp, independent of how it was found. For a
// feasible x and any s with finite support function, weak duality of the quadratic problem gives
//
//   ½ ‖x − x*‖²_A  ≤  q(x) − q(x*)  ≤  gap  =  Σ (xᵢᵀsᵢ + sup_{Λᵢ} −sᵢᵀz)  +  ½ (s − r)ᵀA⁻¹(s − r)
//
// with r = A x − b. We take s = r where x − ρ r lies outside the constraint, and s = 0 elsewhere:
// there the rounding error of r then counts only by its square.
#pragma once

#include <oracle/dense_qp.hpp>

namespace oracle {

struct certificate {
  double infeasibility = 0;  ///< largest violation of a constraint, relative to its size
  double gap = 0;            ///< duality gap, relative to ½‖x‖²_A
  double energy_error = 0;   ///< proven bound of ‖x − x*‖_A / ‖x‖_A
};

[[nodiscard]] inline certificate certify(dense_qp const& qp, real_vector const& x) {
  certificate result;
  real_vector const r = qp.gradient(x);
  real_vector const z = x - qp.steps().cast<real>().cwiseProduct(r);
  real_vector s = real_vector::Zero(qp.size());  // free unknowns: only s = 0 has a finite support
  real gap = 0;
  auto const violation = [&](real amount, real size) {
    if (amount > 0)
      result.infeasibility = std::fmax(result.infeasibility, static_cast<double>(amount / size));
  };
  for (auto const& c : qp.intervals) {
    violation(std::fmax(c.lower - x[c.at], x[c.at] - c.upper), x.cwiseAbs().maxCoeff());
    if (z[c.at] >= c.lower && z[c.at] <= c.upper) continue;
    real const bound = z[c.at] < c.lower ? c.lower : c.upper;
    s[c.at] = r[c.at];
    gap += (x[c.at] - bound) * s[c.at];
  }
  for (auto const& c : qp.circles) {
    real const length = std::hypot(x[c.first], x[c.second]);
    violation(length - c.radius, length);
    if (!(std::hypot(z[c.first], z[c.second]) > c.radius)) continue;
    s[c.first] = r[c.first];
    s[c.second] = r[c.second];
    real const product = x[c.first] * s[c.first] + x[c.second] * s[c.second];
    gap += product + c.radius * std::hypot(s[c.first], s[c.second]);
  }
  Eigen::VectorXd const repair = (s - r).cast<double>();
  gap += 0.5L * static_cast<real>(repair.dot(qp.A.llt().solve(repair)));
  real const energy = 0.5L * x.dot(r + qp.b);
  result.gap = static_cast<double>(gap / energy);
  // A gap of this size is a rounding error and may be negative; its magnitude is what we know.
  result.energy_error = std::sqrt(std::fabs(result.gap));
  return result;
}

}  // namespace oracle
