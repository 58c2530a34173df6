// SPDX-License-Identifier: MIT
//
// What a conjugate projector keeps of each body: its columns of U and of K U, and the factors of
// UᵀKU.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/checks.hpp>
#include <slant/operators/detail/parallel_for.hpp>
#include <slant/operators/detail/union_find.hpp>

#include <Eigen/SparseCore>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slant::detail {

template <class S, class F>
struct conjugate_part {
  Eigen::SparseMatrix<S> u;
  Eigen::SparseMatrix<S> ku;
  F factors;
};

/// Throws bad_input unless U and K U of each part have n rows and as many columns as its factors,
/// and no row is in two parts.
template <class S, class F>
void check_parts(index n, std::vector<conjugate_part<S, F>> const& parts) {
  std::vector<index> owner(static_cast<std::size_t>(n), -1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto const number = static_cast<index>(i);
    auto const check = [&](char const* what, Eigen::SparseMatrix<S> const& m) {
      if (m.rows() != n || m.cols() != parts[i].u.cols()) {
        throw bad_input(what, show(index(m.rows())) + " x " + show(index(m.cols())),
                        show(n) + " x " + show(index(parts[i].u.cols())))
            .at(number);
      }
      for (index j = 0; j < m.cols(); ++j) {
        for (typename Eigen::SparseMatrix<S>::InnerIterator e(m, j); e; ++e) {
          index& of_row = owner[static_cast<std::size_t>(e.row())];
          if (of_row >= 0 && of_row != number) {
            throw bad_input("parts", "row " + show(index(e.row())) + " of " + show(of_row),
                            "parts without common rows")
                .at(number);
          }
          of_row = number;
        }
      }
    };
    check("U", parts[i].u);
    check("K U", parts[i].ku);
    if (index(parts[i].factors.rows()) != parts[i].u.cols()) {
      throw bad_input("factors", show(index(parts[i].factors.rows())) + " rows",
                      "as many as columns of U, " + show(index(parts[i].u.cols())))
          .at(number);
    }
  }
}

/// The matrix of some columns of m.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> chosen_columns(Eigen::SparseMatrix<S> const& m,
                                                    std::vector<index> const& columns) {
  Eigen::SparseMatrix<S> part(m.rows(), static_cast<index>(columns.size()));
  index entries = 0;
  for (index const c : columns) entries += m.col(c).nonZeros();
  part.reserve(entries);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    part.startVec(static_cast<index>(j));
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(m, columns[j]); e; ++e) {
      part.insertBack(e.row(), static_cast<index>(j)) = e.value();
    }
  }
  part.finalize();
  return part;
}

/// The columns of each body, in increasing order; bodies in the order of their first column.
/// Columns belong to one body if they or their images share a row. Throws bad_input for an empty
/// column.
template <class S>
[[nodiscard]] std::vector<std::vector<index>> columns_by_body(Eigen::SparseMatrix<S> const& u,
                                                              Eigen::SparseMatrix<S> const& ku) {
  union_find rows(u.rows());
  std::vector<index> first_row(static_cast<std::size_t>(u.cols()), -1);
  for (index j = 0; j < u.cols(); ++j) {
    index& first = first_row[static_cast<std::size_t>(j)];
    for (auto const* m : {&u, &ku}) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(*m, j); e; ++e) {
        if (first < 0) first = e.row();
        rows.join(first, e.row());
      }
    }
    if (first < 0) throw bad_input("U", "an empty column", "columns of full rank").at(j);
  }
  std::vector<index> body_of(static_cast<std::size_t>(u.rows()), -1);
  std::vector<std::vector<index>> bodies;
  for (index j = 0; j < u.cols(); ++j) {
    index const root = rows.find(first_row[static_cast<std::size_t>(j)]);
    index& number = body_of[static_cast<std::size_t>(root)];
    if (number < 0) {
      number = static_cast<index>(bodies.size());
      bodies.emplace_back();
    }
    bodies[static_cast<std::size_t>(number)].push_back(j);
  }
  return bodies;
}

/// All parts, factored in parallel. Throws bad_input for the first that the factorisation refuses.
template <class F, class S, class Factor>
[[nodiscard]] std::vector<conjugate_part<S, F>> conjugate_parts(Eigen::SparseMatrix<S> const& k,
                                                                Eigen::SparseMatrix<S> const& u,
                                                                Factor const& factor) {
  Eigen::SparseMatrix<S> const ku = k * u;
  auto const bodies = columns_by_body(u, ku);
  std::vector<std::optional<conjugate_part<S, F>>> made(bodies.size());
  parallel_for(static_cast<index>(bodies.size()), std::numeric_limits<index>::max(), [&](index i) {
    auto const at = static_cast<std::size_t>(i);
    auto own = chosen_columns(u, bodies[at]);
    auto image = chosen_columns(ku, bodies[at]);
    Eigen::SparseMatrix<S> const block = own.transpose() * image;
    try {
      made[at].emplace(conjugate_part<S, F>{std::move(own), std::move(image), factor(block)});
    } catch (bad_input const& e) {
      throw bad_input("U",
                      "a U'KU of body " + show(i) + " that cannot be factored (" + e.what() + ")",
                      "columns on which K is positive definite");
    }
  });
  std::vector<conjugate_part<S, F>> parts;
  parts.reserve(made.size());
  for (auto& part : made) parts.push_back(std::move(*part));
  return parts;
}

}  // namespace slant::detail
