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
// factored and swept in parallel where there is OpenMP (detail/parallel_for.hpp), with the same
// bits for any number of threads. Kept are the columns K U, so that an application costs one sweep
// with the factors and the product with those columns, and none with K.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/operators/detail/conjugate_part.hpp>
#include <slant/operators/detail/matrix_entries.hpp>

#include <Eigen/SparseCore>

#include <type_traits>
#include <utility>
#include <vector>

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

  template <class X>
    requires std::same_as<scalar_t<X>, S> && (local_t<X>::ColsAtCompileTime == 1)
  [[nodiscard]] auto workspace(X const& x) const {
    std::vector<room> w;
    w.reserve(parts_.size());
    for (part const& b : parts_) {
      vector_type v = vector_type::Zero(b.u.cols());
      w.push_back({v, v, slant::workspace(b.factors, v)});
    }
    static_cast<void>(x);
    return w;
  }
  template <class X>
    requires std::same_as<scalar_t<X>, S> && (local_t<X>::ColsAtCompileTime == 1)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return workspace(x);
  }

  /// y = Q x = x − U (UᵀKU)⁻¹ (K U)ᵀx.
  template <class X, class Y, class W>
    requires std::same_as<scalar_t<X>, S> && (local_t<X>::ColsAtCompileTime == 1)
  void apply(X const& x, Y& y, W& w) const {
    vectors::copy(x, y);
    sweep(&part::ku, &part::u, S(-1), x, y, w);
  }
  /// y = Qᵀx = x − K U (UᵀKU)⁻¹ Uᵀx.
  template <class X, class Y, class W>
    requires std::same_as<scalar_t<X>, S> && (local_t<X>::ColsAtCompileTime == 1)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    vectors::copy(x, y);
    sweep(&part::u, &part::ku, S(-1), x, y, w);
  }
  /// y ← y + α U (UᵀKU)⁻¹ Uᵀ b. Into y = 0 with α = 1 it is what minimises ½ uᵀKu − bᵀu over
  /// range(U) [D (4)]; with b = f − K y it is the step from y to the minimum over y + range(U).
  template <class X, class Y, class W>
    requires std::same_as<scalar_t<X>, S> && (local_t<X>::ColsAtCompileTime == 1)
  void add_minimiser(S α, X const& b, Y& y, W& w) const {
    sweep(&part::u, &part::u, α, b, y, w);
  }

 private:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  struct room {
    vector_type before;
    vector_type after;
    workspace_t<F, vector_type> factors;
  };

  /// y += α · left (UᵀKU)⁻¹ · rightᵀ x, body by body.
  template <class X, class Y, class W>
  void sweep(matrix_type part::*right, matrix_type part::*left, S α, X const& x, Y& y, W& w) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    detail::parallel_for(bodies(), work_, [&](index i) {
      part const& b = at(i);
      room& r = w[static_cast<std::size_t>(i)];
      r.before.noalias() = (b.*right).transpose() * from;
      if constexpr (requires { b.factors.solve(r.before, r.after, r.factors); }) {
        b.factors.solve(r.before, r.after, r.factors);
      } else {
        b.factors.solve(r.before, r.after);
      }
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
