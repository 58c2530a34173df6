// SPDX-License-Identifier: MIT
//
// y ← y + α A x for every operator: by its own apply_add where it has one, else through a
// temporary that belongs to the workspace. The choice is made by the compiler.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/detail/applicable.hpp>

#include <utility>

namespace slant::detail {

template <class Inner, class Product>
struct buffered_workspace {
  Inner inner;
  Product product;
};

/// What accumulate(a, α, x, y, ·) needs. For operators with apply_add it is their own workspace.
template <class A, class X>
[[nodiscard]] auto accumulate_workspace(A const& a, X const& x) {
  if constexpr (has_accumulate<A, plain_t<X>>) {
    return slant::workspace(a, x);
  } else {
    return buffered_workspace<decltype(slant::workspace(a, x)), plain_t<X>>{
        slant::workspace(a, x), slant::like(x, a.rows())};
  }
}

template <class A, class S, class X, class Y, class W>
void accumulate(A const& a, S const& α, X const& x, Y& y, W& w) {
  if constexpr (has_accumulate<A, plain_t<X>>) {
    slant::apply_add(a, α, x, y, w);
  } else {
    slant::apply(a, x, w.product, w.inner);
    vectors::axpy(α, w.product, y);
  }
}

/// What accumulate_adjoint(a, α, x, y, ·) needs.
template <class A, class X>
[[nodiscard]] auto accumulate_adjoint_workspace(A const& a, X const& x) {
  if constexpr (has_adjoint_accumulate<A, plain_t<X>>) {
    return slant::adjoint_workspace(a, x);
  } else {
    return buffered_workspace<decltype(slant::adjoint_workspace(a, x)), plain_t<X>>{
        slant::adjoint_workspace(a, x), slant::like(x, a.cols())};
  }
}

/// y ← y + α Aᵀx.
template <class A, class S, class X, class Y, class W>
void accumulate_adjoint(A const& a, S const& α, X const& x, Y& y, W& w) {
  if constexpr (has_adjoint_accumulate<A, plain_t<X>>) {
    slant::apply_adjoint_add(a, α, x, y, w);
  } else {
    slant::apply_adjoint(a, x, w.product, w.inner);
    vectors::axpy(α, w.product, y);
  }
}

}  // namespace slant::detail
