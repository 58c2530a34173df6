// SPDX-License-Identifier: MIT
//
// What the factories of compositions do with their arguments: operators pass through, Eigen
// matrices are wrapped, so `congruence(B, inverse(ldlt(K)))` takes a sparse matrix B as it is.
#pragma once

#include <slant/operators/matrix.hpp>

#include <utility>

namespace slant {

/// An operator on vectors of some type: what can be known before the vectors are.
template <class A>
concept unwrapped_operator =
    !eigen_matrix<A> && has_rows<std::remove_cvref_t<A>> && has_cols<std::remove_cvref_t<A>>;

/// What can be a part of a composition: an operator or an Eigen matrix.
template <class A> concept operand = unwrapped_operator<A> || eigen_matrix<A>;

namespace detail {

struct as_operator_fn {
  template <unwrapped_operator A>
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
