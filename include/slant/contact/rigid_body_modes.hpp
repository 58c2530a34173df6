// SPDX-License-Identifier: MIT
//
// The rigid-body modes of linear elasticity, the kernel of the stiffness matrix of a body that is
// held nowhere: translations, and the linearised rotations ω × (x − x̄) about its centre.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/factorizations/kernel_basis.hpp>
#include <slant/multilevel/aggregation.hpp>

#include <Eigen/Core>
#include <Eigen/SVD>

#include <cmath>
#include <limits>

namespace slant::contact {

namespace detail {

/// Coordinates about the mean of all nodes, in multiples of the largest one. Directions in which
/// they differ by no more than its rounding errors are left out: a line must not become a rotation,
/// wherever it lies.
template <class S, class M>
[[nodiscard]] Eigen::MatrixX<S> about_centre(M const& nodes) {
  using std::sqrt;
  using matrix_type = Eigen::MatrixX<S>;
  auto const n = static_cast<S>(static_cast<double>(nodes.cols()));
  matrix_type x = nodes;
  S const factor = S(1) / unit_near(slant::detail::largest_of(x));
  for (index i = 0; i < x.rows(); ++i) {
    x.row(i) *= factor;
    x.row(i).array() -= x.row(i).sum() / n;
  }
  Eigen::JacobiSVD<matrix_type> const svd(x, Eigen::ComputeThinU);
  S const rounding = S(16) * sqrt(n) * std::numeric_limits<S>::epsilon();
  index rank = 0;
  for (S const& σ : svd.singularValues()) rank += σ > rounding ? 1 : 0;
  matrix_type const axes = svd.matrixU().leftCols(rank);
  return axes * matrix_type(axes.transpose() * x);
}

}  // namespace detail

/// Orthonormal basis of the motions of n nodes, D n × 3 in the plane (D = 2) and D n × 6 in space;
/// fewer where nodes on a line, or a single one, leave rotations without effect. `nodes` has D rows
/// and a column for each node; node i has the unknowns D i … D i + D − 1. Throws bad_input for
/// another number of rows, coordinates that are not finite, or no nodes.
template <class M>
[[nodiscard]] auto rigid_body_modes(Eigen::MatrixBase<M> const& nodes)
    -> Eigen::Matrix<typename M::Scalar, Eigen::Dynamic, Eigen::Dynamic> {
  using S = typename M::Scalar;
  index const D = nodes.rows(), n = nodes.cols();
  if (D != 2 && D != 3) {
    throw bad_input("rows of nodes", slant::detail::show(D), "2 or 3 coordinates");
  }
  if (n < 1) throw bad_input("columns of nodes", slant::detail::show(n), "at least one node");
  slant::detail::require_finite_entries("nodes", nodes.derived());

  return slant::detail::orthonormal_basis<S>(slant::detail::rigid_motions<S>(
      detail::about_centre<S>(nodes), D * n, [D](index j) { return j / D; },
      [D](index j) { return j % D; }));
}

}  // namespace slant::contact
