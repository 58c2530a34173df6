// SPDX-License-Identifier: MIT
//
// The congruence B A Bᵀ, never formed: the dual operator of contact problems is
// congruence(B, inverse(ldlt(K))), [K (18)].
//
// Closure: self-adjoint and semidefinite if A is. Definite if A is and B has independent rows,
// which only the caller can know: `congruence(full_row_rank(B), A)`.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/matrix.hpp>

#include <utility>

namespace slant {

/// y = B A Bᵀ x. B and A are `Operator const&` (referenced) or operator types (owned).
template <class B, class A>
class congruence_operator {
  using outer = std::remove_cvref_t<B>;
  using inner = std::remove_cvref_t<A>;

  template <class T, class Adjoint, class Inner, class Outer>
  struct workspace_type {
    T before;  ///< Bᵀ x
    T after;   ///< A Bᵀ x
    Adjoint adjoint;
    Inner inner;
    Outer outer;
  };

 public:
  static constexpr law_set laws = detail::congruence_laws(laws_of<A>, declares_full_row_rank<B>);

  /// The sizes fit; slant::congruence checks it.
  congruence_operator(held<B> b, held<A> a) : b_(std::move(b)), a_(std::move(a)) {}

  [[nodiscard]] index rows() const { return b_.get().rows(); }
  [[nodiscard]] index cols() const { return b_.get().rows(); }

  template <class X>
    requires has_adjoint<outer, plain_t<X>> && linear_operator<inner, plain_t<X>> &&
             linear_operator<outer, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace(
        x, [this](auto const& before) { return slant::workspace(a_.get(), before); });
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<outer, X, plain_t<X>> && linear_operator<inner, plain_t<X>> &&
             detail::applies<outer, plain_t<X>, Y>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(b_.get(), x, w.before, w.adjoint);
    slant::apply(a_.get(), w.before, w.after, w.inner);
    slant::apply(b_.get(), w.after, y, w.outer);
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<outer, X, plain_t<X>> && linear_operator<inner, plain_t<X>> &&
             detail::accumulates<outer, plain_t<X>, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint(b_.get(), x, w.before, w.adjoint);
    slant::apply(a_.get(), w.before, w.after, w.inner);
    slant::apply_add(b_.get(), α, w.after, y, w.outer);
  }

  template <class X>
    requires has_adjoint<outer, plain_t<X>> && has_adjoint<inner, plain_t<X>> &&
             linear_operator<outer, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace(
        x, [this](auto const& before) { return slant::adjoint_workspace(a_.get(), before); });
  }
  /// y = B Aᵀ Bᵀ x.
  template <class X, class Y, class W>
    requires detail::applies_adjoint<outer, X, plain_t<X>> && has_adjoint<inner, plain_t<X>> &&
             detail::applies<outer, plain_t<X>, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(b_.get(), x, w.before, w.adjoint);
    slant::apply_adjoint(a_.get(), w.before, w.after, w.inner);
    slant::apply(b_.get(), w.after, y, w.outer);
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<outer, X, plain_t<X>> && has_adjoint<inner, plain_t<X>> &&
             detail::accumulates<outer, plain_t<X>, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint(b_.get(), x, w.before, w.adjoint);
    slant::apply_adjoint(a_.get(), w.before, w.after, w.inner);
    slant::apply_add(b_.get(), α, w.after, y, w.outer);
  }

 private:
  template <class X, class F>
  [[nodiscard]] auto make_workspace(X const& x, F inner_workspace) const {
    auto before = slant::like(x, b_.get().cols());
    auto after = slant::like(x, b_.get().cols());
    auto adjoint = slant::adjoint_workspace(b_.get(), x);
    auto middle = inner_workspace(before);
    auto last = slant::workspace(b_.get(), after);
    return workspace_type<decltype(before), decltype(adjoint), decltype(middle), decltype(last)>{
        std::move(before), std::move(after), std::move(adjoint), std::move(middle),
        std::move(last)};
  }

  held<B> b_;
  held<A> a_;
};

/// B A Bᵀ, definite if A is and B declares full_row_rank. Throws bad_input unless A is square with as
/// many rows as B has columns.
template <operand B, operand A>
[[nodiscard]] auto congruence(B&& b, A&& a) {
  if constexpr (!adjoint_operand<B>) {
    static_assert(adjoint_operand<B>, "congruence: B must have apply_adjoint(x, y)");
    return detail::stand_in{};
  } else {
    held<part_t<B>> outer{slant::as_operator(std::forward<B>(b))};
    held<part_t<A>> inner{slant::as_operator(std::forward<A>(a))};
    detail::require_square("A", inner.get());
    detail::require_cols("B", outer.get(), inner.get().rows(), "the size of A");
    return congruence_operator<part_t<B>, part_t<A>>{std::move(outer), std::move(inner)};
  }
}

}  // namespace slant
