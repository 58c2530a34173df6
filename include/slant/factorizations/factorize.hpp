// SPDX-License-Identifier: MIT
//
// The best factorisation there is for a symmetric positive definite matrix: CHOLMOD for sparse
// matrices of doubles where SuiteSparse was found, else Eigen's; `.name()` tells which.
#pragma once

#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/factorizations/ldlt.hpp>
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
#include <slant/factorizations/cholmod.hpp>
#endif

#include <concepts>

namespace slant {

/// Factors a sparse K. Throws bad_input as ldlt does.
template <class M>
[[nodiscard]] auto factorize(Eigen::SparseMatrixBase<M> const& k) {
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
  if constexpr (std::same_as<typename M::Scalar, double>) {
    return cholmod(k);
  } else {
    return ldlt<typename M::Scalar>(k);
  }
#else
  return ldlt<typename M::Scalar>(k);
#endif
}

/// Factors a dense K. Throws bad_input as dense_ldlt does.
template <class M>
[[nodiscard]] auto factorize(Eigen::MatrixBase<M> const& k) {
  return dense_ldlt<typename M::Scalar>(k);
}

}  // namespace slant
