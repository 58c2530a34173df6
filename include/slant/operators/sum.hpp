// SPDX-License-Identifier: MIT
//
// A sum T₁ + … + T_n: one flat sequence of terms, which are letters and products. A − B is
// A + (−1) B. The first term writes y, the others add to it (capability apply_add), so a sum costs
// what the hand-written loop costs. Laws: factors.hpp.
#pragma once

#include <slant/operators/product.hpp>

namespace slant::expr {

/// y ← y + α T x. The number of a product goes into α, also where its first factor cannot add.
template <class T, class S, class X, class Y, class W>
void add_term(T const& t, S const& α, X const& x, Y& y, W& w) {
  if constexpr (has_accumulate<T, plain_t<X>>) {
    expr::apply_add_unchecked(t, α, x, y, w);
  } else if constexpr (is_product<T>) {
    t.apply_core(x, w.product, w.inner);
    vectors::axpy(S(α * expr::value_as<S>(t.coefficient())), w.product, y);
  } else {
    expr::apply_unchecked(t, x, w.product, w.inner);
    vectors::axpy(α, w.product, y);
  }
}

template <class... T>
[[nodiscard]] sum<T...> make_sum(hana::tuple<T...> terms);

template <class... T>
class sum : public base_of_node<T...> {
  static constexpr std::make_index_sequence<sizeof...(T) - 1> rest{};
  using first = nth<0, T...>;

 public:
  static constexpr law_set laws = expr::sum_laws<T...>();

  /// The sizes agree. Throws bad_input if a name stands for two objects.
  explicit sum(hana::tuple<T...> terms) : terms_(std::move(terms)) {
    dictionary names;
    enter(names);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      std::array<bool, sizeof...(T)> paired{};
      if constexpr (laws.contains(law::self_adjoint)) (check_partner<I>(paired), ...);
    }(std::index_sequence_for<T...>{});
  }

  [[nodiscard]] hana::tuple<T...> const& terms() const noexcept { return terms_; }
  template <std::size_t I>
  [[nodiscard]] auto const& term() const noexcept {
    return hana::at_c<I>(terms_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& term() noexcept {
    return hana::at_c<I>(terms_);
  }

  [[nodiscard]] index rows() const { return term<0>().rows(); }
  [[nodiscard]] index cols() const { return term<0>().cols(); }

  template <class X>
    requires(linear_operator<T, plain_t<X>> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return hana::make_tuple(slant::workspace(term<0>(), x),
                              slant::detail::accumulate_workspace(term<I + 1>(), x)...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires slant::detail::applies<first, X, Y> && (slant::detail::adds<T, X, Y> && ...)
  void apply(X const& x, Y& y, W& w) const {
    expr::apply_unchecked(term<0>(), x, y, hana::at_c<0>(w));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (expr::add_term(term<I + 1>(), scalar_t<X>(1), x, y, hana::at_c<I + 1>(w)), ...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(slant::detail::accumulates<T, X, Y> && ...)
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (expr::apply_add_unchecked(term<I>(), α, x, y, hana::at_c<I>(w)), ...);
    }(std::index_sequence_for<T...>{});
  }

  template <class X>
    requires(has_adjoint<T, plain_t<X>> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return hana::make_tuple(slant::adjoint_workspace(term<0>(), x),
                              slant::detail::accumulate_workspace<true>(term<I + 1>(), x)...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires slant::detail::applies_adjoint<first, X, Y> &&
             (slant::detail::adds_adjoint<T, X, Y> && ...)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(term<0>(), x, y, hana::at_c<0>(w));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::detail::accumulate<true>(term<I + 1>(), scalar_t<X>(1), x, y, hana::at_c<I + 1>(w)),
       ...);
    }(rest);
  }
  template <class X, class Y, class W>
    requires(slant::detail::accumulates_adjoint<T, X, Y> && ...)
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::apply_adjoint_add(term<I>(), α, x, y, hana::at_c<I>(w)), ...);
    }(std::index_sequence_for<T...>{});
  }

  template <class D>
    requires(has_diagonal<T, plain_t<D>> && ...)
  void diagonal(D& d) const {
    add_up(d, [](auto const& t, auto& part) { t.diagonal(part); });
  }
  template <class Y>
    requires(has_columns<T, plain_t<Y>> && ...)
  void columns(index first_column, Y& y) const {
    add_up(y, [&](auto const& t, auto& part) { t.columns(first_column, part); });
  }

  [[nodiscard]] auto adjoint() const
    requires(expression<T> && ...)
  {
    if constexpr (laws.contains(law::self_adjoint)) {
      return *this;
    } else {
      return expr::make_sum(hana::transform(terms_, [](auto const& t) { return t.adjoint(); }));
    }
  }

  void enter(dictionary& names) const {
    hana::unpack(terms_, [&](auto const&... t) { (expr::enter_part(t, names), ...); });
  }
  void print(std::string& out) const {
    bool next = false;
    auto const print_term = [&]<class U>(U const& t) {
      if (next) {
        if constexpr (requires { t.coefficient(); }) {
          double const c = expr::value_as<double>(t.coefficient());
          out += c < 0 ? " − " : " + ";
          if (std::abs(c) != 1) out += number_text(std::abs(c)) + " ";
          t.print_core(out);
        } else {
          out += " + ";
          expr::print_part(t, out);
        }
      } else {
        expr::print_part(t, out);
      }
      next = true;
    };
    hana::unpack(terms_, [&](auto const&... t) { (print_term(t), ...); });
  }
  static constexpr void spell(ascii& out) {
    bool next = false;
    (((next ? out.add(" + ") : out), next = true, expr::spell_part<T>(out)), ...);
  }

 private:
  /// Pairs term I with a later one of its adjoint's type, of the same letters.
  template <std::size_t I>
  void check_partner(std::array<bool, sizeof...(T)>& paired) const {
    if (partners<T...>()[I] == I || paired[I]) return;
    [&]<std::size_t... J>(std::index_sequence<J...>) {
      auto const fits = [&]<std::size_t K>() {
        if constexpr (K > I && mirrors<nth<I, T...>, nth<K, T...>>) {
          return !paired[K] && (paired[K] = expr::same_letters(term<I>(), term<K>()));
        } else {
          return false;
        }
      };
      expr::require_same_letters((fits.template operator()<J>() || ...));
    }(std::index_sequence_for<T...>{});
  }
  /// y = Σ part(Tᵢ).
  void add_up(auto& y, auto const& part) const {
    auto more = slant::like(y, rows());
    part(term<0>(), y);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((part(term<I + 1>(), more), slant::local(y) += slant::local(more)), ...);
    }(rest);
  }

  hana::tuple<T...> terms_;
};

template <class... T>
sum<T...> make_sum(hana::tuple<T...> terms) {
  return sum<T...>(std::move(terms));
}

template <class A>
[[nodiscard]] auto terms_of(A const& a) {
  if constexpr (is_sum<A>) {
    return a.terms();
  } else {
    return hana::tuple<A>(a);
  }
}

/// A + B + C ….
template <class A, class B, class... C>
[[nodiscard]] auto sum_of(A const& a, B const& b, C const&... c) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) expr::refuse_sizes(a, b, true);
  auto s = expr::make_sum(hana::concat(expr::terms_of(a), expr::terms_of(b)));
  if constexpr (sizeof...(C) > 0) {
    return expr::sum_of(s, c...);
  } else {
    return s;
  }
}

}  // namespace slant::expr

namespace slant {

/// A₁ + A₂ + …, as A₁ + A₂. @throws bad_input if the sizes differ.
template <class A, class... B>
  requires(sizeof...(B) >= 1)
[[nodiscard]] auto sum(A&& a, B&&... b) {
  if constexpr (!(operand<A> && ... && operand<B>)) {
    (detail::check_part_of_formula<A>(), ..., detail::check_part_of_formula<B>());
    return detail::stand_in{};
  } else {
    index i = 1;
    auto const check = [&](auto const& term) {
      ++i;
      if (term.rows() != a.rows() || term.cols() != a.cols()) {
        detail::require_size("A" + std::to_string(i), term, a.rows(), a.cols(), "the size of A1");
      }
    };
    (check(b), ...);
    return expr::sum_of(expr::as_expression(std::forward<A>(a)),
                        expr::as_expression(std::forward<B>(b))...);
  }
}

/// A − B, as A - B. @throws bad_input if the sizes differ.
template <operand A, operand B>
[[nodiscard]] auto difference(A&& a, B&& b) {
  detail::require_size("B", b, a.rows(), a.cols(), "the size of A");
  return expr::sum_of(expr::as_expression(std::forward<A>(a)),
                      expr::negative_of(expr::as_expression(std::forward<B>(b))));
}

}  // namespace slant
