// SPDX-License-Identifier: MIT
//
// A mesh of simplices (triangles for D = 2, tetrahedra for D = 3) and the geometry of one P1
// element.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace fem {

/// Nodes and simplices; cells are positively oriented. Several bodies are several disjoint parts.
template <int D>
struct simplex_mesh {
  static constexpr int dimension = D;

  Eigen::Matrix<double, D, Eigen::Dynamic> nodes;     ///< coordinates, one column per node
  Eigen::Matrix<int, D + 1, Eigen::Dynamic> cells{};  ///< node numbers, one column per simplex

  [[nodiscard]] Eigen::Index node_count() const { return nodes.cols(); }
  [[nodiscard]] Eigen::Index cell_count() const { return cells.cols(); }
};

/// Volume (area for D = 2) of a simplex and the constant gradients of its D+1 hat functions.
template <int D>
struct p1_element {
  double volume;
  Eigen::Matrix<double, D, D + 1> gradients;  ///< column a is the gradient of hat function a
};

/// The P1 element on the simplex with the given vertices (columns).
/// With J = [v₁−v₀, …, v_D−v₀] the barycentric coordinates 1…D have the rows of J⁻¹ as gradients,
/// and coordinate 0 is one minus their sum.
template <int D>
[[nodiscard]] p1_element<D> make_p1_element(Eigen::Matrix<double, D, D + 1> const& vertices) {
  Eigen::Matrix<double, D, D> const J =
      vertices.template rightCols<D>().colwise() - vertices.col(0);
  p1_element<D> element;
  element.volume = J.determinant() / (D == 2 ? 2.0 : 6.0);
  element.gradients.template rightCols<D>() = J.inverse().transpose();
  element.gradients.col(0) = -element.gradients.template rightCols<D>().rowwise().sum();
  return element;
}

/// The P1 element on cell number `cell` of a mesh.
template <int D>
[[nodiscard]] p1_element<D> element_of(simplex_mesh<D> const& mesh, Eigen::Index cell) {
  Eigen::Matrix<double, D, D + 1> vertices;
  for (int a = 0; a <= D; ++a) vertices.col(a) = mesh.nodes.col(mesh.cells(a, cell));
  return make_p1_element<D>(vertices);
}

}  // namespace fem
