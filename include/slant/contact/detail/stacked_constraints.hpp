// SPDX-License-Identifier: MIT
//
// B = [N; T] of contact data.
#pragma once

#include <slant/contact/contact_data.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace slant::contact::detail {

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
