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

/// The mesh of the plate whose lower edge is at this height.
[[nodiscard]] inline box_mesh<2> make_plate_mesh(int k, double height) {
  return make_box_mesh<2>({3 * k, k}, {3, 1}, {0, height});
}

/// The tractions on the upper plate.
struct plate_loads {
  side_traction<2> from_above;
  side_traction<2> at_end;
};
[[nodiscard]] inline plate_loads loads_on_plates() {
  Eigen::Matrix2d along_top;
  along_top << 0, 0, -1e7, 0;
  Eigen::Matrix2d along_end;
  along_end << 0, 0, 0, -2e7;
  return {.from_above = {{1, true}, {0, -6e7}, along_top},
          .at_end = {{0, true}, {2e7, 6e7}, along_end}};  // 4(2 − s) + 2(s − 1) = 6 − 2s
}

/// The discretised plates of 3k × k cells each: 12 k (k + 1) unknowns and 3k pairs of contact nodes
/// with two multipliers each; k = 60, …, 130 gives the n_u/m of [K Table 5].
[[nodiscard]] inline contact_scene<2> make_two_plates(int k) {
  require(k >= 1 && k <= 4000, "k", k, "between 1 and 4000 cells along the short edges");
  auto const plate = [&](double height) {
    return loaded_box<2>{.mesh = make_plate_mesh(k, height),
                         .material = lame_plane_stress(21.19e10, 0.277),
                         .fixed = {0, false}};
  };
  boxes_in_contact<2> pair{
      .first = plate(1), .second = plate(0), .contact = {1, false}, .slip_bound = 1.7e7};
  auto const loads = loads_on_plates();
  pair.first.loads = {loads.from_above, loads.at_end};
  return make_two_body_scene(pair);
}

}  // namespace fem
