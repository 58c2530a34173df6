// SPDX-License-Identifier: MIT
//
// The inverse after a change of low rank (Woodbury 1950; Golub, Van Loan, Matrix Computations, §2.1.4),
//
//     (K + U C Uᵀ)⁻¹ = K⁻¹ − V S⁻¹ Vᵀ,     V = K⁻¹U,   S = C⁻¹ + UᵀV.
//
// K and C symmetric positive definite, U with p columns: p solutions with K once, then one for each
// application. Where U C Uᵀ outweighs K by a factor 1/ε on range(U), the difference keeps no digits
// there: K + U C Uᵀ itself should be factored then.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <Eigen/Core>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// (K + U C Uᵀ)⁻¹ from K⁻¹, an spd_operator, which is referenced if it is an lvalue; U is n × p and C
/// p × p, dense. The result is an spd_operator.
/// @throws bad_input if sizes do not fit, an entry is not finite, or C or S is not symmetric positive
/// definite.
template <operand K, class U, class C>
  requires declares_self_adjoint<K> && declares_positive_definite<K>
[[nodiscard]] auto woodbury(K&& k_inverse, Eigen::MatrixBase<U> const& u,
                            Eigen::MatrixBase<C> const& c) {
  using dense = Eigen::MatrixX<typename U::Scalar>;
  detail::require_rows("U", u, k_inverse.rows(), "the size of K");
  detail::require_size("C", c, u.cols(), u.cols(), "the columns of U");
  detail::require_finite_entries("U", u.derived());
  detail::require_finite_entries("C", c.derived());
  dense const columns = u;
  dense v(columns.rows(), columns.cols());
  for (index j = 0; j < columns.cols(); ++j) {
    Eigen::VectorX<typename U::Scalar> const column = columns.col(j);
    auto image = column;
    slant::apply(k_inverse, column, image);
    v.col(j) = image;
  }
  auto const factored = [](std::string const& name, dense const& m) {
    try {
      return dense_ldlt(m);
    } catch (bad_input const& complaint) {
      throw bad_input(name, "a matrix with the complaint (" + std::string(complaint.what()) + ")",
                      "a symmetric positive definite matrix");
    }
  };
  dense s(c.rows(), c.cols());
  factored("C", c).solve(dense(dense::Identity(c.rows(), c.cols())), s);
  dense const projected = columns.transpose() * v;
  s += (projected + projected.transpose()) / 2;
  auto factors = factored("K + U C Uᵀ", (s + s.transpose()) / 2);
  return declare<self_adjoint, positive_definite>(
      difference(std::forward<K>(k_inverse),
                 congruence(matrix(std::move(v)), slant::inverse(std::move(factors)))));
}

namespace expr {

template <class A>
inline constexpr bool is_dense_letter = false;
template <auto Name, class M, law_set L, unsigned Flags>
inline constexpr bool is_dense_letter<letter<Name, matrix_operator<M, L>, Flags>> =
    (Flags & adjointed) == 0 &&
    std::is_base_of_v<Eigen::MatrixBase<std::remove_cvref_t<M>>, std::remove_cvref_t<M>>;

}  // namespace expr

/// (K + U C Uᵀ)⁻¹ as woodbury(K⁻¹, U, C), where K is a letter that knows its inverse, such as a
/// diagonal, and U and C are letters of dense matrices, U with a name.
/// @throws bad_input as woodbury does.
template <class K, class U, class C, class Adjoint>
  requires detail::knows_its_inverse<K> && expr::is_letter<K> && expr::is_dense_letter<U> &&
           expr::is_dense_letter<C> && (expr::mirrored_pairs<U, C, Adjoint>() == 1)
[[nodiscard]] auto inverse(expr::sum<K, expr::product<expr::one, U, C, Adjoint>> const& a) {
  auto const& change = a.template term<1>();
  return slant::woodbury(a.template term<0>().inverse(), change.template factor<0>().get().get(),
                         change.template factor<1>().get().get());
}

}  // namespace slant
