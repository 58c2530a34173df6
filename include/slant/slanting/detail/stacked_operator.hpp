// SPDX-License-Identifier: MIT
//
// Operators of the same argument, one above the other: y = (A₁x; A₂x; …). The slanting operator of
// a stack of functions. Each part writes into its rows of an Eigen vector; of another kind of
// vector it writes all of one, whose entries are then copied.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/detail/accumulate.hpp>
#include <slant/operators/detail/applicable.hpp>
#include <slant/operators/held.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// `rows` holds the part's own rows of the result, or of the argument of the adjoint.
template <class Inner, class Vector>
struct stacked_part_workspace {
  Inner inner;
  Vector rows;
};

template <class Inner, class Vector>
[[nodiscard]] auto make_stacked_part_workspace(Inner inner, Vector rows) {
  return stacked_part_workspace<Inner, Vector>{std::move(inner), std::move(rows)};
}

/// Its rows of Y, as an Eigen view.
template <class Y>
using rows_view_t = decltype(slant::local(std::declval<Y&>()).middleRows(index{}, index{}));

/// A can write straight into rows of Y, where that is nothing but an Eigen object.
template <class A, class X, class Y>
concept writes_rows =
    std::is_same_v<local_t<X>, std::remove_cvref_t<X>> &&
    std::is_same_v<local_t<Y>, std::remove_cvref_t<Y>> && applies<A, X, rows_view_t<Y>>;

/// y = (A₁x; A₂x; …), all with the same number of columns.
template <class... A>
class stacked_operator {
  static_assert(sizeof...(A) >= 1);

 public:
  static constexpr law_set laws{};

  explicit stacked_operator(held<A>... parts) : parts_(std::move(parts)...) {}

  [[nodiscard]] index rows() const {
    index n = 0;
    for_each([&](auto const& a, auto, index) { n += a.rows(); });
    return n;
  }
  [[nodiscard]] index cols() const { return boost::hana::at_c<0>(parts_).get().cols(); }

  template <class X>
    requires(linear_operator<std::remove_cvref_t<A>, plain_t<X>> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return boost::hana::unpack(parts_, [&](auto const&... kept) {
      return std::make_tuple(make_stacked_part_workspace(slant::workspace(kept.get(), x),
                                                         slant::like(x, kept.get().rows()))...);
    });
  }
  template <class X, class Y, class W>
    requires(applies<std::remove_cvref_t<A>, X, plain_t<X>> && ...)
  void apply(X const& x, Y& y, W& w) const {
    for_each([&](auto const& a, auto i, index first) {
      auto& own = std::get<i()>(w);
      if constexpr (writes_rows<std::remove_cvref_t<decltype(a)>, X, Y>) {
        auto rows = slant::local(y).middleRows(first, a.rows());
        slant::apply(a, x, rows, own.inner);
      } else {
        slant::apply(a, x, own.rows, own.inner);
        slant::local(y).middleRows(first, a.rows()) = slant::local(own.rows);
      }
    });
  }

  template <class X>
    requires(has_adjoint<std::remove_cvref_t<A>, plain_t<X>> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return boost::hana::unpack(parts_, [&](auto const&... kept) {
      return std::make_tuple(part_adjoint_workspace(kept.get(), x)...);
    });
  }
  /// y = A₁ᵀx₁ + A₂ᵀx₂ + ….
  template <class X, class Y, class W>
    requires(adds_adjoint<std::remove_cvref_t<A>, plain_t<X>, Y> && ...)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    vectors::set_zero(y);
    for_each([&](auto const& a, auto i, index first) {
      auto& own = std::get<i()>(w);
      slant::local(own.rows) = slant::local(x).middleRows(first, a.rows());
      accumulate_adjoint(a, scalar_t<X>(1), own.rows, y, own.inner);
    });
  }

 private:
  template <class P, class X>
  [[nodiscard]] static auto part_adjoint_workspace(P const& a, X const& x) {
    auto rows = slant::like(x, a.rows());
    auto inner = accumulate_adjoint_workspace(a, rows);
    return make_stacked_part_workspace(std::move(inner), std::move(rows));
  }
  /// f(part, its number as a constant, first row of it).
  template <class F>
  void for_each(F f) const {
    index first = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      auto const one = [&](auto const& a, auto i) {
        f(a, i, first);
        first += a.rows();
      };
      (one(boost::hana::at_c<I>(parts_).get(), std::integral_constant<std::size_t, I>{}), ...);
    }(std::index_sequence_for<A...>{});
  }

  boost::hana::tuple<held<A>...> parts_;
};

}  // namespace slant::detail
