// SPDX-License-Identifier: MIT
//
// The place of each displacement unknown: a node, its coordinates, and a direction in space. The
// solvers do without it; checks and messages say more where it is known.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/concepts/bad_input.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant::contact {

/// Node and direction of each of the n_u unknowns. Empty: not known.
template <class S = double>
struct node_layout {
  using matrix_type = Eigen::MatrixX<S>;

  matrix_type x{};            ///< D × p, coordinates of the nodes
  std::vector<index> node{};  ///< n_u, a column of x for each unknown
  std::vector<int> axis{};    ///< n_u, the direction of each unknown, from 0 to D − 1

  [[nodiscard]] bool is_known() const { return !node.empty(); }
  /// The place of an unknown.
  [[nodiscard]] auto place(index j) const { return x.col(node[std::size_t(j)]); }
  /// The corners of the box around these unknowns, one at least.
  [[nodiscard]] std::pair<Eigen::VectorX<S>, Eigen::VectorX<S>> box(
      std::vector<index> const& unknowns) const {
    Eigen::VectorX<S> low = place(unknowns.front()), high = low;
    for (index const j : unknowns) {
      low = low.cwiseMin(place(j)).eval();
      high = high.cwiseMax(place(j)).eval();
    }
    return {low, high};
  }
  /// D, 0 if nothing is known.
  [[nodiscard]] index dimension() const { return is_known() ? index(x.rows()) : 0; }

  /// Throws bad_input unless nothing is known, or it is that of so many unknowns in the plane or in
  /// space.
  void validate(index unknowns) const {
    using slant::detail::show;
    if (!is_known()) return;
    if (x.rows() != 2 && x.rows() != 3) {
      throw bad_input("rows of x", show(index(x.rows())), "2 or 3 coordinates");
    }
    slant::detail::require_finite_entries("x", x);
    slant::detail::check_size("node", index(node.size()), unknowns, "one entry per unknown,");
    slant::detail::check_size("axis", index(axis.size()), unknowns, "one entry per unknown,");
    for (std::size_t j = 0; j < node.size(); ++j) {
      auto const i = index(j);
      if (node[j] < 0 || node[j] >= x.cols())
        throw bad_input("node", show(node[j]), "a column of x").at(i);
      if (axis[j] < 0 || axis[j] >= x.rows())
        throw bad_input("axis", show(axis[j]), "a row of x").at(i);
    }
  }
};

/// Unknowns first[i] … first[i] + D − 1 at node i, none where first[i] < 0.
template <class M, class I>
[[nodiscard]] node_layout<typename M::Scalar> layout_of(Eigen::MatrixBase<M> const& x,
                                                        I const& first) {
  slant::detail::check_size("first", index(first.size()), index(x.cols()), "the number of nodes,");
  node_layout<typename M::Scalar> layout;
  layout.x = x;
  index count = 0;
  for (index i = 0; i < x.cols(); ++i) {
    if (first[i] >= 0) count = std::max<index>(count, index(first[i]) + x.rows());
  }
  layout.node.assign(std::size_t(count), -1);
  layout.axis.assign(std::size_t(count), 0);
  for (index i = 0; i < x.cols(); ++i) {
    for (index k = 0; first[i] >= 0 && k < x.rows(); ++k) {
      auto const at = std::size_t(index(first[i]) + k);
      if (layout.node[at] >= 0) {
        throw bad_input("first", slant::detail::show(index(first[i])), "unknowns of its own").at(i);
      }
      layout.node[at] = i;
      layout.axis[at] = int(k);
    }
  }
  layout.validate(count);
  return layout;
}

/// Unknowns D i … D i + D − 1 at node i. Throws bad_input as node_layout::validate.
template <class M>
[[nodiscard]] node_layout<typename M::Scalar> interleaved_layout(Eigen::MatrixBase<M> const& x) {
  Eigen::VectorX<index> first(x.cols());
  for (index i = 0; i < first.size(); ++i) first[i] = x.rows() * i;
  return layout_of(x, first);
}

namespace detail {

// --- body graph ----------------------------------------------------------------------------------
//
// The graph of a stiffness matrix: unknowns i, j are neighbours if K_ij is stored. Its connected
// components are the bodies.

/// The number of each of the n unknowns among those of its body.
[[nodiscard]] inline std::vector<index> numbers_within(
    std::vector<std::vector<index>> const& bodies, index n) {
  std::vector<index> number(static_cast<std::size_t>(n));
  for (auto const& body : bodies) {
    for (std::size_t i = 0; i < body.size(); ++i) number[std::size_t(body[i])] = index(i);
  }
  return number;
}

/// Unknowns of each body, in increasing order; bodies in the order of their first unknown.
template <class S>
[[nodiscard]] std::vector<std::vector<index>> bodies_of(Eigen::SparseMatrix<S> const& k) {
  slant::detail::union_find sets(k.rows());
  slant::detail::for_each_entry(k, [&](index i, index j, S const&) {
    if (i < j) sets.join(i, j);
  });
  return sets.lists();
}

}  // namespace detail

}  // namespace slant::contact
