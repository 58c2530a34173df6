// SPDX-License-Identifier: MIT
//
// The data of a contact scene besides its stiffness matrix.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/detail/contact_checks.hpp>
#include <slant/operators/detail/matrix_entries.hpp>

#include <Eigen/SparseCore>

namespace slant::contact {

/// Contact data of a body (or several) with n_u displacement unknowns and m contact nodes.
template <class S = double>
struct data {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  sparse_type N;  ///< m × n_u, normal displacement of each contact node
  sparse_type T;  ///< m × n_u (2D) or 2m × n_u (3D, rows 2i and 2i+1 of node i), or 0 × n_u
  vector_type f;  ///< n_u, load
  vector_type d;  ///< m, gap in normal direction; +infinity: the node never meets the obstacle
  vector_type g;  ///< m, slip bound (a force) per node; +infinity: it sticks; empty: no friction

  /// Number of contact nodes m.
  [[nodiscard]] index nodes() const { return N.rows(); }
  /// Tangential directions per node: 0, 1 or 2.
  [[nodiscard]] index tangents() const { return nodes() == 0 ? 0 : T.rows() / nodes(); }

  /// Throws bad_input naming the argument, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using slant::detail::check_size;
    if (N.rows() < 1) throw bad_input("N", slant::detail::show(N.rows()), "at least one row");
    check_size("columns of N", N.cols(), f.size(), "the size of f,");
    check_size("d", d.size(), nodes(), "one gap per row of N,");
    slant::detail::check_finite("f", f);
    slant::detail::require_finite_entries("N", N);
    slant::detail::require_finite_entries("T", T);
    detail::check_gaps(d, nodes());
    detail::check_reach(N, d);
    if (T.rows() == 0) {
      detail::check_slip_bounds(g, nodes(), false);
      return;
    }
    check_size("columns of T", T.cols(), f.size(), "the size of f,");
    if (T.rows() != nodes() && T.rows() != 2 * nodes()) {
      throw bad_input(
          "rows of T", slant::detail::show(T.rows()),
          slant::detail::show(nodes()) + " (2D) or " + slant::detail::show(2 * nodes()) + " (3D)");
    }
    detail::check_slip_bounds(g, nodes(), true);
  }
};

}  // namespace slant::contact
