// SPDX-License-Identifier: MIT
//
// Two steel plates in plane stress [K Ex 5]: Ω¹ = (0,3) × (1,2) on Ω² = (0,3) × (0,1), E
// = 21.19e10, ν = 0.277, both fixed at x = 0, contact on y = 1, slip bound g = 1.7e7. The upper one
// is pressed from above and torn at its right end:
//
//     p_y(s, 2) = −6e7 − 1e7 s,      p_x(3, s) = 2e7,      p_y(3, s) = 4e7 (2 − s) + 2e7 (s − 1).
//
// The slip bounds of the nodes are gᵢ = ωᵢ g with trapezoidal weights ωᵢ [K (14)].
#pragma once

#include <fem/two_bodies.hpp>

namespace fem {

/// The discretised plates of 3k × k cells each: 12 k (k + 1) unknowns and 3k pairs of contact nodes
/// with two multipliers each; k = 60, …, 130 gives the n_u/m of [K Table 5].
[[nodiscard]] inline contact_scene<2> make_two_plates(int k) {
  require(k >= 1 && k <= 4000, "k", k, "between 1 and 4000 cells along the short edges");
  auto const plate = [&](double height) {
    return loaded_box<2>{.mesh = make_box_mesh<2>({3 * k, k}, {3, 1}, {0, height}),
                         .material = lame_plane_stress(21.19e10, 0.277),
                         .fixed = {0, false}};
  };
  boxes_in_contact<2> pair{
      .first = plate(1), .second = plate(0), .contact = {1, false}, .slip_bound = 1.7e7};
  Eigen::Matrix2d along_top;
  along_top << 0, 0, -1e7, 0;
  Eigen::Matrix2d along_end;
  along_end << 0, 0, 0, -2e7;
  pair.first.loads.push_back({{1, true}, {0, -6e7}, along_top});
  pair.first.loads.push_back({{0, true}, {2e7, 6e7}, along_end});  // 4(2 − s) + 2(s − 1) = 6 − 2s
  return make_two_body_scene(pair);
}

}  // namespace fem
