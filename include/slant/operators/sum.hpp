// SPDX-License-Identifier: MIT
//
// The sum of two or more operators of the same size. The first term writes y, the others add to it
// (capability apply_add), so a sum costs what the hand-written loop costs.
//
// Closure: self-adjoint if all terms are, semidefinite if all are, definite if in addition one is.
#pragma once

#include <slant/operators/as_operator.hpp>
#include <slant/operators/detail/accumulate.hpp>
#include <slant/operators/detail/closure.hpp>
#include <slant/operators/detail/refused_operator.hpp>

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
    return detail::refused_operator{};
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

}  // namespace slant
