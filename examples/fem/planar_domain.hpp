// SPDX-License-Identifier: MIT
//
// A triangulated domain of the plane whose boundary is divided into named parts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fem/box_mesh.hpp>
#include <fem/require.hpp>
#include <fem/simplex_mesh.hpp>

namespace fem {

/// An edge of the boundary; who walks along it has the domain on the left.
struct boundary_edge {
  int from;
  int to;
  int part = 0;  ///< number of the part of the boundary
};

/// The edges that belong to one triangle only, in the order of their first nodes. Throws
/// std::invalid_argument for an edge that has more triangles, or two on the same side.
[[nodiscard]] inline std::vector<boundary_edge> boundary_of(simplex_mesh<2> const& mesh) {
  // Walked around their triangles, inner edges appear once in each direction.
  std::vector<std::array<int, 4>> edges;  // smaller node, larger node, from, to
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    for (int a = 0; a < 3; ++a) {
      int const from = mesh.cells(a, cell);
      int const to = mesh.cells((a + 1) % 3, cell);
      edges.push_back({std::min(from, to), std::max(from, to), from, to});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<boundary_edge> boundary;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t same = i + 1;
    while (same < edges.size() && edges[same][0] == edges[i][0] && edges[same][1] == edges[i][1])
      ++same;
    bool const fits = same == i + 1 || (same == i + 2 && edges[i][2] != edges[i + 1][2]);
    require(fits, "cells", same - i, "one or two triangles at an edge, one on each side of it");
    if (same == i + 1) boundary.push_back({edges[i][2], edges[i][3]});
    i = same;
  }
  std::sort(boundary.begin(), boundary.end(), [](auto const& a, auto const& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  return boundary;
}

/// Triangles and the parts of their boundary.
struct planar_domain {
  simplex_mesh<2> mesh;
  std::vector<boundary_edge> boundary;  ///< all of it
  std::vector<std::string> parts;       ///< names by number

  /// Number of the part of that name. Throws std::invalid_argument if there is none.
  [[nodiscard]] int part(std::string_view name) const {
    auto const found = std::find(parts.begin(), parts.end(), name);
    require(found != parts.end(), "part of the boundary", name, "a name that the mesh has");
    return static_cast<int>(found - parts.begin());
  }
  /// Vector from the first to the second node of an edge.
  [[nodiscard]] Eigen::Vector2d along(boundary_edge const& edge) const {
    return mesh.nodes.col(edge.to) - mesh.nodes.col(edge.from);
  }
  /// Outer normal of an edge times its length.
  [[nodiscard]] Eigen::Vector2d outward(boundary_edge const& edge) const {
    Eigen::Vector2d const t = along(edge);
    return {t[1], -t[0]};
  }
};

/// A rectangle of n₀ × n₁ cells; its parts are called left, right, bottom and top.
[[nodiscard]] inline planar_domain make_rectangle(
    std::array<int, 2> const& cells, Eigen::Vector2d const& size,
    Eigen::Vector2d const& origin = Eigen::Vector2d::Zero()) {
  auto const box = make_box_mesh<2>(cells, size, origin);
  planar_domain domain{box, boundary_of(box), {"left", "right", "bottom", "top"}};
  for (auto& edge : domain.boundary)
    for (int part = 0; part < 4; ++part) {
      box_side const side{part / 2, part % 2 == 1};
      if (box.on(side, edge.from) && box.on(side, edge.to)) edge.part = part;
    }
  return domain;
}

}  // namespace fem
