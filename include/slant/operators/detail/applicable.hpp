// SPDX-License-Identifier: MIT
//
// What compositions ask of their parts. The concepts of the vocabulary speak of one vector type;
// here argument and result may differ (an expression in, a segment out), while temporaries, and so
// workspaces, always have the plain type that belongs to the argument.
#pragma once

#include <slant/concepts/capabilities.hpp>

namespace slant::detail {

/// slant::apply(a, x, y, w) works.
template <class A, class X, class Y>
concept applies = requires(A const& a, X const& x, Y& y) {
  a.apply(x, y);
} || requires(A const& a, X const& x, Y& y, workspace_t<A, plain_t<X>>& w) { a.apply(x, y, w); };

/// slant::apply_adjoint(a, x, y, w) works.
template <class A, class X, class Y>
concept applies_adjoint = requires(A const& a, X const& x, Y& y) {
  a.apply_adjoint(x, y);
} || requires(A const& a, X const& x, Y& y, adjoint_workspace_t<A, plain_t<X>>& w) {
  a.apply_adjoint(x, y, w);
} || (is_self_adjoint<A> && applies<A, X, Y>);

/// slant::apply_add(a, α, x, y, w) works.
template <class A, class X, class Y>
concept accumulates = requires(A const& a, scalar_t<X> α, X const& x, Y& y) {
  a.apply_add(α, x, y);
} || requires(A const& a, scalar_t<X> α, X const& x, Y& y, workspace_t<A, plain_t<X>>& w) {
  a.apply_add(α, x, y, w);
};

/// slant::apply_adjoint_add(a, α, x, y, w) works.
template <class A, class X, class Y>
concept accumulates_adjoint = requires(A const& a, scalar_t<X> α, X const& x, Y& y) {
  a.apply_adjoint_add(α, x, y);
} || requires(A const& a, scalar_t<X> α, X const& x, Y& y, adjoint_workspace_t<A, plain_t<X>>& w) {
  a.apply_adjoint_add(α, x, y, w);
} || (is_self_adjoint<A> && !has_adjoint_workspace<A, plain_t<X>> && accumulates<A, X, Y>);

/// detail::accumulate(a, α, x, y, w) works: by apply_add, or through a temporary.
template <class A, class X, class Y>
concept adds = (has_accumulate<A, plain_t<X>> && accumulates<A, X, Y>) ||
               (!has_accumulate<A, plain_t<X>> && applies<A, X, plain_t<X>>);

/// detail::accumulate_adjoint(a, α, x, y, w) works.
template <class A, class X, class Y>
concept adds_adjoint =
    (has_adjoint_accumulate<A, plain_t<X>> && accumulates_adjoint<A, X, Y>) ||
    (!has_adjoint_accumulate<A, plain_t<X>> && applies_adjoint<A, X, plain_t<X>>);

/// A x is a segment of x, and a.segment(x) shows it without a copy. Only of vectors that are
/// nothing but Eigen objects: the local part of another kind knows nothing of its other parts.
template <class A, class X>
concept shows_segment = std::is_same_v<local_t<X>, std::remove_cvref_t<X>> &&
                        requires(A const& a, X const& x) { a.segment(x); };

template <class A> concept knows_its_inverse = requires(A const& a) { a.inverse(); };

/// Columns first, first + 1, … of the identity on n unknowns, as many as y has columns.
template <class Y>
[[nodiscard]] auto unit_columns(Y const& y, index n, index first) {
  auto unit = slant::like(y, n);
  unit.setZero();
  for (index j = 0; j < unit.cols(); ++j) unit(first + j, j) = scalar_t<Y>(1);
  return unit;
}

}  // namespace slant::detail
