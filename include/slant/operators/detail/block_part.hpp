// SPDX-License-Identifier: MIT
//
// Applying a part of a block operator to its segments of x and y. Parts that accept Eigen segments
// work on them in place. Parts that know only the vector type itself (a distributed vector, say)
// get copies, which live in the workspace.
#pragma once

#include <slant/operators/adjoint.hpp>
#include <slant/operators/detail/accumulate.hpp>
#include <slant/operators/zero.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant::detail {

template <class A>
inline constexpr bool is_zero_operator<adjoint_operator<A>> =
    is_zero_operator<std::remove_cvref_t<A>>;

template <class X>
using segment_t = decltype(slant::local(std::declval<X&>()).middleRows(index{}, index{}));
template <class X>
using const_segment_t =
    decltype(slant::local(std::declval<X const&>()).middleRows(index{}, index{}));

/// Whether a part takes segments of vectors like X.
template <class A, class X>
inline constexpr bool takes_segments =
    adds<A, const_segment_t<plain_t<X>>, segment_t<plain_t<X>>> &&
    applies<A, const_segment_t<plain_t<X>>, segment_t<plain_t<X>>>;

template <class V, class Inner>
struct copied_segments {
  V x;
  V y;
  Inner inner;
};

/// What apply_part<Overwrite> needs for its segment of x.
template <bool Overwrite, class A, class X>
[[nodiscard]] auto part_workspace(A const& a, X const& x) {
  if constexpr (is_zero_operator<A>) {
    return no_workspace{};
  } else if constexpr (takes_segments<A, X>) {
    auto const segment = slant::like(slant::local(x), a.cols());
    if constexpr (Overwrite) {
      return slant::workspace(a, segment);
    } else {
      return accumulate_workspace(a, segment);
    }
  } else {
    auto segment = slant::like(x, a.cols());
    auto inner = slant::workspace(a, segment);
    return copied_segments<plain_t<X>, decltype(inner)>{std::move(segment),
                                                        slant::like(x, a.rows()), std::move(inner)};
  }
}

/// y(row : row + a.rows()) ← [+] α A x(col : col + a.cols()). Overwrites if Overwrite (then α = 1).
template <bool Overwrite, class A, class S, class X, class Y, class W>
void apply_part(A const& a, S const& α, X const& x, index col, Y& y, index row, W& w) {
  if constexpr (is_zero_operator<A>) {
    if constexpr (Overwrite) slant::local(y).middleRows(row, a.rows()).setZero();
  } else {
    auto const from = slant::local(x).middleRows(col, a.cols());
    auto to = slant::local(y).middleRows(row, a.rows());
    if constexpr (takes_segments<A, X>) {
      if constexpr (Overwrite) {
        slant::apply(a, from, to, w);
      } else {
        accumulate(a, α, from, to, w);
      }
    } else {
      slant::local(w.x) = from;
      slant::apply(a, w.x, w.y, w.inner);
      if constexpr (Overwrite) {
        to = slant::local(w.y);
      } else {
        to += α * slant::local(w.y);
      }
    }
  }
}

/// Those of the wanted columns first … first + y.cols() − 1 of the whole that pass through a part,
/// whose own columns start at `col` and rows at `row`.
template <class A, class Y>
void part_columns(A const& a, index col, index row, index first, Y& y) {
  index const begin = std::max(first, col);
  index const end = std::min<index>(first + y.cols(), col + a.cols());
  if (begin >= end || is_zero_operator<A>) return;
  plain_t<Y> own(a.rows(), end - begin);
  a.columns(begin - col, own);
  y.block(row, begin - first, a.rows(), end - begin) = own;
}

/// A part can be applied to its segment of vectors like X.
template <class A, class X>
concept block_part = is_zero_operator<A> || takes_segments<A, X> || linear_operator<A, plain_t<X>>;

/// A part can add to its segment of vectors like X without a temporary.
template <class A, class X>
concept accumulating_block_part =
    is_zero_operator<A> || (takes_segments<A, X> && has_accumulate<A, plain_t<local_t<X>>>);

}  // namespace slant::detail
