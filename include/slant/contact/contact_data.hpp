// SPDX-License-Identifier: MIT
//
// The data of a contact scene besides its stiffness matrix.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- contact checks ------------------------------------------------------------------------------

/// Throws bad_input "name[3]: …" for the first entry that is not `good`.
template <class V, class Good>
void check_each(char const* name, V const& v, char const* expectation, Good const& good) {
  for (index i = 0; i < v.size(); ++i) {
    if (!good(v(i))) throw bad_input(name, slant::detail::show(v(i)), expectation).at(i);
  }
}

/// Throws bad_input unless d has m entries that are numbers or +∞.
template <class V>
void check_gaps(V const& d, index m) {
  using S = scalar_t<V>;
  slant::detail::check_size("d", d.size(), m, "one gap per row of N,");
  check_each("d", d, "a number or +inf",
             [](S const& x) { return x > -std::numeric_limits<S>::infinity(); });
}

/// Throws bad_input unless all friction coefficients are finite and ≥ 0.
template <class V>
void check_coefficients(char const* name, V const& F) {
  using S = scalar_t<V>;
  check_each(name, F, "a finite number >= 0",
             [](S const& x) { return x >= S(0) && slant::detail::is_finite(x); });
}

/// A row of zeros says 0 ≤ dᵢ, whatever u is. N may have more rows than d has entries. Throws
/// bad_input for a gap that no displacement opens.
template <class S, class V>
void check_reach(Eigen::SparseMatrix<S> const& N, V const& d) {
  std::vector<bool> is_zero(std::size_t(N.rows()), true);
  slant::detail::for_each_entry(N, [&](index i, index, S const& value) {
    if (value != S(0)) is_zero[std::size_t(i)] = false;
  });
  for (index i = 0; i < d.size(); ++i) {
    if (is_zero[std::size_t(i)] && d(i) < S(0)) {
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
  check_each("g", g, "a number >= 0 or +inf",
             [](scalar_t<V> const& x) { return x >= scalar_t<V>(0); });
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- contact data --------------------------------------------------------------------------------

/// Contact data of a body (or several) with n_u displacement unknowns and m contact nodes.
template <class S = double>
struct data {
  using vector_type = Eigen::VectorX<S>;
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
    slant::detail::check_finite("f", f);
    slant::detail::require_finite_entries("N", N);
    slant::detail::require_finite_entries("T", T);
    detail::check_gaps(d, nodes());
    detail::check_reach(N, d);
    bool const has_tangents = T.rows() > 0;
    if (has_tangents) check_size("columns of T", T.cols(), f.size(), "the size of f,");
    if (has_tangents && T.rows() != nodes() && T.rows() != 2 * nodes()) {
      throw bad_input(
          "rows of T", slant::detail::show(T.rows()),
          slant::detail::show(nodes()) + " (2D) or " + slant::detail::show(2 * nodes()) + " (3D)");
    }
    detail::check_slip_bounds(g, nodes(), has_tangents);
  }
};

}  // namespace slant::contact

namespace slant::contact::detail {

/// Throws bad_input unless the data are valid and K is a matrix of their unknowns.
template <class M, class S>
void check_scene(M const& K, data<S> const& c) {
  c.validate();
  slant::detail::check_size("rows of K", K.rows(), c.f.size(), "the size of f,");
  slant::detail::check_size("columns of K", K.cols(), c.f.size(), "the size of f,");
}

// --- gap loads -----------------------------------------------------------------------------------

/// b −= c for the normal multipliers, which are the first entries of b = B u⁰, u⁰ the displacement
/// without contact. A node with an infinite gap, whose row of B is empty, gets a negative load
/// instead: it keeps the multiplier at 0 and is small enough not to show in ‖b‖. Its size is that
/// of the entries of `all`, b or what it is a part of, which are lengths too; without any, λ = 0 is
/// the solution and no length is needed.
template <class S, class B>
void subtract_gaps(Eigen::VectorX<S> const& d, B&& b, Eigen::VectorX<S> const& all) {
  if (d.size() == 0) return;
  auto const closes = [&](index i) { return slant::detail::is_finite(d(i)); };
  for (index i = 0; i < d.size(); ++i) {
    if (closes(i)) b(i) -= d(i);
  }
  auto const m = static_cast<S>(static_cast<double>(d.size()));
  S const size = all.cwiseAbs().maxCoeff() / m;
  for (index i = 0; i < d.size(); ++i) {
    if (!closes(i)) b(i) = size > S(0) ? S(-size) : S(-1);
  }
}

// --- stacked constraints -------------------------------------------------------------------------

/// A above B.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> stacked(Eigen::SparseMatrix<S> const& A,
                                             Eigen::SparseMatrix<S> const& B) {
  std::vector<Eigen::Triplet<S>> entries;
  entries.reserve(std::size_t(A.nonZeros() + B.nonZeros()));
  for (auto const* m : {&A, &B}) {
    index const first = m == &A ? 0 : A.rows();
    slant::detail::for_each_entry(*m, [&](index i, index j, S const& value) {
      entries.emplace_back(int(first + i), int(j), value);
    });
  }
  Eigen::SparseMatrix<S> whole(A.rows() + B.rows(), A.cols());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// B = [N; T]. A node that never meets its obstacle (infinite gap) presses on nothing: its row is
/// empty.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> stacked_constraints(data<S> const& c) {
  Eigen::SparseMatrix<S> N = c.N;
  N.prune([&](index i, index, S const&) { return slant::detail::is_finite(c.d(i)); });
  return stacked(N, c.T);
}

// --- units of rows -------------------------------------------------------------------------------
//
// Gaps, slip bounds and forces are in units of their rows of N and T. Where entries of these are
// far from 1 their squares are no numbers, and the problem is solved for rows U (N, T) and forces
// λ' = U⁻¹λ: the same one, as U consists of powers of two.

/// Powers of two near the largest entry of each row of B = [N; T] of m contacts, one for the tangents
/// of a contact; 1 for an empty row.
template <class S>
[[nodiscard]] Eigen::VectorX<S> units_of_rows(Eigen::SparseMatrix<S> const& B, index m) {
  index const per = m > 0 ? (B.rows() - m) / m : 0;
  auto const of_contact = [&](index i) { return i < m ? i : m + (i - m) / per * per; };
  Eigen::VectorX<S> U = Eigen::VectorX<S>::Zero(B.rows());
  slant::detail::for_each_entry(B, [&](index i, index, S const& value) {
    using std::abs;
    U[of_contact(i)] = std::max<S>(U[of_contact(i)], abs(value));
  });
  for (index i = 0; i < U.size(); ++i) U[i] = of_contact(i) == i ? unit_near(U[i]) : U[i - 1];
  return U;
}
/// U = 1/units_of_rows. Empty where none is beyond 2^±64.
template <class S>
[[nodiscard]] Eigen::VectorX<S> row_units(data<S> const& c) {
  Eigen::VectorX<S> const U = units_of_rows(stacked(c.N, c.T), c.nodes());
  bool const moderate = (U.array() <= S(0x1p64) && U.array() >= S(0x1p-64)).all();
  return moderate ? Eigen::VectorX<S>() : Eigen::VectorX<S>(U.cwiseInverse());
}
/// x, its entries within the range of the numbers where those of `before` are.
template <class S>
[[nodiscard]] Eigen::VectorX<S> kept_finite(Eigen::VectorX<S> x, Eigen::VectorX<S> const& before) {
  constexpr S most = std::numeric_limits<S>::max();
  for (index i = 0; i < x.size(); ++i) {
    if (slant::detail::is_finite(before[i])) x[i] = std::clamp<S>(x[i], -most, most);
  }
  return x;
}
/// The data in these units.
template <class S>
[[nodiscard]] data<S> with_units(data<S> c, Eigen::VectorX<S> const& U) {
  index const m = c.nodes();
  c.N = Eigen::SparseMatrix<S>(U.head(m).asDiagonal() * c.N);
  c.T = Eigen::SparseMatrix<S>(U.tail(c.T.rows()).asDiagonal() * c.T);
  c.d = kept_finite<S>(c.d.cwiseProduct(U.head(m)), c.d);
  Eigen::VectorX<S> g = c.g;
  for (index i = 0; i < g.size(); ++i) g[i] /= U[m + i * c.tangents()];
  c.g = kept_finite<S>(std::move(g), c.g);
  return c;
}

/// ‖row‖² of each row of B.
template <class S>
[[nodiscard]] Eigen::VectorX<S> row_squares(Eigen::SparseMatrix<S> const& B) {
  return B.cwiseAbs2() * Eigen::VectorX<S>::Ones(B.cols());
}

}  // namespace slant::contact::detail

namespace slant::contact {

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

/// Those of N and T together, in order. Throws bad_input as data::validate does.
template <class S>
[[nodiscard]] std::vector<index> contact_unknowns(data<S> const& c) {
  c.validate();
  return touched_unknowns(detail::stacked(c.N, c.T));
}

}  // namespace slant::contact
