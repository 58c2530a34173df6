// SPDX-License-Identifier: MIT
//
// The conjugate projector [D §4]
//
//     Q = I − U (UᵀKU)⁻¹ UᵀK,        Q² = Q,   K Q = Qᵀ K Q = Qᵀ K,   Q U = 0,            [D (5)]
//
// K symmetric positive semidefinite, U of full rank with UᵀKU positive definite. It projects along
// range(U) onto what is K-orthogonal to range(U). With U the injection of the interior unknowns of
// bodies that K does not connect, UᵀKU is block diagonal: the Dirichlet problems of the bodies.
//
// Bodies. Columns of U belong to one body if they, or their images under K, share a row. Each body
// has a factor of its own, and a sweep over it reads and writes its own rows only: bodies are
// factored and swept in parallel where there is OpenMP (base/parallel_for.hpp), with the same
// bits for any number of threads. Kept are the columns K U, so that an application costs one sweep
// with the factors and the product with those columns, and none with K.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/parallel_for.hpp>
#include <slant/base/partitions.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/factorizations/ldlt.hpp>

#include <Eigen/SparseCore>

#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::detail {

/// A vector of numbers S, one and not several side by side.
template <class X, class S>
concept column_of = has_scalar<X, S> && (local_t<X>::ColsAtCompileTime == 1);

/// What is kept of each body: its columns of U and of K U, and the factors of UᵀKU.
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
        throw bad_input(what, size_text(m.rows(), m.cols()), size_text(n, parts[i].u.cols()))
            .at(number);
      }
      for_each_entry(m, [&](index row, index, S const&) {
        index& of_row = owner[static_cast<std::size_t>(row)];
        if (of_row >= 0 && of_row != number) {
          throw bad_input("parts", "row " + show(row) + " of " + show(of_row),
                          "parts without common rows")
              .at(number);
        }
        of_row = number;
      });
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

/// The columns of each body, in increasing order; bodies in the order of their first column.
/// Columns belong to one body if they or their images share a row. Throws bad_input for an empty
/// column.
template <class S>
[[nodiscard]] std::vector<std::vector<index>> columns_by_body(Eigen::SparseMatrix<S> const& u,
                                                              Eigen::SparseMatrix<S> const& ku) {
  union_find columns(u.cols());
  std::vector<index> first_column(static_cast<std::size_t>(u.rows()), -1);  // of each row
  for (index j = 0; j < u.cols(); ++j) {
    bool is_empty = true;
    for (auto const* m : {&u, &ku}) {
      for (typename Eigen::SparseMatrix<S>::InnerIterator e(*m, j); e; ++e) {
        index& first = first_column[static_cast<std::size_t>(e.row())];
        if (first < 0) first = j;
        columns.join(first, j);
        is_empty = false;
      }
    }
    if (is_empty) throw bad_input("U", "an empty column", "columns of full rank").at(j);
  }
  return columns.lists();
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
    Eigen::SparseMatrix<S> const chosen = columns_of_identity<S>(u.cols(), bodies[at]);
    Eigen::SparseMatrix<S> own = u * chosen, image = ku * chosen;
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

namespace slant {

/// Factors by slant::ldlt, whose sweeps are plain loops: their bits depend on nothing else.
struct factor_by_ldlt {
  template <class M>
  [[nodiscard]] auto operator()(M const& k) const {
    return ldlt<typename M::Scalar>(k);
  }
};

/// Q x and Qᵀx, see the top of this file. S: the scalar; F: the factorisation of a body.
template <class S, class F>
class conjugate_projector_operator {
 public:
  using scalar = S;
  using matrix_type = Eigen::SparseMatrix<S>;
  static constexpr law_set laws = slant::laws<slant::projector>;

  using part = detail::conjugate_part<S, F>;

  /// For vectors with n entries. Throws bad_input if the matrices of a part do not fit, or if a row
  /// is in two parts: sweeps over them would write to the same entry.
  conjugate_projector_operator(index n, std::vector<part> parts)
      : rows_(n), parts_(std::move(parts)) {
    detail::check_parts(n, parts_);
    for (part const& b : parts_) work_ += b.ku.nonZeros();
  }

  [[nodiscard]] index rows() const noexcept { return rows_; }
  [[nodiscard]] index cols() const noexcept { return rows_; }
  /// Number of bodies, each factored once.
  [[nodiscard]] index bodies() const noexcept { return static_cast<index>(parts_.size()); }
  /// The matrices U and K U of one body; of all bodies together they are U and K U.
  [[nodiscard]] matrix_type const& u(index i) const { return at(i).u; }
  [[nodiscard]] matrix_type const& ku(index i) const { return at(i).ku; }

  [[nodiscard]] auto workspace(detail::column_of<S> auto const&) const {
    std::vector<room> w;
    w.reserve(parts_.size());
    for (part const& b : parts_) {
      vector_type v = vector_type::Zero(b.u.cols());
      w.push_back({v, v, slant::workspace(b.factors, v)});
    }
    return w;
  }
  [[nodiscard]] auto adjoint_workspace(detail::column_of<S> auto const& x) const {
    return workspace(x);
  }

  /// y = Q x = x − U (UᵀKU)⁻¹ (K U)ᵀx.
  void apply(detail::column_of<S> auto const& x, auto& y, auto& w) const {
    vectors::copy(x, y);
    sweep(&part::ku, &part::u, S(-1), x, y, w);
  }
  /// y = Qᵀx = x − K U (UᵀKU)⁻¹ Uᵀx.
  void apply_adjoint(detail::column_of<S> auto const& x, auto& y, auto& w) const {
    vectors::copy(x, y);
    sweep(&part::u, &part::ku, S(-1), x, y, w);
  }
  /// y ← y + α U (UᵀKU)⁻¹ Uᵀ b. Into y = 0 with α = 1 it is what minimises ½ uᵀKu − bᵀu over
  /// range(U) [D (4)]; with b = f − K y it is the step from y to the minimum over y + range(U).
  void add_minimiser(S α, detail::column_of<S> auto const& b, auto& y, auto& w) const {
    sweep(&part::u, &part::u, α, b, y, w);
  }

 private:
  using vector_type = Eigen::VectorX<S>;

  struct room {
    vector_type before;
    vector_type after;
    workspace_t<F, vector_type> factors;
  };

  /// y += α · left (UᵀKU)⁻¹ · rightᵀ x, body by body.
  void sweep(matrix_type part::*right, matrix_type part::*left, S α, auto const& x, auto& y,
             auto& w) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    detail::parallel_for(bodies(), work_, [&](index i) {
      part const& b = at(i);
      room& r = w[static_cast<std::size_t>(i)];
      r.before.noalias() = (b.*right).transpose() * from;
      detail::solve_with(b.factors, r.before, r.after, r.factors);
      matrix_type const& columns = b.*left;
      for (index j = 0; j < columns.cols(); ++j) {
        S const t = α * r.after[j];
        for (typename matrix_type::InnerIterator e(columns, j); e; ++e) {
          to.coeffRef(e.row()) += e.value() * t;
        }
      }
    });
  }

  [[nodiscard]] part const& at(index i) const { return parts_[static_cast<std::size_t>(i)]; }

  index rows_;
  index work_ = 0;  // entries of K U: less than those of the factors
  std::vector<part> parts_;
};

/// Q of a sparse K and a sparse U with as many rows. factor(matrix) factors the block of a body;
/// with slant::cholmod, bits may depend on the threads of its BLAS. Throws bad_input if K is not
/// square and symmetric, an entry is not finite, its diagonal shows that it is not semidefinite, U
/// does not fit, or UᵀKU is not definite.
template <class M, class N, class Factor = factor_by_ldlt>
  requires detail::is_sparse_matrix<M> && detail::is_sparse_matrix<N>
[[nodiscard]] auto conjugate_projector(M const& k, N const& u, Factor const& factor = {}) {
  using S = typename M::Scalar;
  using matrix_type = Eigen::SparseMatrix<S>;
  detail::require_square("K", k);
  detail::require_rows("U", u, k.rows(), "the rows of K");
  detail::require_finite_entries("U", u);
  detail::require_finite_entries("K", k);
  detail::require_symmetric_entries("K", k);
  detail::require_semidefinite_diagonal("K", k);
  using F = std::remove_cvref_t<decltype(factor(std::declval<matrix_type const&>()))>;
  return conjugate_projector_operator<S, F>(
      k.rows(), detail::conjugate_parts<F, S>(matrix_type(k), matrix_type(u), factor));
}

}  // namespace slant
