// SPDX-License-Identifier: MIT
//
// What products of different sets share, whether their dimension is static or not.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/operators/held.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/place.hpp>

#include <boost/hana/basic_tuple.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// How a product keeps a part passed as T&&: blocks are small and copied, everything else follows
/// the rule of operators/held.hpp.
template <class T>
using kept_part_t = std::conditional_t<has_static_dimension<std::remove_cvref_t<T>>,
                                       std::remove_cvref_t<T>, kept_t<T>>;

template <class... Parts>
class cartesian_base {
 protected:
  template <std::size_t I>
  using part_type = std::remove_cvref_t<std::tuple_element_t<I, std::tuple<Parts...>>>;

  static constexpr bool all_slant = (has_slant<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);
  static constexpr bool all_step =
      (has_step_to_boundary<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);
  static constexpr bool all_support =
      (has_support<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);

 public:
  explicit cartesian_base(held<Parts>... parts) : parts_(std::move(parts)...) {}

  static constexpr std::size_t part_count = sizeof...(Parts);

  template <std::size_t I>
  [[nodiscard]] constexpr part_type<I> const& part() const {
    return boost::hana::at_c<I>(parts_).get();
  }

  /// First component of part I; offset<part_count>() is the dimension.
  template <std::size_t I>
  [[nodiscard]] constexpr index offset() const {
    if constexpr (I == 0) {
      return 0;
    } else {
      return offset<I - 1>() + slant::dimension_of(part<I - 1>());
    }
  }

  /// offset<I>() if the types tell, else -1.
  template <std::size_t I>
  [[nodiscard]] static consteval index static_offset() {
    if constexpr (I == 0) {
      return 0;
    } else {
      constexpr int last = static_dimension_of<part_type<I - 1>>;
      constexpr index before = static_offset<I - 1>();
      return before < 0 || last < 0 ? index{-1} : before + last;
    }
  }

  [[nodiscard]] index block_count() const {
    index n = 0;
    for_each_part([&](auto const& part, auto const&) { n += slant::block_count(part); });
    return n;
  }

  /// sup{α >= 0 : x + α d ∈ Λ} for x ∈ Λ. Looks no further once a step below `enough` is found, and
  /// returns that: enough to know that a step of length `enough` would leave Λ.
  template <class X, class D, class S = scalar_t<X>>
  [[nodiscard]] S step_to_boundary(X const& x, D const& d,
                                   std::type_identity_t<S> const& enough = S(0)) const
    requires all_step
  {
    smallest_step<S> smallest(enough);
    all_parts([&](auto const& part, auto const& p) {
      return !smallest(step_of(part, argument_of(part, p, x), argument_of(part, p, d), enough));
    });
    return smallest.value();
  }

  /// sup{yᵀz : z ∈ Λ}, ∞ allowed.
  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const
    requires all_support
  {
    scalar_t<Y> sum(0);
    for_each_part(
        [&](auto const& part, auto const& p) { sum += part.support(argument_of(part, p, y)); });
    return sum;
  }

  /// f(block, place) for every innermost block.
  template <class F>
  void visit(F&& f) const {
    for_each_part([&](auto const& part, auto const& outer) {
      slant::visit_blocks(part, [&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
    });
  }

 protected:
  template <std::size_t I>
  [[nodiscard]] constexpr auto place_of(index number = 0) const {
    constexpr index known = static_offset<I>();
    return place<static_dimension_of<part_type<I>>>(number, known < 0 ? offset<I>() : known,
                                                    slant::dimension_of(part<I>()));
  }

  /// f(part, place) for every part.
  template <class F>
  void for_each_part(F&& f) const {
    index number = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((f(part<I>(), place_of<I>(number)), number += slant::block_count(part<I>())), ...);
    }(std::index_sequence_for<Parts...>{});
  }

  /// Whether f(part, place) holds for all parts; stops at the first for which it does not.
  template <class F>
  bool all_parts(F&& f) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (f(part<I>(), place_of<I>()) && ...);
    }(std::index_sequence_for<Parts...>{});
  }

 private:
  boost::hana::basic_tuple<held<Parts>...> parts_;
};

}  // namespace slant::detail
