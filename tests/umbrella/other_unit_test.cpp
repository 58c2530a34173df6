// SPDX-License-Identifier: MIT
//
// The second unit that includes <slant/slant.hpp>, here behind the whole of Eigen.
#include <doctest/doctest.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <umbrella/other_unit.hpp>

namespace umbrella {

Eigen::Vector3d project_elsewhere(Eigen::Vector3d const& x) {
  return forces(slant::half_line{}, slant::ball<2>{}).project(x);
}

addresses addresses_elsewhere() {
  return {&slant::apply, &slant::project, &slant::evaluate};
}

void refuse_elsewhere() {
  static_cast<void>(slant::ball<2>(-1));
  throw std::logic_error("a negative radius was accepted");
}

}  // namespace umbrella

TEST_CASE("the umbrella header can be included behind Eigen/Dense and Eigen/Sparse") {
  CHECK(umbrella::project_elsewhere({-1, 3, 4}).isApprox(Eigen::Vector3d(0, 0.6, 0.8), 1e-15));
}
