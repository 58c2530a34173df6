// SPDX-License-Identifier: MIT
//
// Why an expression lacks a law: the part that breaks it, as a text that the compiler can build.
// The same text stands in describe(A) and in the error of a method that asks for the law; there the
// formula is a template argument of what complains, so that the compiler prints it:
//
//     lacks<formula<"B * inverse(K) * B + c * I">,
//           formula<"not self_adjoint: in the term B * inverse(K) * B, B at the end is not
//                    adjoint(B)">>
#pragma once

#include <slant/operators/syntax.hpp>

#include <algorithm>

namespace slant::expr {

template <class A>
struct reason {
  /// Of a letter.
  static constexpr void add(ascii& out, law l) {
    expr::spell_part<A>(out);
    out.add(" does not declare ").add(law_name(l));
  }
};

template <class A>
inline constexpr bool is_anonymous = false;
template <class A, unsigned Flags>
inline constexpr bool is_anonymous<letter<nameless{}, A, Flags>> = true;

template <class C, class... F>
struct reason<product<C, F...>> {
  static constexpr std::size_t n = sizeof...(F);
  static constexpr std::size_t k = n == 1 ? 0 : mirrored_pairs<F...>();

  static constexpr void add(ascii& out, law l) {
    if (product<C, F...>::core_laws.contains(l)) {
      out.add(sign_of<C> == sign::minus ? "a minus" : "a number of any sign");
      out.add(" stands before ");
      expr::spell_part<product<one, F...>>(out);
    } else if constexpr (n == 1) {
      reason<nth<0, F...>>::add(out, l);
    } else if constexpr (n > 2 * k + 1) {
      unlike(out);
    } else {
      if constexpr (n == 2 * k + 1) {
        if (!laws_of<nth<k, F...>>.contains(l)) {
          out.add("in the middle, ");
          reason<nth<k, F...>>::add(out, l);
          return;
        }
      }
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        static_cast<void>((dependent<nth<I, F...>, nth<n - 1 - I, F...>>(out) || ...));
      }(std::make_index_sequence<k>{});
    }
  }

 private:
  static constexpr void unlike(ascii& out) {
    using left = nth<k, F...>;
    using right = nth<n - 1 - k, F...>;
    expr::spell_part<right>(out);
    out.add(" at the end is not adjoint(");
    expr::spell_part<left>(out);
    out.add(")");
    if (is_anonymous<left> || is_anonymous<right>) {
      out.add(" as far as types tell: name both by op<\"...\">");
    }
  }
  template <class G, class Adjoint>
  static constexpr bool dependent(ascii& out) {
    if (rows_are_independent<G, Adjoint>) return false;
    out.add("the rows of ");
    expr::spell_part<G>(out);
    out.add(" may be dependent: assert full_row_rank(");
    expr::spell_part<G>(out);
    out.add(")");
    return true;
  }
};

template <class P>
struct reason<sealed<P>> : reason<P> {};

template <class... T>
struct reason<sum<T...>> {
  static constexpr void add(ascii& out, law l) {
    law const needed = l == law::positive_definite ? law::positive_semidefinite : l;
    bool found = false;
    constexpr auto partner = partners<T...>();
    std::size_t i = 0;
    auto const look_at = [&]<class U>(std::type_identity<U>) {
      bool const paired = partner[i++] < sizeof...(T) && l == law::self_adjoint;
      if (found || paired || laws_of<U>.contains(needed)) return;
      found = true;
      out.add("in the term ");
      expr::spell_part<U>(out);
      out.add(", ");
      reason<U>::add(out, needed);
    };
    (look_at(std::type_identity<T>{}), ...);
    if (!found) {
      out.add("no term is definite: ");
      reason<nth<0, T...>>::add(out, l);
    }
  }
};

/// What of `wanted` the expression lacks, and why; empty if nothing.
template <class A>
[[nodiscard]] consteval ascii missing_law(law_set wanted) {
  ascii out;
  for (law const l : {law::self_adjoint, law::positive_semidefinite, law::positive_definite}) {
    if (wanted.contains(l) && !laws_of<A>.contains(l)) {
      out.add("not ").add(law_name(l)).add(": ");
      reason<A>::add(out, l);
      return out;
    }
  }
  return out;
}

template <class A>
[[nodiscard]] consteval ascii formula_of() {
  ascii out;
  expr::spell_part<A>(out);
  return out;
}

// --- in the errors of the compiler ---------------------------------------------------------------

/// A text as template arguments, which the compilers print; clang++ no more than 32 characters of each.
template <text... Piece>
struct formula {};

#if defined(__clang__)
inline constexpr std::size_t piece_length = 31;
#else
inline constexpr std::size_t piece_length = sizeof(ascii::data);
#endif

template <ascii Text, std::size_t I>
[[nodiscard]] consteval auto piece() {
  constexpr std::size_t first = I * piece_length;
  text<std::min(piece_length, Text.size - first) + 1> t;
  for (std::size_t i = 0; i + 1 < sizeof t; ++i) t.data[i] = Text.data[first + i];
  return t;
}
template <ascii Text>
[[nodiscard]] consteval auto readable() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return formula<piece<Text, I>()...>{};
  }(std::make_index_sequence<(Text.size + piece_length - 1) / piece_length>{});
}

template <class A>
inline constexpr ascii formula_text = formula_of<A>();
template <class A, law_set L>
inline constexpr ascii missing_text = missing_law<A>(L);

/// An operator that a method asks for laws, and why it lacks them.
template <class Operator, class Because>
struct lacks {
  static_assert(sizeof(Operator) + sizeof(Because) == 0,
                "A must have the laws that the method asks for; see what it lacks above");
  static constexpr bool told = true;
};

}  // namespace slant::expr

namespace slant::detail {

template <expression A, law_set L>
struct complaint_about<A, L> {
  using type = expr::lacks<decltype(expr::readable<expr::formula_text<A>>()),
                           decltype(expr::readable<expr::missing_text<A, L>>())>;
};

}  // namespace slant::detail
