// SPDX-License-Identifier: MIT
//
// The constraints of the wire [T §4.1] with 4m unknowns.
#pragma once

#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>

namespace test {

/// m components bounded below by l, m points in discs of the radius g, m components free.
[[nodiscard]] inline auto wire_set(Eigen::Index m, double l, double g) {
  return slant::cartesian(slant::half_lines(Eigen::VectorXd::Constant(m, l).eval()),
                          slant::discs(Eigen::VectorXd::Constant(m, g).eval()),
                          slant::free_components(m));
}

}  // namespace test
