// SPDX-License-Identifier: MIT
//
// The P1-bubble/P1 element of Stokes flow [Arnold, Brezzi, Fortin 1984], [K §2.2.2]: velocities are
// affine plus a bubble  β = 27 φ₁φ₂φ₃  per component, pressures are affine. As ∇φ_a is constant,
// ∫ ∇φ_a·∇β = 0: the stiffness of the bubbles is a number per triangle, and they are condensed,
//
//     [ A  0    Bᵀ   ] [ u   ]   [ l   ]       A u + Bᵀp = l
//     [ 0  A_β  B_βᵀ ] [ u_β ] = [ l_β ]  ⇒    B u − E p = c
//     [ B  B_β  0    ] [ p   ]   [ 0   ]
//
//     E = B_β A_β⁻¹ B_βᵀ,   c = −B_β A_β⁻¹ l_β
//
// With g_a = ∇φ_a, V the area, s = Σ‖g_a‖²:  ∫β = 9V/20,  ∫‖∇β‖² = 81 V s/20,  ∫φ_a ∂β = −g_a ∫β.
#pragma once

#include <Eigen/Core>

#include <fem/simplex_mesh.hpp>

namespace fem {

/// The matrices of one triangle for a viscosity ν, bubbles condensed.
class mini_element {
 public:
  mini_element(p1_element<2> const& element, double viscosity)
      : element_(element), bubble_stiffness_(81 * viscosity * element.volume * s() / 20) {
    stiffness_ = viscosity * element.volume * element.gradients.transpose() * element.gradients;
    double const i = bubble_integral();
    stabilisation_ = i * i / bubble_stiffness_ * element.gradients.transpose() * element.gradients;
    // Mirrored, because the products are symmetric only up to rounding.
    stiffness_.triangularView<Eigen::StrictlyUpper>() = stiffness_.transpose();
    stabilisation_.triangularView<Eigen::StrictlyUpper>() = stabilisation_.transpose();
  }

  /// ν ∫ ∇φ_a·∇φ_b, the same for both components of the velocity.
  [[nodiscard]] Eigen::Matrix3d const& stiffness() const { return stiffness_; }
  /// E of the triangle.
  [[nodiscard]] Eigen::Matrix3d const& stabilisation() const { return stabilisation_; }
  /// −∫ φ_q ∂_i φ_a in component i of column a, the same for every q.
  [[nodiscard]] Eigen::Matrix<double, 2, 3> divergence() const {
    return -element_.volume / 3 * element_.gradients;
  }
  /// c of the triangle, −B_β A_β⁻¹ l_β, l_β = ∫ f β.
  [[nodiscard]] Eigen::Vector3d divergence_of_bubble_load(Eigen::Vector2d const& load) const {
    return -bubble_integral() / bubble_stiffness_ * element_.gradients.transpose() * load;
  }
  /// ∫ β.
  [[nodiscard]] double bubble_integral() const { return 9 * element_.volume / 20; }
  /// β at the point with barycentric coordinates φ.
  [[nodiscard]] static double bubble_at(Eigen::Vector3d const& φ) { return 27 * φ.prod(); }

 private:
  [[nodiscard]] double s() const { return element_.gradients.squaredNorm(); }

  p1_element<2> element_;
  double bubble_stiffness_;
  Eigen::Matrix3d stiffness_;
  Eigen::Matrix3d stabilisation_;
};

}  // namespace fem
