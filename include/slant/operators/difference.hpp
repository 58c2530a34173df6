// SPDX-License-Identifier: MIT
//
// The difference of two operators of the same size. Closure: self-adjoint if both are; nothing is
// known about definiteness.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/as_operator.hpp>
#include <slant/operators/detail/accumulate.hpp>
#include <slant/operators/detail/closure.hpp>

#include <utility>

namespace slant {

/// y = A x − B x. A and B are `Operator const&` (referenced) or operator types (owned).
template <class A, class B>
class difference_operator {
  using left = std::remove_cvref_t<A>;
  using right = std::remove_cvref_t<B>;

  template <class First, class Second>
  struct workspace_type {
    First a;
    Second b;
  };

 public:
  static constexpr law_set laws = detail::difference_laws(laws_of<A>, laws_of<B>);

  /// The sizes agree; slant::difference checks it.
  difference_operator(held<A> a, held<B> b) : a_(std::move(a)), b_(std::move(b)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }

  template <class X>
    requires linear_operator<left, plain_t<X>> && linear_operator<right, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace(slant::workspace(a_.get(), x), detail::accumulate_workspace(b_.get(), x));
  }
  template <class X, class Y, class W>
    requires detail::applies<left, X, Y> && detail::adds<right, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(a_.get(), x, y, w.a);
    detail::accumulate(b_.get(), scalar_t<X>(-1), x, y, w.b);
  }
  template <class X, class Y, class W>
    requires detail::accumulates<left, X, Y> && detail::accumulates<right, X, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_add(a_.get(), α, x, y, w.a);
    slant::apply_add(b_.get(), scalar_t<X>(-α), x, y, w.b);
  }

  template <class X>
    requires has_adjoint<left, plain_t<X>> && has_adjoint<right, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace(slant::adjoint_workspace(a_.get(), x),
                          detail::accumulate_adjoint_workspace(b_.get(), x));
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<left, X, Y> && detail::adds_adjoint<right, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(a_.get(), x, y, w.a);
    detail::accumulate_adjoint(b_.get(), scalar_t<X>(-1), x, y, w.b);
  }
  template <class X, class Y, class W>
    requires detail::accumulates_adjoint<left, X, Y> && detail::accumulates_adjoint<right, X, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint_add(a_.get(), α, x, y, w.a);
    slant::apply_adjoint_add(b_.get(), scalar_t<X>(-α), x, y, w.b);
  }

  template <class D>
    requires has_diagonal<left, plain_t<D>> && has_diagonal<right, plain_t<D>>
  void diagonal(D& d) const {
    auto subtrahend = slant::like(d, rows());
    a_.get().diagonal(d);
    b_.get().diagonal(subtrahend);
    vectors::subtract(subtrahend, d);
  }
  template <class Y>
    requires has_columns<left, plain_t<Y>> && has_columns<right, plain_t<Y>>
  void columns(index first, Y& y) const {
    auto subtrahend = slant::like(y, rows());
    a_.get().columns(first, y);
    b_.get().columns(first, subtrahend);
    vectors::subtract(subtrahend, y);
  }

 private:
  template <class First, class Second>
  [[nodiscard]] static workspace_type<First, Second> make_workspace(First a, Second b) {
    return {std::move(a), std::move(b)};
  }

  held<A> a_;
  held<B> b_;
};

/// A − B. Throws bad_input if the sizes differ.
template <operand A, operand B>
[[nodiscard]] auto difference(A&& a, B&& b) {
  held<part_t<A>> first{slant::as_operator(std::forward<A>(a))};
  held<part_t<B>> second{slant::as_operator(std::forward<B>(b))};
  detail::require_size("B", second.get(), first.get().rows(), first.get().cols(), "the size of A");
  return difference_operator<part_t<A>, part_t<B>>{std::move(first), std::move(second)};
}

}  // namespace slant
