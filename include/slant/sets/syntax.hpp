// SPDX-License-Identifier: MIT
//
// Sets as they are written on paper:
//
//     half_lines(m) * discs(g)       the product of two sets, kept flat: cartesian
//     2.0 * Λ                        { 2 z : z ∈ Λ }: scaled
//     Λ + c, c + Λ, Λ - c            { z ± c : z ∈ Λ }, c a vector: shifted
//
// Found by argument-dependent lookup; the functions of those names do the same.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/images.hpp>
#include <slant/sets/support.hpp>

#include <boost/hana/basic_tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <concepts>

#include <type_traits>
#include <utility>

namespace slant {

/// A convex set: what has a projection, and neither rows as an operator nor entries as a vector.
template <class C>
concept set_term = !has_rows<std::remove_cvref_t<C>> && set_part<std::remove_cvref_t<C>>;

namespace detail {

template <class C>
inline constexpr bool is_product_of_sets = false;
template <class... Parts>
inline constexpr bool is_product_of_sets<cartesian_product<Parts...>> = true;

/// The parts of an own product; anything else is one part.
template <class C>
[[nodiscard]] auto parts_of_set(C&& set) {
  if constexpr (!std::is_lvalue_reference_v<C> && is_product_of_sets<C>) {
    return std::move(set).parts();
  } else {
    using kept = held<kept_part_t<C>>;
    return boost::hana::basic_tuple<kept>(kept(std::forward<C>(set)));
  }
}

}  // namespace detail

/// Λ × Μ. Products passed as lvalues are referenced, rvalues and blocks are owned.
template <set_term C, set_term D>
[[nodiscard]] auto operator*(C&& c, D&& d) {
  using first = std::remove_cvref_t<C>;
  using second = std::remove_cvref_t<D>;
  if constexpr (has_static_dimension<first> && has_static_dimension<second>) {
    return slant::cartesian(std::forward<C>(c), std::forward<D>(d));
  } else {
    return boost::hana::unpack(
        detail::parts_of_set(std::forward<C>(c)), [&]<class... P>(held<P>... left) {
          return boost::hana::unpack(
              detail::parts_of_set(std::forward<D>(d)), [&]<class... Q>(held<Q>... right) {
                return cartesian_product<P..., Q...>(std::move(left)..., std::move(right)...);
              });
        });
  }
}

/// c Λ. @throws bad_input unless c is a finite number > 0.
template <class S, set_term C>
  requires std::convertible_to<S, set_scalar_t<C>>
[[nodiscard]] auto operator*(S const& c, C&& set) {
  return slant::scaled(c, std::forward<C>(set));
}

/// Refused: the set says it better, and its zeros stay exact.
template <class S, class C>
  requires std::convertible_to<S, set_scalar_t<support_function<C>>>
support_function<C> operator*(S const&, support_function<C> σ) {
  static_assert(!std::same_as<S, S>,
                "c * support(set): give the set its size, as in support(discs(c * g))");
  return σ;
}

/// Λ + c. @throws bad_input unless c has the size of Λ and finite entries.
template <set_term C, class V>
  requires has_local<std::remove_cvref_t<V>>
[[nodiscard]] auto operator+(C&& set, V&& c) {
  return slant::shifted(std::forward<C>(set), std::forward<V>(c));
}
template <class V, set_term C>
  requires has_local<std::remove_cvref_t<V>>
[[nodiscard]] auto operator+(V&& c, C&& set) {
  return slant::shifted(std::forward<C>(set), std::forward<V>(c));
}
template <set_term C, class V>
  requires has_local<std::remove_cvref_t<V>>
[[nodiscard]] auto operator-(C&& set, V const& c) {
  auto minus_c = slant::like(c, slant::local(c).size());
  vectors::negate(c, minus_c);
  return slant::shifted(std::forward<C>(set), std::move(minus_c));
}

}  // namespace slant
