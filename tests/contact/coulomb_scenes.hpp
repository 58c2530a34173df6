// SPDX-License-Identifier: MIT
//
// Independent checks of Coulomb's law for the tests of this room: formulas of their own on dense
// matrices, no set and no method of the library.
#pragma once

#include <Eigen/Dense>

#include <utility>

#include "scenes.hpp"

namespace test {

/// A = B K⁻¹Bᵀ and b = B K⁻¹f − (d, w) by a dense factorisation.
struct dense_dual {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  explicit dense_dual(Eigen::SparseMatrix<double> const& K, slant::contact::data<double> const& c);
};

/// Nearest point of { |t| <= μ n }, by cases.
std::pair<double, Eigen::VectorXd> nearest_in_cone(double μ, double n, Eigen::VectorXd const& t);

/// The largest component of r − P_K(r − ρ (u + μ‖u_t‖ n)), u = A r − b, ρ = 1/max A_ii, relative to
/// the largest force; λ = (λ_ν, λ_t).
double natural_map(dense_dual const& p, Eigen::VectorXd const& μ, Eigen::VectorXd const& λ);

}  // namespace test
