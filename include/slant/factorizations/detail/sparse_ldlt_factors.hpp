// SPDX-License-Identifier: MIT
//
// Eigen's sparse LDLᵀ without pivoting, for symmetric matrices, and a solve that allocates nothing.
// Definiteness is for those who use it to look at: the pivots have the signs of the eigenvalues.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace slant::detail {

/// P K Pᵀ = L D Lᵀ of the lower triangle of K. With the parts that Eigen gives away only as copies
/// (D) or protects.
template <class S>
class sparse_ldlt_factors : public Eigen::SimplicialLDLT<Eigen::SparseMatrix<S>, Eigen::Lower> {
 public:
  using matrix_type = Eigen::SparseMatrix<S>;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

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
