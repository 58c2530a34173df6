// SPDX-License-Identifier: MIT
//
// Products of different sets, one after the other in the vector: normal forces in half lines, then
// tangential forces in discs.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/block_product.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/detail/cartesian_base.hpp>
#include <slant/sets/detail/refused_set.hpp>
#include <slant/sets/direct_sum_slant.hpp>
#include <slant/sets/projection_slant.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant {

/// Λ₁ × … × Λ_k. Made by `cartesian`. If all parts are blocks, so is the product (block_product);
/// this is the other case, whose dimension is known at run time only. Offsets in front of the first
/// such part are compile-time constants all the same.
template <class... Parts>
class cartesian_product : public detail::cartesian_base<Parts...> {
  using base = detail::cartesian_base<Parts...>;

 public:
  using scalar = set_scalar_t<typename base::template part_type<0>>;

  using base::base;

  /// Number of components.
  [[nodiscard]] index size() const { return this->template offset<sizeof...(Parts)>(); }

  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    eigen_assert(slant::local(x).size() == size() && slant::local(y).size() == size());
    this->for_each_part(
        [&](auto const& part, auto const& p) { detail::project_part(part, p, x, y); });
  }

  /// x ∈ Λ, up to rounding.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    if (slant::local(x).size() != size()) return false;
    return this->all_parts([&](auto const& part, auto const& p) {
      return part.contains(detail::argument_of(part, p, x));
    });
  }

  /// The slanting operator of the projection at x.
  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires base::all_slant
  {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return make_slant(slant::projection_slant(this->template part<I>(), argument<I>(x))...);
    }(std::index_sequence_for<Parts...>{});
  }

  /// The same into an operator that slant(x) made earlier; does not allocate unless a part must.
  template <class X, class... Slants>
  void slant(X const& x, direct_sum_slant<Slants...>& g) const
    requires base::all_slant
  {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::projection_slant(this->template part<I>(), argument<I>(x), g.template part<I>()),
       ...);
    }(std::index_sequence_for<Parts...>{});
  }

 private:
  template <class... Slants>
  static direct_sum_slant<Slants...> make_slant(Slants... slants) {
    return direct_sum_slant<Slants...>(std::move(slants)...);
  }
  template <std::size_t I, class X>
  [[nodiscard]] auto argument(X const& x) const {
    return detail::argument_of(this->template part<I>(), this->template place_of<I>(), x);
  }
};

namespace detail {

/// One complaint per part that is no set; a fold over the parts would only say that one is not.
template <class Part>
consteval bool check_part() {
  static_assert(set_part<Part>, "a part of a cartesian product must be a convex set");
  return true;
}

}  // namespace detail

/// Λ₁ × … × Λ_k: cartesian(half_lines(m), discs(g)). Products passed as lvalues are referenced,
/// rvalues and blocks are owned. A product of blocks is itself a block.
template <class... Parts>
  requires(sizeof...(Parts) > 0)
[[nodiscard]] auto cartesian(Parts&&... parts) {
  if constexpr (!(set_part<std::remove_cvref_t<Parts>> && ...)) {
    static_cast<void>((detail::check_part<std::remove_cvref_t<Parts>>() && ...));
    return detail::refused_set{};
  } else if constexpr ((has_static_dimension<std::remove_cvref_t<Parts>> && ...)) {
    return block_product<std::remove_cvref_t<Parts>...>(std::remove_cvref_t<Parts>(parts)...);
  } else {
    return cartesian_product<detail::kept_part_t<Parts>...>(
        held<detail::kept_part_t<Parts>>(std::forward<Parts>(parts))...);
  }
}

}  // namespace slant
