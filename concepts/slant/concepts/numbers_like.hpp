// SPDX-License-Identifier: MIT
//
// What a member returns: numbers of the right kind, as many as expected.
//
// Why ask. The members of a set are often templates that take whatever they are given, and Eigen
// converts between scalars of different precision by a constructor: a block that computes in float
// or returns three components instead of two would pass as a block of double precision in the
// plane, and be found out far from where the mistake is, or not at all.
//
// Everything is asked of the structure of a type (Scalar, RowsAtCompileTime, ColsAtCompileTime, as
// Eigen's have them); what a type does not tell is taken for right.
#pragma once

#include <slant/concepts/vector.hpp>

#include <type_traits>

namespace slant {

namespace detail {

/// A number of rows or columns that is not known before the program runs.
inline constexpr index unknown_size = -1;

/// Rows and columns of M as far as its type tells, as Eigen's do.
template <class M>
[[nodiscard]] consteval index rows_of_type() {
  if constexpr (requires { index(M::RowsAtCompileTime); }) {
    return index(M::RowsAtCompileTime) < 0 ? unknown_size : index(M::RowsAtCompileTime);
  } else {
    return unknown_size;
  }
}
template <class M>
[[nodiscard]] consteval index cols_of_type() {
  if constexpr (requires { index(M::ColsAtCompileTime); }) {
    return index(M::ColsAtCompileTime) < 0 ? unknown_size : index(M::ColsAtCompileTime);
  } else {
    return unknown_size;
  }
}

[[nodiscard]] consteval bool may_be_equal(index a, index b) {
  return a == unknown_size || b == unknown_size || a == b;
}

template <class S>
struct numbers {};

/// numbers<S> if X consists of them, X itself if it does not tell.
template <class X>
struct made_of {
  using type = std::remove_cvref_t<X>;
};
template <class X>
  requires requires { typename scalar_t<std::remove_cvref_t<X>>; }
struct made_of<X> {
  using type = numbers<scalar_t<std::remove_cvref_t<X>>>;
};

}  // namespace detail

/// R consists of numbers of the kind that V consists of; where V does not tell, R is V.
template <class R, class V>
concept same_scalar =
    std::is_same_v<typename detail::made_of<R>::type, typename detail::made_of<V>::type>;

/// R has so many rows and columns (unknown_size: any), as far as its type tells.
template <class R, index Rows, index Cols>
concept may_have_size =
    detail::may_be_equal(detail::rows_of_type<local_t<std::remove_cvref_t<R>>>(), Rows) &&
    detail::may_be_equal(detail::cols_of_type<local_t<std::remove_cvref_t<R>>>(), Cols);

/// R is a vector or matrix of such size, of numbers of the kind that V consists of.
template <class R, class V, index Rows, index Cols>
concept numbers_like = same_scalar<R, V> && may_have_size<R, Rows, Cols>;

}  // namespace slant
