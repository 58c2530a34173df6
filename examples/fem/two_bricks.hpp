// SPDX-License-Identifier: MIT
//
// Two bricks of different steel [K Ex 6], in mm and MPa: Ω¹ = (0,2000) × (0,1000) × (1000,2000) on
// Ω² = (0,2000) × (0,1000) × (0,1000), E = 5e4, ν = 0.277 above and 0.35 below, slip bound g = 0.3.
// The traction (0, 0, −1) acts on the top of the upper body and on the right end of the lower one.
// Where the bodies are fixed is not printed; as in Ex 5 it is x = 0 here. The slip bounds of the
// nodes are gᵢ = ωᵢ g [K (14)].
#pragma once

#include <fem/two_bodies.hpp>

namespace fem {

/// The discretised bricks of p × (p−1) × (p−1) cells each: 6p³ unknowns and p² pairs of contact
/// nodes, the n_u/m of [K Table 6] for p = 16, 21, …, 41.
[[nodiscard]] inline contact_scene<3> make_two_bricks(int p) {
  require(p >= 2 && p <= 400, "p", p, "between 2 and 400 free nodes along each edge");
  auto const brick = [&](double height, double ν) {
    return loaded_box<3>{
        .mesh = make_box_mesh<3>({p, p - 1, p - 1}, {2000, 1000, 1000}, {0, 0, height}),
        .material = lame(5e4, ν),
        .fixed = {0, false}};
  };
  boxes_in_contact<3> pair{.first = brick(1000, 0.277),
                           .second = brick(0, 0.35),
                           .contact = {2, false},
                           .slip_bound = 0.3};
  pair.first.loads.push_back({{2, true}, {0, 0, -1}});
  pair.second.loads.push_back({{0, true}, {0, 0, -1}});
  return make_two_body_scene(pair);
}

}  // namespace fem
