// SPDX-License-Identifier: MIT
//
// The displacement unknowns that a contact scene's multipliers act on: what static_condensation
// keeps for the end.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/contact/contact_data.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace slant::contact {

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
