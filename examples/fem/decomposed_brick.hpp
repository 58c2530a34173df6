// SPDX-License-Identifier: MIT
//
// The steel brick made of cubes, each of them a subdomain: with a fixed number of cells in a cube
// (H/h) it grows with the number of subdomains.
#pragma once

#include <array>
#include <utility>

#include <fem/decomposition.hpp>
#include <fem/steel_brick.hpp>

namespace fem {

/// Cubes of edge 1 along each axis, cells along the edge of each, and what acts on them.
struct decomposed_brick_options {
  std::array<int, 3> cubes{2, 1, 1};
  int cells = 4;
  brick_load load = brick_load::press;
};

/// A brick, whole and in parts.
struct decomposed_brick {
  contact_scene<3> scene;
  decomposed_scene parts;
};

/// Material, supports and tractions are those of the steel brick. Throws std::invalid_argument for
/// less than one cube along an axis or one cell along an edge.
[[nodiscard]] inline decomposed_brick make_decomposed_brick(
    decomposed_brick_options const& options) {
  auto const& [x, y, z] = options.cubes;
  for (int const cubes : options.cubes)
    require(cubes >= 1 && cubes <= 100, "cubes", cubes, "between 1 and 100 along each axis");
  int const c = options.cells;
  require(c >= 1 && c <= 100, "cells", c, "between 1 and 100 along the edge of a cube");
  auto const mesh = make_box_mesh<3>({c * x, c * y, c * z}, {double(x), double(y), double(z)});
  brick_loading const loading = loading_of(options.load);
  lame_parameters const steel = lame(2.119e5, 0.277);
  contact_scene<3> scene = make_contact_scene<3>({.mesh = mesh,
                                                  .material = steel,
                                                  .fixed = brick_side::left,
                                                  .contact = brick_side::bottom,
                                                  .loads = loading.tractions,
                                                  .slip_bound = loading.slip_bound});
  decomposed_scene parts = decompose<3>(scene, steel, box_partition<3>(mesh, options.cubes));
  return {std::move(scene), std::move(parts)};
}

}  // namespace fem
