// SPDX-License-Identifier: MIT
//
// What compositions of operators share: what they ask of their parts, y ← y + α A x, and which laws
// survive.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/laws.hpp>

#include <cstddef>
#include <initializer_list>
#include <tuple>
#include <utility>

namespace slant::detail {

template <std::size_t I, class... T>
using nth = std::tuple_element_t<I, std::tuple<T...>>;

// --- applicable ----------------------------------------------------------------------------------
//
// What compositions ask of their parts. The concepts of the vocabulary speak of one vector type;
// here argument and result may differ (an expression in, a segment out), while temporaries, and so
// workspaces, always have the plain type that belongs to the argument.

/// A, or its adjoint, can be applied to vectors like X.
template <class X, class A> concept accepted_by = linear_operator<A, plain_t<X>>;
template <class X, class A> concept accepted_by_adjoint_of = has_adjoint<A, plain_t<X>>;

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

/// detail::accumulate(a, α, x, y, w) works: by apply_add, or through a temporary.
template <class A, class X, class Y>
concept adds = (has_accumulate<A, plain_t<X>> && accumulates<A, X, Y>) ||
               (!has_accumulate<A, plain_t<X>> && applies<A, X, plain_t<X>>);

/// detail::accumulate<true>(a, α, x, y, w) works.
template <class A, class X, class Y>
concept adds_adjoint =
    (has_adjoint_accumulate<A, plain_t<X>> && accumulates_adjoint<A, X, Y>) ||
    (!has_adjoint_accumulate<A, plain_t<X>> && applies_adjoint<A, X, plain_t<X>>);

template <class X>
using segment_t = decltype(slant::local(std::declval<X&>()).middleRows(index{}, index{}));
template <class X>
using const_segment_t =
    decltype(slant::local(std::declval<X const&>()).middleRows(index{}, index{}));

/// Whether a part takes segments of vectors like X, not only X itself.
template <class A, class X>
inline constexpr bool takes_segments =
    adds<A, const_segment_t<plain_t<X>>, segment_t<plain_t<X>>> &&
    applies<A, const_segment_t<plain_t<X>>, segment_t<plain_t<X>>>;

/// A x is a segment of x, and a.segment(x) shows it without a copy. Only of vectors that are
/// nothing but Eigen objects: the local part of another kind knows nothing of its other parts.
template <class A, class X>
concept shows_segment = std::is_same_v<local_t<X>, std::remove_cvref_t<X>> &&
                        requires(A const& a, X const& x) { a.segment(x); };

/// inverse() is an operator: that of K⁻¹ with a name for the factors of K is the name, and none.
template <class A> concept knows_its_inverse = requires(A const& a) { a.inverse().cols(); };

/// Columns first, first + 1, … of the identity on n unknowns, as many as y has columns.
template <class Y>
[[nodiscard]] auto unit_columns(Y const& y, index n, index first) {
  auto unit = slant::like(y, n);
  unit.setZero();
  for (index j = 0; j < unit.cols(); ++j) unit(first + j, j) = scalar_t<Y>(1);
  return unit;
}

// What is the same for A and for Aᵀ is written once.

template <bool Adjoint, class A, class X>
[[nodiscard]] auto oriented_workspace(A const& a, X const& x) {
  if constexpr (Adjoint) {
    return slant::adjoint_workspace(a, x);
  } else {
    return slant::workspace(a, x);
  }
}
template <bool Adjoint, class A, class X, class Y, class W>
void apply_oriented(A const& a, X const& x, Y& y, W& w) {
  if constexpr (Adjoint) {
    slant::apply_adjoint(a, x, y, w);
  } else {
    slant::apply(a, x, y, w);
  }
}
template <bool Adjoint, class A, class S, class X, class Y, class W>
void apply_add_oriented(A const& a, S const& α, X const& x, Y& y, W& w) {
  if constexpr (Adjoint) {
    slant::apply_adjoint_add(a, α, x, y, w);
  } else {
    slant::apply_add(a, α, x, y, w);
  }
}

// --- accumulate ----------------------------------------------------------------------------------
//
// y ← y + α A x for every operator: by its own apply_add where it has one, else through a
// temporary that belongs to the workspace. The choice is made by the compiler.

template <bool Adjoint, class A, class V>
inline constexpr bool can_add = Adjoint ? has_adjoint_accumulate<A, V> : has_accumulate<A, V>;

template <class Inner, class Product>
struct buffered_workspace {
  Inner inner;
  Product product;
};

/// What accumulate<Adjoint>(a, α, x, y, ·) needs. For operators that can add it is their own
/// workspace.
template <bool Adjoint = false, class A, class X>
[[nodiscard]] auto accumulate_workspace(A const& a, X const& x) {
  auto inner = oriented_workspace<Adjoint>(a, x);
  if constexpr (can_add<Adjoint, A, plain_t<X>>) {
    return inner;
  } else {
    return buffered_workspace<decltype(inner), plain_t<X>>{
        std::move(inner), slant::like(x, Adjoint ? a.cols() : a.rows())};
  }
}

/// y ← y + α A x, or y + α Aᵀx.
template <bool Adjoint = false, class A, class S, class X, class Y, class W>
void accumulate(A const& a, S const& α, X const& x, Y& y, W& w) {
  if constexpr (can_add<Adjoint, A, plain_t<X>>) {
    apply_add_oriented<Adjoint>(a, α, x, y, w);
  } else {
    apply_oriented<Adjoint>(a, x, w.product, w.inner);
    vectors::axpy(α, w.product, y);
  }
}

// --- closure -------------------------------------------------------------------------------------
//
// Which laws survive which composition. Each function states the closure of one composition and
// nothing more; the operators call it on the laws of their parts.

/// A₁ + A₂ + …: self-adjoint if all are; semidefinite if all are, and then definite if one is.
[[nodiscard]] constexpr law_set sum_laws(std::initializer_list<law_set> terms) {
  bool definite = false;
  law_set common = slant::laws<law::self_adjoint, law::positive_semidefinite>;
  for (law_set const& term : terms) {
    definite = definite || term.contains(law::positive_definite);
    common = common & term;
  }
  definite = definite && common.contains(law::positive_semidefinite);
  return common | slant::laws<law::positive_definite>.when(definite);
}

/// c A: self-adjoint if A is; (semi)definite if A is and c > 0.
[[nodiscard]] constexpr law_set scaled_laws(law_set a, bool positive_factor) {
  return (a & slant::laws<law::self_adjoint>) |
         (a & slant::laws<law::positive_semidefinite, law::positive_definite>)
             .when(positive_factor);
}

/// A⁻¹: self-adjoint if A is; definite if A is, since ⟨A⁻¹y, y⟩ = ⟨x, Ax⟩ for y = Ax.
[[nodiscard]] constexpr law_set inverse_laws(law_set a) {
  return a & slant::laws<law::self_adjoint, law::positive_semidefinite, law::positive_definite>;
}

/// B A Bᵀ: self-adjoint and semidefinite if A is; definite if A is and the rows of B are
/// independent.
[[nodiscard]] constexpr law_set congruence_laws(law_set a, bool full_row_rank) {
  return (a & slant::laws<law::self_adjoint, law::positive_semidefinite>) |
         (a & slant::laws<law::positive_definite>).when(full_row_rank);
}

/// diag(A₁, A₂, …): every law that all blocks have holds for the whole.
[[nodiscard]] constexpr law_set block_diagonal_laws(std::initializer_list<law_set> blocks) {
  law_set common = slant::laws<law::self_adjoint, law::positive_definite, law::projector,
                               law::firmly_nonexpansive>;
  for (law_set const& block : blocks) common = common & block;
  return common;
}

}  // namespace slant::detail
