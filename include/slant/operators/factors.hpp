// SPDX-License-Identifier: MIT
//
// What the laws of products and sums depend on besides those of their parts: the number in front
// with its sign, and which factors are each other's adjoint.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/text.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- number --------------------------------------------------------------------------------------
//
// The number in front of a product. Its sign is part of the type, its value is not:
//
//     2.0 * A            plus: where A is semidefinite, so is 2 A. That the number is > 0 (>= 0 if
//                        A is not definite) is checked as soon as a law depends on it
//     -(2.0 * A), -A     minus: checked in the same way before the sign is turned
//     any_sign(c) * A    any finite number; laws that depend on its sign are lost
//     positive(c) * A    plus, checked here and now whatever A is
//
// Rejected: a plain number loses the laws (then everybody writes `positive` everywhere); constants
// only, by a consteval constructor (then `c * A` of a variable does not compile). The price is that
// a wrong sign is an exception at construction where it could be a lost law.

// --- what the user writes in front ---------------------------------------------------------------

/// A number known to be positive.
template <class S>
class positive_factor {
 public:
  /// Throws bad_input unless 0 < c < ∞.
  explicit positive_factor(S c) : value_(std::move(c)) { detail::check_positive("c", value_); }
  [[nodiscard]] S const& value() const noexcept { return value_; }

 private:
  S value_;
};

/// Marks c as positive. Throws bad_input unless 0 < c < ∞.
template <class S>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] positive_factor<S> positive(S c) {
  return positive_factor<S>(std::move(c));
}

/// A number of which nothing is promised.
template <class S>
struct any_sign_factor {
  S value;
};

/// Marks c as a number of any sign: any_sign(c) * A is self-adjoint if A is, and no more.
/// Throws bad_input if c is NaN or infinite.
template <class S>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] any_sign_factor<S> any_sign(S c) {
  if (!detail::is_finite(c)) throw bad_input("c", detail::show(c), "a finite number");
  return {c};
}

}  // namespace slant

namespace slant::expr {

enum class sign : signed char { minus = -1, any = 0, plus = 1 };

[[nodiscard]] constexpr sign operator*(sign a, sign b) {
  return static_cast<sign>(static_cast<int>(a) * static_cast<int>(b));
}

/// No number in front.
struct one {};
/// A minus in front.
struct minus_one {};

/// value / divisor, kept apart so that 1/c is rounded in the scalar of the vectors.
template <class S, sign Sign>
struct number {
  S value;
  S divisor;
};

template <class C>
inline constexpr sign sign_of = sign::plus;
template <>
inline constexpr sign sign_of<minus_one> = sign::minus;
template <class S, sign Sign>
inline constexpr sign sign_of<number<S, Sign>> = Sign;

/// The scalar of a product of numbers: the wider one; of a foreign scalar and a double, the former.
template <class S, class T>
using common_number = std::conditional_t<
    std::is_floating_point_v<S> && std::is_floating_point_v<T>, std::common_type<S, T>,
    std::type_identity<std::conditional_t<std::is_same_v<S, double>, T, S>>>::type;

template <class C>
[[nodiscard]] auto negative_number(C const& c) {
  if constexpr (std::same_as<C, one>) {
    return minus_one{};
  } else if constexpr (std::same_as<C, minus_one>) {
    return one{};
  } else {
    using S = decltype(c.value);
    return number<S, sign_of<C> * sign::minus>{S(-c.value), c.divisor};
  }
}

/// Neither infinite nor NaN, nor so small that digits are lost.
template <class S>
[[nodiscard]] bool is_normal(S const& s) {
  using std::abs;
  return slant::detail::is_finite(s) && !(abs(s) < std::numeric_limits<S>::min());
}

/// c d. Throws bad_input if the product leaves the range of its scalar.
template <class C, class D>
[[nodiscard]] auto multiply_numbers(C const& c, D const& d) {
  if constexpr (std::same_as<C, one>) {
    return d;
  } else if constexpr (std::same_as<D, one>) {
    return c;
  } else if constexpr (std::same_as<C, minus_one>) {
    return negative_number(d);
  } else if constexpr (std::same_as<D, minus_one>) {
    return negative_number(c);
  } else {
    using S = common_number<decltype(c.value), decltype(d.value)>;
    number<S, sign_of<C> * sign_of<D>> p{S(S(c.value) * S(d.value)),
                                         S(S(c.divisor) * S(d.divisor))};
    if (!expr::is_normal(p.value) || !expr::is_normal(p.divisor)) {
      p = {S(S(c.value) / S(c.divisor)) * S(S(d.value) / S(d.divisor)), S(1)};
    }
    S const quotient = p.value / p.divisor;
    bool const lost = quotient == S(0) && S(c.value) != S(0) && S(d.value) != S(0);
    if (lost || !slant::detail::is_finite(quotient) || !slant::detail::is_finite(p.divisor)) {
      auto const text = [](auto const& of) { return slant::detail::show(of.value / of.divisor); };
      throw bad_input("c", text(c) + " * " + text(d),
                      "numbers whose product is in the range of the scalar");
    }
    return p;
  }
}

/// 1/c. Throws bad_input if that is not finite.
template <class C>
[[nodiscard]] C reciprocal_number(C const& c) {
  if constexpr (std::is_empty_v<C>) {
    return c;
  } else {
    using S = decltype(c.value);
    if (c.value == S(0) || !slant::detail::is_finite(S(c.divisor / c.value))) {
      throw bad_input("c", slant::detail::show(c.value), "a number with a finite reciprocal");
    }
    return {c.divisor, c.value};
  }
}

/// The number as a T.
template <class T, class C>
[[nodiscard]] T value_as(C const& c) {
  if constexpr (std::is_empty_v<C>) {
    return T(static_cast<int>(sign_of<C>));
  } else {
    using S = decltype(c.value);
    T const value = static_cast<T>(c.value);
    if (c.divisor == S(1)) return value;
    T const divisor = static_cast<T>(c.divisor);
    // The two can leave the range of T where the number does not.
    return expr::is_normal(value) && expr::is_normal(divisor)
               ? T(value / divisor)
               : static_cast<T>(S(c.value / c.divisor));
  }
}

/// "", "−", "2 ", "−2 ".
template <class C>
[[nodiscard]] std::string text_in_front(C const& c) {
  if constexpr (std::same_as<C, one>) {
    return {};
  } else {
    double const v = expr::value_as<double>(c);
    return v == -1 ? "−" : v < 0 ? "−" + number_text(-v) + " " : number_text(v) + " ";
  }
}

/// Throws bad_input unless the number has the sign that a law of its product depends on.
template <class C>
void require_sign(C const& c, bool strictly) {
  if constexpr (!std::is_empty_v<C> && sign_of<C> != sign::any) {
    using S = decltype(c.value);
    S const magnitude =
        sign_of<C> == sign::plus ? S(c.value / c.divisor) : S(-(c.value / c.divisor));
    if (magnitude > S(0) || (!strictly && magnitude == S(0))) return;
    throw bad_input("c", slant::detail::show(magnitude),
                    strictly
                        ? "a number > 0 in front of a definite operator; for others write "
                          "-(c * A) or any_sign(c) * A"
                        : "a number >= 0 in front of a semidefinite operator; for others write "
                          "-(c * A) or any_sign(c) * A");
  }
}

// --- as a number of an expression ----------------------------------------------------------------

template <class S>
inline constexpr bool is_marked = false;
template <class S>
inline constexpr bool is_marked<positive_factor<S>> = true;
template <class S>
inline constexpr bool is_marked<any_sign_factor<S>> = true;

template <class S> concept number_in_front = is_marked<S> || std::is_arithmetic_v<S> || scalar<S>;

/// Integers are kept as double.
template <class S>
using kept_number = std::conditional_t<std::is_integral_v<S>, double, S>;

template <class S>
[[nodiscard]] auto as_number(S const& c) {
  using T = kept_number<S>;
  T const value(c);
  slant::detail::check_option("c", value, slant::detail::is_finite(value), "a finite number");
  return number<T, sign::plus>{value, T(1)};
}
template <class S>
[[nodiscard]] auto as_number(positive_factor<S> const& c) {
  return as_number(c.value());
}
template <class S>
[[nodiscard]] auto as_number(any_sign_factor<S> const& c) {
  using T = kept_number<S>;
  return number<T, sign::any>{T(c.value), T(1)};
}

// --- adjoint factors -----------------------------------------------------------------------------
//
// Which factors are each other's adjoint, by their types, and what follows for the laws of products
// and sums:
//
//     F₁…F_k S F_kᵀ…F₁ᵀ    those of S among self-adjoint and semidefinite; definite if S is and
//                          all F have independent rows
//     F₁…F_k F_kᵀ…F₁ᵀ      the same with S = I
//     T₁ + … + T_n         self-adjoint if each term is or has its adjoint beside it; semidefinite
//                          if all are, and then definite if one is
//
// That letters which mirror each other are one object is checked when the expression is made.

template <class C, class... F>
class product;
template <class... T>
class sum;

using slant::detail::nth;

template <class A>
inline constexpr bool is_sum = false;
template <class... T>
inline constexpr bool is_sum<sum<T...>> = true;
template <class A>
inline constexpr bool is_product = false;
template <class C, class... F>
inline constexpr bool is_product<product<C, F...>> = true;

/// It is printed with a number in front.
template <class A>
concept starts_with_number = requires(A const& a) {
  requires !std::is_same_v<std::remove_cvref_t<decltype(a.coefficient())>, one>;
};

// --- mirrors -------------------------------------------------------------------------------------

/// G is the adjoint of F, as far as types can tell. An expression with a number in it, which is a
/// value, is the adjoint of no other: it needs a name.
template <class F, class G>
inline constexpr bool mirrors = false;

/// Objects of type A are one operator: a formula of letters with names, or what decorates one.
template <class A>
[[nodiscard]] consteval bool is_named_formula() {
  if constexpr (decorates<A>) {
    return is_named_formula<std::remove_cvref_t<decltype(std::declval<A const&>().get())>>();
  } else if constexpr (expression<A>) {
    return mirrors<A, decltype(std::declval<A const&>().adjoint())>;
  } else {
    return false;
  }
}

template <auto Name, class A, unsigned P, unsigned Q>
inline constexpr bool mirrors<letter<Name, A, P>, letter<Name, A, Q>> = [] {
  if constexpr ((P & inverted) != (Q & inverted)) {
    return false;
  } else if constexpr (is_named<Name> || is_named_formula<A>()) {
    return ((P ^ Q) & adjointed) != 0 || is_self_adjoint<letter<Name, A, P>>;
  } else {
    return false;
  }
}();

template <class C, class... F, class... G>
  requires(std::is_empty_v<C> && sizeof...(F) == sizeof...(G))
inline constexpr bool mirrors<product<C, F...>, product<C, G...>> =
    []<std::size_t... I>(std::index_sequence<I...>) {
      return (mirrors<F, nth<sizeof...(G) - 1 - I, G...>> && ...);
    }(std::index_sequence_for<F...>{});

template <class... T, class... U>
  requires(sizeof...(T) == sizeof...(U))
inline constexpr bool mirrors<sum<T...>, sum<U...>> = (mirrors<T, U> && ...);

template <class C, class... F, class... G>
[[nodiscard]] bool same_letters(product<C, F...> const& f, product<C, G...> const& g);
template <class... T, class... U>
[[nodiscard]] bool same_letters(sum<T...> const& f, sum<U...> const& g);

/// Whether the letters of F and G, which mirror each other by their types, are the same objects.
template <auto Name, class A, unsigned P, unsigned Q>
[[nodiscard]] bool same_letters(letter<Name, A, P> const& f, letter<Name, A, Q> const& g) {
  if constexpr (is_named<Name>) {
    return f.origin() == g.origin();
  } else {
    auto const same = [](auto const& self, auto const& a, auto const& b) {
      if constexpr (decorates<std::remove_cvref_t<decltype(a)>>) {
        return self(self, a.get(), b.get());
      } else {
        return expr::same_letters(a, b.adjoint());
      }
    };
    return same(same, *f.object(), *g.object());
  }
}
template <class C, class... F, class... G>
bool same_letters(product<C, F...> const& f, product<C, G...> const& g) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return (expr::same_letters(f.template factor<I>(), g.template factor<sizeof...(G) - 1 - I>()) &&
            ...);
  }(std::index_sequence_for<F...>{});
}
template <class... T, class... U>
bool same_letters(sum<T...> const& f, sum<U...> const& g) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return (expr::same_letters(f.template term<I>(), g.template term<I>()) && ...);
  }(std::index_sequence_for<T...>{});
}

/// Throws bad_input unless letters that mirror each other are the same objects.
[[gnu::cold]] inline void require_same_letters(bool same) {
  if (!same) {
    throw bad_input("an operator",
                    "two different objects made by one op(…), one of them as an adjoint",
                    "one object, or op<\"name\">(…), or distinct(…) of one of them");
  }
}

// --- laws ----------------------------------------------------------------------------------------

/// How many pairs at the two ends of F₁ … F_n mirror each other.
template <class... F>
[[nodiscard]] consteval std::size_t mirrored_pairs() {
  constexpr std::size_t n = sizeof...(F);
  std::size_t k = 0;
  bool open = true;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((open = open && mirrors<nth<I, F...>, nth<n - 1 - I, F...>>, k += open ? 1 : 0), ...);
  }(std::make_index_sequence<n / 2>{});
  return k;
}

/// The rows of F are independent, whether that is asserted of F or of G, its adjoint.
template <class F, class G>
inline constexpr bool rows_are_independent =
    declares_full_row_rank<F> || declares_full_row_rank<decltype(std::declval<G>().adjoint())>;

/// The laws of F₁ … F_n without a number in front.
template <class... F>
[[nodiscard]] consteval law_set product_laws() {
  constexpr std::size_t n = sizeof...(F);
  constexpr std::size_t k = mirrored_pairs<F...>();
  if constexpr (n == 1) {
    return laws_of<nth<0, F...>>;
  } else if constexpr (k == 0 || n > 2 * k + 1) {
    return {};
  } else {
    bool const independent = []<std::size_t... I>(std::index_sequence<I...>) {
      return (rows_are_independent<nth<I, F...>, nth<n - 1 - I, F...>> && ...);
    }(std::make_index_sequence<k>{});
    law_set const middle = [] {
      if constexpr (n == 2 * k) {
        return laws_of<identity_operator>;
      } else {
        return laws_of<nth<k, F...>>;
      }
    }();
    return slant::detail::congruence_laws(middle, independent);
  }
}

/// For each term its own position if it is self-adjoint, that of its adjoint if there is one, or n.
template <class... T>
[[nodiscard]] consteval std::array<std::size_t, sizeof...(T)> partners() {
  constexpr std::size_t n = sizeof...(T);
  std::array<std::size_t, n> partner{};
  for (auto& p : partner) p = n;
  auto const match = [&]<class A>(std::type_identity<A>, std::size_t i) {
    if (partner[i] < n) return;
    std::array<bool, n> const fits{mirrors<A, T>...};
    if (is_self_adjoint<A>) partner[i] = i;
    for (std::size_t j = i + 1; j < n && partner[i] == n; ++j) {
      if (partner[j] == n && fits[j]) {
        partner[i] = j;
        partner[j] = i;
      }
    }
  };
  std::size_t i = 0;
  (match(std::type_identity<T>{}, i++), ...);
  return partner;
}

/// The laws of T₁ + … + T_n.
template <class... T>
[[nodiscard]] consteval law_set sum_laws() {
  bool paired = true;
  for (std::size_t const p : partners<T...>()) paired = paired && p < sizeof...(T);
  return slant::detail::sum_laws({laws_of<T>...}) | slant::laws<law::self_adjoint>.when(paired);
}

}  // namespace slant::expr
