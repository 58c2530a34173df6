// SPDX-License-Identifier: MIT
//
// The brick of [T §4.2, K Ex 3]: 3k × k × k cells of 6 Kuhn tetrahedra each.
#pragma once

#include <fem/box_mesh.hpp>

namespace fem {

/// The six sides of a brick with x to the right, y to the back and z upwards.
namespace brick_side {
inline constexpr box_side left{0, false};
inline constexpr box_side right{0, true};
inline constexpr box_side front{1, false};
inline constexpr box_side back{1, true};
inline constexpr box_side bottom{2, false};
inline constexpr box_side top{2, true};
}  // namespace brick_side

/// A brick of 3k × k × k cells; by default (0,3) × (0,1) × (0,1), where the cells are cubes.
/// Throws std::invalid_argument for k < 1 or a size that is not positive and finite.
[[nodiscard]] inline box_mesh<3> make_brick_mesh(int k, Eigen::Vector3d const& size = {3, 1, 1}) {
  require(k >= 1 && k <= 400, "k", k, "between 1 and 400 cells along the short edges");
  return make_box_mesh<3>({3 * k, k, k}, size);
}

}  // namespace fem
