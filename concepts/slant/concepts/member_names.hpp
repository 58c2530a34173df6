// SPDX-License-Identifier: MIT
//
// What is known of a type before its vectors are: the names of its members.
//
// Intuition. apply(x, y) is usually a template, so whether it takes vectors of some type can only
// be asked with that type at hand, far from the line where a part went into a composition. But that
// there is no apply at all, or one that is misspelt, shows in that very line.
//
// How. A class derived from A and from another one with a member of that name finds two of them if
// A has one: the name is ambiguous. A class that is final cannot be asked and is believed.
#pragma once

#include <type_traits>

namespace slant {

namespace detail {

struct other_members {
  int apply, apply_adjoint, solve, value, slant, laws;
};
template <class A>
struct beside : A, other_members {};

template <class A> concept can_be_base = std::is_class_v<A> && !std::is_final_v<A>;

template <class A>
inline constexpr bool names_apply = !requires {
  requires can_be_base<A>;
  &beside<A>::apply;
};
template <class A>
inline constexpr bool names_apply_adjoint = !requires {
  requires can_be_base<A>;
  &beside<A>::apply_adjoint;
};
template <class A>
inline constexpr bool names_solve = !requires {
  requires can_be_base<A>;
  &beside<A>::solve;
};
template <class A>
inline constexpr bool names_value = !requires {
  requires can_be_base<A>;
  &beside<A>::value;
};
template <class A>
inline constexpr bool names_slant = !requires {
  requires can_be_base<A>;
  &beside<A>::slant;
};

template <class A> concept lacks_laws = requires { &beside<A>::laws; };
/// Not believed of a final class: there are no laws of its own unless it shows them.
template <class A> concept names_laws = requires { A::laws; } || (can_be_base<A> && !lacks_laws<A>);

}  // namespace detail

/// A has something called apply; the others likewise.
template <class A> concept has_apply_member = detail::names_apply<A>;
template <class A> concept has_apply_adjoint_member = detail::names_apply_adjoint<A>;
template <class A> concept has_solve_member = detail::names_solve<A>;
template <class A> concept has_value_member = detail::names_value<A>;
template <class A> concept has_slant_member = detail::names_slant<A>;

}  // namespace slant
