// SPDX-License-Identifier: MIT
//
// The slanting operator of a projection onto a cartesian product: the operators of the parts, one
// after the other.
#pragma once

#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>

#include <boost/hana/basic_tuple.hpp>

#include <cstddef>
#include <utility>

namespace slant {

namespace detail {

template <class X>
using rows_of_t = decltype(slant::local(std::declval<X&>()).middleRows(index{}, index{}));

/// P applies to its rows of X, into its rows of Y.
template <class P, class X, class Y>
concept applies_to_rows =
    requires(P const& part, rows_of_t<X const> const x, rows_of_t<Y> y) { part.apply(x, y); };

/// P adds to its rows of Y.
template <class P, class X, class Y>
concept accumulates_rows = requires(P const& part, scalar_t<X> α, rows_of_t<X const> const x,
                                    rows_of_t<Y> y) { part.apply_add(α, x, y); };

/// P writes its diagonal into its rows of V.
template <class P, class V>
concept writes_diagonal_rows = requires(P const& part, rows_of_t<V> d) { part.diagonal(d); };

}  // namespace detail

/// diag(P₁, …, P_k) for operators P_i that apply without a workspace to segments of a vector. Every
/// law that all parts declare holds for the direct sum, and it can do what all parts can.
template <class... Parts>
class direct_sum_slant {
 public:
  static constexpr auto laws = (law_set{~0U} & ... & laws_of<Parts>);

  explicit direct_sum_slant(Parts... parts) : parts_(std::move(parts)...) {}

  [[nodiscard]] index rows() const {
    index n = 0;
    for_each([&](auto const& part, index) { n += part.rows(); });
    return n;
  }
  [[nodiscard]] index cols() const { return rows(); }

  /// P_i.
  template <std::size_t I>
  [[nodiscard]] auto const& part() const {
    return boost::hana::at_c<I>(parts_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& part() {
    return boost::hana::at_c<I>(parts_);
  }

  /// y = G x.
  template <class X, class Y>
    requires(detail::applies_to_rows<Parts, X, Y> && ...)
  void apply(X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for_each([&](auto const& part, index first) {
      auto const xs = from.middleRows(first, part.rows());
      auto ys = to.middleRows(first, part.rows());
      part.apply(xs, ys);
    });
  }

  /// y ← y + α G x.
  template <class X, class Y>
    requires(detail::accumulates_rows<Parts, X, Y> && ...)
  void apply_add(scalar_t<X> const& α, X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for_each([&](auto const& part, index first) {
      auto const xs = from.middleRows(first, part.rows());
      auto ys = to.middleRows(first, part.rows());
      part.apply_add(α, xs, ys);
    });
  }

  /// d = diag(G).
  template <class V>
    requires(detail::writes_diagonal_rows<Parts, V> && ...)
  void diagonal(V& d) const {
    auto& entries = slant::local(d);
    for_each([&](auto const& part, index first) {
      auto ds = entries.middleRows(first, part.rows());
      part.diagonal(ds);
    });
  }

 private:
  /// f(part, first row of it).
  template <class F>
  void for_each(F&& f) const {
    index first = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((f(part<I>(), first), first += part<I>().rows()), ...);
    }(std::index_sequence_for<Parts...>{});
  }

  boost::hana::basic_tuple<Parts...> parts_;
};

}  // namespace slant
