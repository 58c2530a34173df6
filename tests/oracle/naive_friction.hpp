// SPDX-License-Identifier: MIT
//
// The law of Coulomb friction in long double and by definition: a projection is the nearest of the
// points that can be it. Shares no code with the library.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oracle {

using friction_real = long double;
using friction_vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using friction_matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The nearest to x of {y : |y_t| <= slope y_n}; slope = inf is the half space y_n >= 0.
friction_vector nearest_in_cone(friction_vector const& x, friction_real slope);

struct naive_contact {
  friction_real natural_map, outside_cone, outside_dual, penetration, complementarity, dissipation;
};

/// Contact by contact, ρ = 1.
std::vector<naive_contact> naive_friction(friction_matrix const& W, friction_vector const& q,
                                          friction_vector const& mu, friction_vector const& r);

}  // namespace oracle
