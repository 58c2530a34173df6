// SPDX-License-Identifier: MIT
//
// Sparse LDLᵀ by Eigen, for symmetric positive definite matrices: the default, needs nothing else.
//
//     auto Kinv = slant::inverse(slant::ldlt(K));
//
// What is factored is K / 2^e with the power of two that brings the largest entry to [1, 2): exact,
// so in other units (2^k K) the factors are the same bit for bit, and no pivot overflows.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <memory>
#include <string_view>

namespace slant::detail {

/// P K Pᵀ = L D Lᵀ of the lower triangle of K by Eigen, without pivoting: the pivots have the signs
/// of the eigenvalues, for those who use it to look at. With the parts that Eigen gives away only
/// as copies (D) or protects, and a solve that allocates nothing.
template <class S>
class sparse_ldlt_factors : public Eigen::SimplicialLDLT<Eigen::SparseMatrix<S>, Eigen::Lower> {
 public:
  using matrix_type = Eigen::SparseMatrix<S>;
  using vector_type = Eigen::VectorX<S>;

  sparse_ldlt_factors() = default;
  explicit sparse_ldlt_factors(matrix_type const& k) {
    // The ordering of an empty matrix is more than Eigen can do.
    if (k.rows() > 0) this->compute(k);
  }
  /// L without its unit diagonal, compressed by columns.
  [[nodiscard]] matrix_type const& lower() const { return this->m_matrix; }
  /// D. A pivot that is exactly zero ends the factorisation; what follows it is not set.
  [[nodiscard]] vector_type const& pivots() const { return this->m_diag; }
  [[nodiscard]] auto const& permutation() const { return this->m_P; }
  [[nodiscard]] index original_row(index i) const { return this->m_Pinv.indices()[i]; }

  /// v ← L⁻ᵀ D⁻¹ L⁻¹ v. Plain loops over the arrays: Eigen's solveInPlace looks them up anew for
  /// each column. Not inlined: what surrounds them would take registers from the innermost loops,
  /// which g++ 12 pays with 5 % more instructions.
  [[gnu::noinline]] void solve_in_place(S* v) const {
    index const n = this->m_matrix.rows();
    int const* const begin = this->m_matrix.outerIndexPtr();
    int const* const row = this->m_matrix.innerIndexPtr();
    S const* const entry = this->m_matrix.valuePtr();
    S const* const pivot = this->m_diag.data();
    for (index k = 0; k < n; ++k) {
      S const t = v[k];
      if (t == S(0)) continue;  // right-hand sides like Bᵀx are mostly zeros
      for (index p = begin[k], end = begin[k + 1]; p < end; ++p) v[row[p]] -= entry[p] * t;
    }
    for (index k = n; k-- > 0;) {
      S t = v[k] / pivot[k];
      for (index p = begin[k], end = begin[k + 1]; p < end; ++p) t -= entry[p] * v[row[p]];
      v[k] = t;
    }
  }
};

}  // namespace slant::detail

namespace slant {

/// P K Pᵀ = 2^e L D Lᵀ. Copies share the factors, which never change.
template <class S = double>
class ldlt {
 public:
  using scalar = S;
  using matrix_type = Eigen::SparseMatrix<S>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Throws bad_input if K is not square, has an entry that is NaN or infinite, is not symmetric
  /// (up to 1024 ε, naming the worst pair), or not definite (naming the pivot).
  template <class M>
  explicit ldlt(Eigen::SparseMatrixBase<M> const& k) {
    matrix_type normalised = k.derived();
    detail::require_symmetric_matrix("K", normalised);
    int const exponent = detail::scale_exponent(normalised);
    unit_ = detail::power_of_two<S>(-exponent);
    normalised *= unit_;
    factors_ = std::make_shared<factors const>(normalised);
    vector_type const diagonal = normalised.diagonal();
    for (index i = 0; i < rows(); ++i) {
      index const row = factors_->original_row(i);
      detail::require_positive_pivot("K", rows(), i, row, factors_->pivots()[i], diagonal[row],
                                     exponent);
    }
  }

  [[nodiscard]] index rows() const { return factors_->lower().rows(); }
  /// What computes: "ldlt".
  [[nodiscard]] std::string_view name() const noexcept { return "ldlt"; }
  /// Entries of L below the diagonal.
  [[nodiscard]] index nonzeros() const { return factors_->lower().nonZeros(); }

  /// Room for the permuted unknowns of a solve; column after column, whichever order b has.
  template <has_scalar<S> X>
  [[nodiscard]] auto workspace(X const& b) const {
    using workspace_type =
        Eigen::Matrix<S, Eigen::Dynamic, local_t<X>::ColsAtCompileTime, Eigen::ColMajor>;
    workspace_type w;
    w.resize(rows(), slant::local(b).cols());
    return w;
  }
  /// x = K⁻¹ b for one or several right-hand sides. w is what workspace(b) made. Throws bad_input
  /// if b or x has not rows() rows.
  void solve(has_scalar<S> auto const& b, auto& x, auto& w) const {
    detail::check_solve(rows(), b, x);
    w.noalias() = factors_->permutation() * slant::local(b);
    auto&& solution = slant::local(x);
    int const* const place = factors_->permutation().indices().data();
    for (index j = 0; j < w.cols(); ++j) {
      S* const v = w.data() + j * w.rows();
      factors_->solve_in_place(v);
      // The unit is applied last: b and 1/D may both be near the end of the exponent range.
      for (index i = 0; i < w.rows(); ++i) solution.coeffRef(i, j) = unit_ * v[place[i]];
    }
  }

 private:
  using vector_type = Eigen::VectorX<S>;

  using factors = detail::sparse_ldlt_factors<S>;

  S unit_{1};
  std::shared_ptr<factors const> factors_;
};

template <class M>
ldlt(Eigen::SparseMatrixBase<M> const&) -> ldlt<typename M::Scalar>;

}  // namespace slant
