// SPDX-License-Identifier: MIT
//
// One body of contact/bodies.hpp: U and its factors, with the numbers of the body alone, so that a
// body costs what it has unknowns, however many bodies there are.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/factorizations/kernel_basis.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// What becomes of a body.
template <class S, class F>
struct prepared_body {
  std::optional<slant::detail::conjugate_part<S, F>>
      inside;                      // rows numbered as in the body; none if U is empty
  Eigen::VectorX<S> displacement;  // if idle
  index attempts = 0;
  bool idle = false;
  bool fixed = false;
};

/// The columns of K of some unknowns of a body with the rows of the body, or of these unknowns.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> columns_of_body(Eigen::SparseMatrix<S> const& k,
                                                     std::vector<index> const& number,
                                                     std::vector<index> const& body,
                                                     std::vector<index> const& inside,
                                                     bool square) {
  auto const& rows = square ? inside : body;
  std::vector<index> row(body.size(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    row[std::size_t(number[std::size_t(rows[i])])] = index(i);
  }
  index entries = 0;
  for (index const j : inside) entries += k.col(j).nonZeros();
  Eigen::SparseMatrix<S> m(index(rows.size()), index(inside.size()));
  m.reserve(entries);
  for (index j = 0; j < m.cols(); ++j) {
    m.startVec(j);
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(k, inside[std::size_t(j)]); e; ++e) {
      index const i = row[std::size_t(number[std::size_t(e.row())])];
      if (i >= 0) m.insertBack(i, j) = e.value();
    }
  }
  m.finalize();
  return m;
}

/// Tries U = what no row touches, then without fixing rows, then none.
template <class F, class S, class V, class Factor>
[[nodiscard]] prepared_body<S, F> prepare_body(Eigen::SparseMatrix<S> const& k, V const& f,
                                               std::vector<index> const& body,
                                               std::vector<index> const& number,
                                               std::vector<unsigned char> const& touched,
                                               Factor const& factor) {
  prepared_body<S, F> result;
  std::vector<index> inside;
  for (index const i : body) {
    if (touched[std::size_t(i)] == 0) inside.push_back(i);
  }
  bool const free = inside.size() == body.size();
  if (inside.empty()) return result;
  Eigen::SparseMatrix<S> block = columns_of_body(k, number, body, inside, true);
  auto const take_inside = [&] {
    ++result.attempts;
    auto factors = factor(block);
    std::vector<index> rows;
    for (index const i : inside) rows.push_back(number[std::size_t(i)]);
    result.inside.emplace(slant::detail::conjugate_part<S, F>{
        slant::detail::columns_of_identity<S>(index(body.size()), rows),
        columns_of_body(k, number, body, inside, false), std::move(factors)});
  };
  try {
    take_inside();
  } catch (bad_input const&) {
    result.fixed = true;
  }
  if (result.fixed) {
    try {
      ++result.attempts;
      std::vector<index> const fixing = fixing_rows(computed_kernel(block));
      for (std::size_t j = fixing.size(); j-- > 0;) {
        inside.erase(inside.begin() + static_cast<std::ptrdiff_t>(fixing[j]));
      }
      if (inside.empty() || fixing.empty()) return result;
      block = columns_of_body(k, number, body, inside, true);
      take_inside();
    } catch (bad_input const&) {  // no kernel that can be told from the rest
    }
  } else if (free) {
    Eigen::VectorX<S> const load = f(body);
    result.displacement.resize(load.size());
    auto w = slant::workspace(result.inside->factors, load);
    slant::detail::solve_with(result.inside->factors, load, result.displacement, w);
    result.idle = true;
  }
  return result;
}

}  // namespace slant::contact::detail
