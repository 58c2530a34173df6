// SPDX-License-Identifier: MIT
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
#pragma once

#include <slant/operators/letter.hpp>
#include <slant/operators/number.hpp>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant::expr {

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

// --- mirrors -------------------------------------------------------------------------------------

/// G is the adjoint of F, as far as types can tell. An expression with a number in it, which is a
/// value, is the adjoint of no other: it needs a name.
template <class F, class G>
inline constexpr bool mirrors = false;

template <auto Name, class A, unsigned P, unsigned Q>
inline constexpr bool mirrors<letter<Name, A, P>, letter<Name, A, Q>> = [] {
  if constexpr (is_named<Name> && (P & inverted) == (Q & inverted)) {
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

/// Throws bad_input if letters of F and G, which mirror each other, are different objects.
template <auto Name, class A, unsigned P, unsigned Q>
void check_mirror(letter<Name, A, P> const& f, letter<Name, A, Q> const& g) {
  if (f.origin() != g.origin()) {
    throw bad_input(text_of(Name).empty() ? std::string_view("an operator") : text_of(Name),
                    "two different objects made by one op(…), one of them as an adjoint",
                    "one object, or op<\"name\">(…), or distinct(…) of one of them");
  }
}
template <class C, class... F, class... G>
void check_mirror(product<C, F...> const& f, product<C, G...> const& g) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (expr::check_mirror(f.template factor<I>(), g.template factor<sizeof...(G) - 1 - I>()), ...);
  }(std::index_sequence_for<F...>{});
}
template <class... T, class... U>
void check_mirror(sum<T...> const& f, sum<U...> const& g) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (expr::check_mirror(f.template term<I>(), g.template term<I>()), ...);
  }(std::index_sequence_for<T...>{});
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
      return (declares_full_row_rank<nth<I, F...>> && ...);
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
