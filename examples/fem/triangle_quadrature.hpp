// SPDX-License-Identifier: MIT
//
// Integration over triangles and edges by values at a few points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace fem {

/// A point of a triangle by its barycentric coordinates, and its share of the area.
struct triangle_point {
  Eigen::Vector3d at;
  double weight;
};

/// Radon's seven points: exact for polynomials of degree 5 [Radon 1948]. Weights sum to 1.
[[nodiscard]] inline std::array<triangle_point, 7> triangle_points() {
  double const root = std::sqrt(15.0);
  double const a = (6 - root) / 21;
  double const b = (6 + root) / 21;
  double const wa = (155 - root) / 1200;
  double const wb = (155 + root) / 1200;
  return {{{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 40},
           {{1 - 2 * a, a, a}, wa},
           {{a, 1 - 2 * a, a}, wa},
           {{a, a, 1 - 2 * a}, wa},
           {{1 - 2 * b, b, b}, wb},
           {{b, 1 - 2 * b, b}, wb},
           {{b, b, 1 - 2 * b}, wb}}};
}

/// A point of an edge by its distance from the first end, and its share of the length.
struct edge_point {
  double at;
  double weight;
};

/// Gauss' three points: exact for polynomials of degree 5. Weights sum to 1.
[[nodiscard]] inline std::array<edge_point, 3> edge_points() {
  double const d = std::sqrt(0.15);
  return {{{0.5 - d, 5.0 / 18}, {0.5, 4.0 / 9}, {0.5 + d, 5.0 / 18}}};
}

}  // namespace fem
