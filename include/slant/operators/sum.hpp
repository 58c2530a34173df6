// SPDX-License-Identifier: MIT
//
// The sum of two or more operators of the same size. The first term writes y, the others add to it
// (capability apply_add), so a sum costs what the hand-written loop costs.
//
// Closure: self-adjoint if all terms are, semidefinite if all are, definite if in addition one is.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

namespace slant {

/// y = A₁x + A₂x + …. Each A is `Operator const&` (referenced) or an operator type (owned).
template <class... A>
class sum_operator {
  static_assert(sizeof...(A) >= 1);
  static constexpr std::make_index_sequence<sizeof...(A) - 1> rest{};
  using first_term = std::remove_cvref_t<std::tuple_element_t<0, std::tuple<A...>>>;

 public:
  static constexpr law_set laws = detail::sum_laws({laws_of<A>...});

  /// All terms have the same size; slant::sum checks it.
  explicit sum_operator(held<A>... terms) : terms_(std::move(terms)...) {}

  [[nodiscard]] index rows() const { return term<0>().rows(); }
  [[nodiscard]] index cols() const { return term<0>().cols(); }

  /// f(term) for each term in turn.
  template <class F>
  void for_each(F f) const {
    std::apply([&](auto const&... kept) { (f(kept.get()), ...); }, terms_);
  }

  template <class X>
    requires(linear_operator<std::remove_cvref_t<A>, plain_t<X>> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::make_tuple(slant::workspace(term<0>(), x),
                             detail::accumulate_workspace(term<I + 1>(), x)...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(detail::applies<first_term, X, Y> &&
             (detail::adds<std::remove_cvref_t<A>, X, Y> && ...))
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(term<0>(), x, y, std::get<0>(w));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (detail::accumulate(term<I + 1>(), scalar_t<X>(1), x, y, std::get<I + 1>(w)), ...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(detail::accumulates<std::remove_cvref_t<A>, X, Y> && ...)
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::apply_add(term<I>(), α, x, y, std::get<I>(w)), ...);
    }(std::index_sequence_for<A...>{});
  }

  template <class X>
    requires(has_adjoint<std::remove_cvref_t<A>, plain_t<X>> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::make_tuple(slant::adjoint_workspace(term<0>(), x),
                             detail::accumulate_adjoint_workspace(term<I + 1>(), x)...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(detail::applies_adjoint<first_term, X, Y> &&
             (detail::adds_adjoint<std::remove_cvref_t<A>, X, Y> && ...))
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(term<0>(), x, y, std::get<0>(w));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (detail::accumulate_adjoint(term<I + 1>(), scalar_t<X>(1), x, y, std::get<I + 1>(w)), ...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(detail::accumulates_adjoint<std::remove_cvref_t<A>, X, Y> && ...)
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::apply_adjoint_add(term<I>(), α, x, y, std::get<I>(w)), ...);
    }(std::index_sequence_for<A...>{});
  }

  template <class D>
    requires(has_diagonal<std::remove_cvref_t<A>, plain_t<D>> && ...)
  void diagonal(D& d) const {
    auto more = slant::like(d, rows());
    term<0>().diagonal(d);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((term<I + 1>().diagonal(more), slant::local(d) += slant::local(more)), ...);
    }(rest);
  }
  template <class Y>
    requires(has_columns<std::remove_cvref_t<A>, plain_t<Y>> && ...)
  void columns(index first, Y& y) const {
    auto more = slant::like(y, rows());
    term<0>().columns(first, y);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((term<I + 1>().columns(first, more), slant::local(y) += slant::local(more)), ...);
    }(rest);
  }

 private:
  template <std::size_t I>
  [[nodiscard]] auto const& term() const noexcept {
    return std::get<I>(terms_).get();
  }

  std::tuple<held<A>...> terms_;
};

namespace detail {

/// One complaint per term that is no operator; a fold over the terms would only say that one is
/// not.
template <class Term>
void check_term() {
  static_assert(operand<Term>, "a term of a sum must be an operator or an Eigen matrix");
}

}  // namespace detail

/// A₁ + A₂ + …. Throws bad_input if the sizes differ.
template <class... A>
  requires(sizeof...(A) >= 2)
[[nodiscard]] auto sum(A&&... a) {
  if constexpr (!(operand<A> && ...)) {
    (detail::check_term<A>(), ...);
    return detail::stand_in{};
  } else {
    sum_operator<part_t<A>...> s{held<part_t<A>>(slant::as_operator(std::forward<A>(a)))...};
    index i = 0;
    s.for_each([&](auto const& term) {
      detail::require_size(std::string("A").append(std::to_string(++i)), term, s.rows(), s.cols(),
                           "the size of A1");
    });
    return s;
  }
}

// --- difference ----------------------------------------------------------------------------------
//
// The difference of two operators of the same size. Closure: self-adjoint if both are; nothing is
// known about definiteness.

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
