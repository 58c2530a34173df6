// SPDX-License-Identifier: MIT
//
// What the factories of compositions do with their arguments: operators pass through, Eigen
// matrices are wrapped, so `congruence(B, inverse(ldlt(K)))` takes a sparse matrix B as it is.
#pragma once

#include <slant/concepts/member_names.hpp>
#include <slant/operators/matrix.hpp>

#include <utility>

namespace slant {

/// What can be a part of a composition: an Eigen matrix, or an operator as far as can be known
/// before the vectors are.
template <class A>
concept operand = has_rows<std::remove_cvref_t<A>> && has_cols<std::remove_cvref_t<A>> &&
                  (eigen_matrix<A> || has_apply_member<std::remove_cvref_t<A>>);

/// The same with an adjoint, so that Aᵀ can be a part.
template <class A>
concept adjoint_operand =
    operand<A> && (eigen_matrix<A> || has_apply_adjoint_member<std::remove_cvref_t<A>> ||
                   declares_self_adjoint<std::remove_cvref_t<A>>);

namespace detail {

struct as_operator_fn {
  template <operand A>
    requires(!eigen_matrix<A>)
  [[nodiscard]] constexpr A&& operator()(A&& a) const noexcept {
    return std::forward<A>(a);
  }
  template <eigen_matrix M>
  [[nodiscard]] auto operator()(M&& m) const {
    return slant::matrix(std::forward<M>(m));
  }
};

}  // namespace detail

/// The argument as an operator: itself, or slant::matrix(argument) for an Eigen matrix.
inline constexpr detail::as_operator_fn as_operator{};

/// How an argument of deduced type A is kept as a part: `Operator const&` or an operator type.
template <operand A>
using part_t = kept_t<decltype(slant::as_operator(std::declval<A>()))>;

}  // namespace slant
