// SPDX-License-Identifier: MIT
//
// A block on a rigid foundation that nothing holds but weak springs and the foundation itself: it
// nearly moves rigidly, and b = B K⁻¹f − c is larger than all that is of interest by the ratio of
// the stiffnesses.
#pragma once

#include <slant/contact/contact_data.hpp>

#include <Eigen/SparseCore>

namespace test {

struct spring_scene {
  Eigen::SparseMatrix<double> K;
  slant::contact::data<double> contact;
};

/// 2k × k (× k) cells of 1 × 1, E = 1, ν = 0.3; every unknown is held by a spring, `spring` times
/// the largest K_ii over the number of unknowns. A pressure on the top that grows along x, a
/// traction along x, and a flat foundation below.
template <int D>
[[nodiscard]] spring_scene spring_block(int k, double spring, double push = 0.1);  // D = 2, 3

}  // namespace test
