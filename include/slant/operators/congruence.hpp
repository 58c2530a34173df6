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
#include <slant/operators/matrix.hpp>

#include <utility>

namespace slant {

/// An operator or matrix whose rows the caller asserts to be linearly independent.
template <class B>
struct full_row_rank_assertion {
  held<B> part;
};

/// Asserts that the rows of B are linearly independent.
template <adjoint_operand B>
[[nodiscard]] full_row_rank_assertion<part_t<B>> full_row_rank(B&& b) {
  held<part_t<B>> kept{slant::as_operator(std::forward<B>(b))};
  if (kept.get().rows() > kept.get().cols()) {
    throw bad_input("B", detail::size_text(kept.get().rows(), kept.get().cols()),
                    "at most as many rows as columns (independent rows)");
  }
  return {std::move(kept)};
}

/// y = B A Bᵀ x. B and A are `Operator const&` (referenced) or operator types (owned).
template <class B, class A, bool FullRowRank>
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
  static constexpr law_set laws = detail::congruence_laws(laws_of<A>, FullRowRank);

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

namespace detail {

template <bool FullRowRank, class B, class A>
[[nodiscard]] auto make_congruence(held<B> b, held<A> a) {
  require_square("A", a.get());
  require_cols("B", b.get(), a.get().rows(), "the size of A");
  return congruence_operator<B, A, FullRowRank>{std::move(b), std::move(a)};
}

}  // namespace detail

/// B A Bᵀ. Throws bad_input unless A is square with as many rows as B has columns.
template <operand B, operand A>
[[nodiscard]] auto congruence(B&& b, A&& a) {
  if constexpr (!adjoint_operand<B>) {
    static_assert(adjoint_operand<B>, "congruence: B must have apply_adjoint(x, y)");
    return detail::stand_in{};
  } else {
    return detail::make_congruence<false>(held<part_t<B>>(slant::as_operator(std::forward<B>(b))),
                                          held<part_t<A>>(slant::as_operator(std::forward<A>(a))));
  }
}

/// B A Bᵀ with independent rows of B: definite if A is.
template <class B, operand A>
[[nodiscard]] auto congruence(full_row_rank_assertion<B> b, A&& a) {
  return detail::make_congruence<true>(std::move(b.part),
                                       held<part_t<A>>(slant::as_operator(std::forward<A>(a))));
}

}  // namespace slant
