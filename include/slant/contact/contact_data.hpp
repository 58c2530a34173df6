// SPDX-License-Identifier: MIT
//
// The data of a contact scene besides its stiffness matrix.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <limits>
#include <vector>

namespace slant::contact::detail {

// --- contact checks ------------------------------------------------------------------------------
//
// The checks of gaps and slip bounds, whether they come with a scene or with a later load step.

/// Throws bad_input unless d has m entries that are numbers or +∞.
template <class V>
void check_gaps(V const& d, index m) {
  slant::detail::check_size("d", d.size(), m, "one gap per row of N,");
  for (index i = 0; i < m; ++i) {
    if (!(d(i) > -std::numeric_limits<scalar_t<V>>::infinity())) {
      throw bad_input("d", slant::detail::show(d(i)), "a number or +inf").at(i);
    }
  }
}

/// A row of zeros says 0 ≤ dᵢ, whatever u is. N may have more rows than d has entries. Throws
/// bad_input for a gap that no displacement opens.
template <class S, class V>
void check_reach(Eigen::SparseMatrix<S> const& N, V const& d) {
  std::vector<bool> is_zero(static_cast<std::size_t>(N.rows()), true);
  for (index j = 0; j < N.outerSize(); ++j) {
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(N, j); e; ++e) {
      if (e.value() != S(0)) is_zero[static_cast<std::size_t>(e.row())] = false;
    }
  }
  for (index i = 0; i < d.size(); ++i) {
    if (is_zero[static_cast<std::size_t>(i)] && d(i) < S(0)) {
      throw bad_input("d", slant::detail::show(d(i)),
                      "a number >= 0, since row " + slant::detail::show(i) +
                          " of N is zero: no displacement opens this gap")
          .at(i);
    }
  }
}

/// Throws bad_input unless g has m entries ≥ 0 or +∞; without tangents it is empty.
template <class V>
void check_slip_bounds(V const& g, index m, bool tangents) {
  if (!tangents) {
    slant::detail::check_size("g", g.size(), 0, "no slip bounds without T,");
    return;
  }
  slant::detail::check_size("g", g.size(), m, "one slip bound per row of N,");
  for (index i = 0; i < m; ++i) {
    if (!(g(i) >= scalar_t<V>(0))) {
      throw bad_input("g", slant::detail::show(g(i)), "a number >= 0 or +inf").at(i);
    }
  }
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- contact data --------------------------------------------------------------------------------

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

// --- contact unknowns ----------------------------------------------------------------------------
//
// The displacement unknowns that a contact scene's multipliers act on: what static_condensation
// keeps for the end.

/// The columns of a matrix that have an entry other than zero, in order.
template <class M>
[[nodiscard]] std::vector<index> touched_unknowns(Eigen::SparseMatrixBase<M> const& b) {
  Eigen::SparseMatrix<typename M::Scalar> const columns = b.derived();
  std::vector<index> touched;
  for (index j = 0; j < columns.cols(); ++j) {
    for (typename decltype(columns)::InnerIterator e(columns, j); e; ++e) {
      if (e.value() == 0) continue;
      touched.push_back(j);
      break;
    }
  }
  return touched;
}

/// Those of N and T together. Throws bad_input as data::validate does.
template <class S>
[[nodiscard]] std::vector<index> contact_unknowns(data<S> const& c) {
  c.validate();
  std::vector<char> marked(static_cast<std::size_t>(c.N.cols()), 0);
  for (index j : touched_unknowns(c.N)) marked[static_cast<std::size_t>(j)] = 1;
  for (index j : touched_unknowns(c.T)) marked[static_cast<std::size_t>(j)] = 1;
  std::vector<index> list;
  for (std::size_t j = 0; j < marked.size(); ++j) {
    if (marked[j] != 0) list.push_back(static_cast<index>(j));
  }
  return list;
}

}  // namespace slant::contact

namespace slant::contact::detail {

// --- gap loads -----------------------------------------------------------------------------------
//
// The linear term of dual contact problems, b = B u⁰ − c with the displacement u⁰ without contact.

/// b −= c for the normal multipliers, which are the first entries of b. A node with an infinite
/// gap, whose row of B is empty, gets a negative load instead: it keeps the multiplier at 0 and is
/// small enough not to show in ‖b‖. Its size is that of the other entries, which are lengths too;
/// without any, λ = 0 is the solution and no length is needed.
template <class S, class B>
void subtract_gaps(Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, B&& b) {
  if (d.size() == 0) return;
  auto const closes = [&](index i) { return slant::detail::is_finite(d(i)); };
  for (index i = 0; i < d.size(); ++i) {
    if (closes(i)) b(i) -= d(i);
  }
  auto const m = static_cast<S>(static_cast<double>(d.size()));
  S const size = b.cwiseAbs().maxCoeff() / m;
  for (index i = 0; i < d.size(); ++i) {
    if (!closes(i)) b(i) = size > S(0) ? S(-size) : S(-1);
  }
}
template <class S, class B>
void subtract_gaps(data<S> const& c, B&& b) {
  detail::subtract_gaps(c.d, b);
}

// --- stacked constraints -------------------------------------------------------------------------
//
// B = [N; T] of contact data.

/// B = [N; T]. A node that never meets its obstacle (infinite gap) presses on nothing: its row is
/// empty.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> stacked_constraints(data<S> const& c) {
  using sparse_type = Eigen::SparseMatrix<S>;
  std::vector<Eigen::Triplet<S>> entries;
  entries.reserve(static_cast<std::size_t>(c.N.nonZeros() + c.T.nonZeros()));
  auto append = [&](sparse_type const& m, index first_row, auto wanted) {
    for (index j = 0; j < m.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator e(m, j); e; ++e) {
        if (wanted(e.row())) {
          entries.emplace_back(static_cast<int>(first_row + e.row()), static_cast<int>(j),
                               e.value());
        }
      }
    }
  };
  append(c.N, 0, [&](index i) { return slant::detail::is_finite(c.d(i)); });
  append(c.T, c.nodes(), [](index) { return true; });
  sparse_type b(c.N.rows() + c.T.rows(), c.f.size());
  b.setFromTriplets(entries.begin(), entries.end());
  return b;
}

}  // namespace slant::contact::detail
