// SPDX-License-Identifier: MIT
//
// The product of operators, y = A (B x). Closure: none. The product of two self-adjoint operators
// is not self-adjoint; for B A Bᵀ use congruence(B, A), which knows more.
#pragma once

#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <utility>

namespace slant::detail {

// --- chain ---------------------------------------------------------------------------------------
//
// Workspace of two operators applied one after the other.

template <class Inner, class Between, class Outer>
struct chain_workspace {
  Inner inner;      ///< of the operator applied first
  Between between;  ///< its result
  Outer outer;      ///< of the operator applied second
};
template <class Inner, class Between, class Outer>
chain_workspace(Inner, Between, Outer) -> chain_workspace<Inner, Between, Outer>;

}  // namespace slant::detail

namespace slant {

// --- product -------------------------------------------------------------------------------------

/// y = A B x. A and B are `Operator const&` (referenced) or operator types (owned).
template <class A, class B>
class product_operator {
  using left = std::remove_cvref_t<A>;
  using right = std::remove_cvref_t<B>;

  /// B x is handed on as a view of x.
  template <class X>
  static constexpr bool no_copy = detail::shows_segment<right, X>;

 public:
  static constexpr law_set laws{};

  /// A has as many columns as B has rows; slant::product checks it.
  product_operator(held<A> a, held<B> b) : a_(std::move(a)), b_(std::move(b)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return b_.get().cols(); }

  template <class X>
    requires linear_operator<left, plain_t<X>> && linear_operator<right, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    auto between = slant::like(x, b_.get().rows());
    auto outer = slant::workspace(a_.get(), between);
    return detail::chain_workspace{slant::workspace(b_.get(), x), std::move(between),
                                   std::move(outer)};
  }
  template <class X, class Y, class W>
    requires detail::applies<right, X, plain_t<X>> && detail::applies<left, plain_t<X>, Y>
  void apply(X const& x, Y& y, W& w) const {
    if constexpr (no_copy<X>) {
      auto const segment = b_.get().segment(x);
      slant::apply(a_.get(), segment, y, w.outer);
    } else {
      slant::apply(b_.get(), x, w.between, w.inner);
      slant::apply(a_.get(), w.between, y, w.outer);
    }
  }
  template <class X, class Y, class W>
    requires detail::applies<right, X, plain_t<X>> && detail::accumulates<left, plain_t<X>, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    if constexpr (no_copy<X>) {
      auto const segment = b_.get().segment(x);
      slant::apply_add(a_.get(), α, segment, y, w.outer);
    } else {
      slant::apply(b_.get(), x, w.between, w.inner);
      slant::apply_add(a_.get(), α, w.between, y, w.outer);
    }
  }

  template <class X>
    requires has_adjoint<left, plain_t<X>> && has_adjoint<right, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    auto between = slant::like(x, a_.get().cols());
    auto outer = slant::adjoint_workspace(b_.get(), between);
    return detail::chain_workspace{slant::adjoint_workspace(a_.get(), x), std::move(between),
                                   std::move(outer)};
  }
  /// y = Bᵀ Aᵀ x.
  template <class X, class Y, class W>
    requires detail::applies_adjoint<left, X, plain_t<X>> &&
             detail::applies_adjoint<right, plain_t<X>, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(a_.get(), x, w.between, w.inner);
    slant::apply_adjoint(b_.get(), w.between, y, w.outer);
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<left, X, plain_t<X>> &&
             detail::accumulates_adjoint<right, plain_t<X>, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint(a_.get(), x, w.between, w.inner);
    slant::apply_adjoint_add(b_.get(), α, w.between, y, w.outer);
  }

  template <class Y>
    requires applies_to_many<left, plain_t<Y>> && has_columns<right, plain_t<Y>>
  void columns(index first, Y& y) const {
    auto between = slant::like(y, b_.get().rows());
    b_.get().columns(first, between);
    slant::apply(a_.get(), between, y);
  }
  /// B⁻¹ A⁻¹, where both parts have an inverse.
  [[nodiscard]] auto inverse() const
    requires detail::knows_its_inverse<left> && detail::knows_its_inverse<right>
  {
    using outer = std::remove_cvref_t<decltype(b_.get().inverse())>;
    using inner = std::remove_cvref_t<decltype(a_.get().inverse())>;
    return product_operator<outer, inner>{held<outer>(b_.get().inverse()),
                                          held<inner>(a_.get().inverse())};
  }

 private:
  held<A> a_;
  held<B> b_;
};

/// A B, or A (B (C …)). Throws bad_input if A has not as many columns as B has rows.
template <operand A, operand B, class... C>
[[nodiscard]] auto product(A&& a, B&& b, C&&... c) {
  if constexpr (sizeof...(C) > 0) {
    return slant::product(std::forward<A>(a),
                          slant::product(std::forward<B>(b), std::forward<C>(c)...));
  } else {
    held<part_t<A>> left{slant::as_operator(std::forward<A>(a))};
    held<part_t<B>> right{slant::as_operator(std::forward<B>(b))};
    detail::require_rows("B", right.get(), left.get().cols(), "the columns of A");
    return product_operator<part_t<A>, part_t<B>>{std::move(left), std::move(right)};
  }
}

}  // namespace slant
