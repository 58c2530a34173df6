// SPDX-License-Identifier: MIT
//
// Two bricks of different steel [K Ex 6], in mm and MPa: Ω¹ = (0,2000) × (0,1000) × (1000,2000) on
// Ω² = (0,2000) × (0,1000) × (0,1000), E = 5e4, ν = 0.277 above and 0.35 below, slip bound g = 0.3.
// The traction (0, 0, −1) acts on the top of the upper body and on the right end of the lower one.
// Where the bodies are fixed is not printed; as in Ex 5 it is x = 0 here. The slip bounds of the
// nodes are gᵢ = ωᵢ g [K (14)].
#pragma once

#include <array>

#include <fem/two_bodies.hpp>

namespace fem {

/// A row of [K Table 6]: p × (p−1) × (p−1) cells per body give 6p³ unknowns and p² pairs of contact
/// nodes, the printed n_u/m. (The last one is printed as 413536; 6 · 41³ is 413526.)
struct printed_bricks {
  int p;
  int unknowns;
  int contact_nodes;
};
inline constexpr std::array<printed_bricks, 6> printed_bricks_sizes{{{16, 24576, 256},
                                                                     {21, 55566, 441},
                                                                     {26, 105456, 676},
                                                                     {31, 178746, 961},
                                                                     {36, 279936, 1296},
                                                                     {41, 413526, 1681}}};

/// The discretised bricks of p × (p−1) × (p−1) cells each.
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
