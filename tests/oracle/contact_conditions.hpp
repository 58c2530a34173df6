// SPDX-License-Identifier: MIT
//
// The optimality conditions of contact with Tresca friction, checked on the original problem and
// not on the dual one: equilibrium, nonpenetration, Tresca's law.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>

#include <oracle/dense_qp.hpp>

namespace oracle {

using sparse = Eigen::SparseMatrix<double>;

/// Data of  min ½uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖,  N u ≤ d.  T has m rows (plane), 2m (space) or 0 (no
/// friction).
struct contact_data {
  sparse const& K;
  sparse const& N;
  sparse const& T;
  Eigen::VectorXd const& f;
  Eigen::VectorXd const& d;
  Eigen::VectorXd const& g;

  [[nodiscard]] Eigen::Index m() const { return N.rows(); }
  [[nodiscard]] Eigen::Index tangents() const { return m() == 0 ? 0 : T.rows() / m(); }
};

/// Violations, each relative to the largest number of its kind. All vanish at the solution and only
/// there.
struct contact_violations {
  double equilibrium = 0;      ///< K u + Nᵀλ_ν + Tᵀλ_t = f
  double penetration = 0;      ///< N u ≤ d
  double adhesion = 0;         ///< λ_ν ≥ 0
  double complementarity = 0;  ///< λ_ν (d − N u) = 0
  double slip_bound = 0;       ///< ‖λ_t‖ ≤ g
  double slip_direction = 0;  ///< λ_tᵀT u = g ‖T u‖: sticks below the bound, slips along λ_t on it

  [[nodiscard]] double largest() const {
    return std::fmax(
        std::fmax(std::fmax(equilibrium, penetration), std::fmax(adhesion, slip_bound)),
        std::fmax(complementarity, slip_direction));
  }
};

/// M x in the long type; with `transposed`, Mᵀx.
[[nodiscard]] inline real_vector multiply(sparse const& M, real_vector const& x,
                                          bool transposed = false) {
  real_vector y = real_vector::Zero(transposed ? M.cols() : M.rows());
  for (Eigen::Index j = 0; j < M.outerSize(); ++j)
    for (sparse::InnerIterator entry(M, j); entry; ++entry) {
      real const value = entry.value();
      if (transposed)
        y[j] += value * x[entry.row()];
      else
        y[entry.row()] += value * x[j];
    }
  return y;
}

/// λ = (λ_ν, λ_t).
[[nodiscard]] inline contact_violations check_contact(contact_data const& p, real_vector const& u,
                                                      real_vector const& λ) {
  Eigen::Index const m = p.m();
  Eigen::Index const tangents = p.tangents();
  real_vector const gap = p.d.cast<real>() - multiply(p.N, u);
  real_vector const slip = multiply(p.T, u);
  real_vector const force = p.f.cast<real>() - multiply(p.K, u) - multiply(p.N, λ.head(m), true) -
                            multiply(p.T, λ.tail(tangents * m), true);
  auto const magnitude = [](real_vector const& v) {
    return v.size() == 0 ? real(0) : v.cwiseAbs().maxCoeff();
  };
  real const displacement = magnitude(u);
  real const multiplier = magnitude(λ);

  contact_violations result;
  auto const note = [](double& violation, real amount, real scale) {
    if (amount > 0) violation = std::fmax(violation, static_cast<double>(amount / scale));
  };
  note(result.equilibrium, magnitude(force), magnitude(p.f.cast<real>()));
  for (Eigen::Index i = 0; i < m; ++i) {
    note(result.penetration, -gap[i], displacement);
    note(result.adhesion, -λ[i], multiplier);
    note(result.complementarity, std::fabs(λ[i] * gap[i]), displacement * multiplier);
    if (tangents == 0) continue;
    auto const traction = λ.segment(m + tangents * i, tangents);
    auto const motion = slip.segment(tangents * i, tangents);
    note(result.slip_bound, traction.norm() - p.g[i], multiplier);
    note(result.slip_direction, std::fabs(p.g[i] * motion.norm() - traction.dot(motion)),
         displacement * multiplier);
  }
  return result;
}

}  // namespace oracle
