// SPDX-License-Identifier: MIT
//
// The sparse matrices of Total-FETI: blocks of bodies side by side, gluing above contact, and the
// resultants of the constraints without their rounding errors.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/detail/stacked_constraints.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <vector>

namespace slant::contact::detail {

/// Matrices as blocks on the diagonal of a sparse one, `of(block)` of each.
template <class S, class Blocks, class F>
[[nodiscard]] Eigen::SparseMatrix<S> diagonal_of(Blocks const& blocks, F of) {
  std::vector<Eigen::Triplet<S>> entries;
  index rows = 0, cols = 0;
  for (auto const& block : blocks) {
    auto const& m = of(block);
    slant::detail::for_each_entry(m, [&](index i, index j, S const& value) {
      entries.emplace_back(static_cast<int>(rows + i), static_cast<int>(cols + j), value);
    });
    rows += m.rows();
    cols += m.cols();
  }
  Eigen::SparseMatrix<S> whole(rows, cols);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// [B_E; N; T] for B_E u = c_E and the contact data. Throws bad_input if sizes do not match or
/// numbers are not finite.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> all_constraints(Eigen::SparseMatrix<S> const& B,
                                                     Eigen::Matrix<S, Eigen::Dynamic, 1> const& c,
                                                     data<S> const& of_contact) {
  slant::detail::check_size("columns of B", B.cols(), of_contact.f.size(), "the size of f,");
  slant::detail::check_size("c", c.size(), B.rows(), "the rows of B,");
  slant::detail::require_finite_entries("B", B);
  slant::detail::check_finite("c", c);
  Eigen::SparseMatrix<S> const contact = stacked_constraints(of_contact);
  std::vector<Eigen::Triplet<S>> entries;
  entries.reserve(static_cast<std::size_t>(B.nonZeros() + contact.nonZeros()));
  auto const append = [&](Eigen::SparseMatrix<S> const& m, index first) {
    slant::detail::for_each_entry(m, [&](index i, index j, S const& value) {
      entries.emplace_back(static_cast<int>(first + i), static_cast<int>(j), value);
    });
  };
  append(B, 0);
  append(contact, B.rows());
  Eigen::SparseMatrix<S> whole(B.rows() + contact.rows(), of_contact.f.size());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// G without entries that are rounding errors of their terms: a motion that B does not see would
/// become a row of its own, because rows count by their directions.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> without_rounding(Eigen::SparseMatrix<S> G,
                                                      Eigen::SparseMatrix<S> const& terms,
                                                      S const& rounding) {
  using std::abs;
  G.prune(
      [&](index i, index j, S const& value) { return abs(value) > rounding * terms.coeff(i, j); });
  return G;
}

}  // namespace slant::contact::detail
