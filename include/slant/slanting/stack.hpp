// SPDX-License-Identifier: MIT
//
// Several slanting functions of the same argument, one above the other:
//
//     auto F = slant::stack(equilibrium, complementarity, friction);   // F(y) = (F₁(y); F₂(y); …)
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/composition.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- stacked operator ----------------------------------------------------------------------------
//
// Operators of the same argument, one above the other: y = (A₁x; A₂x; …). The slanting operator of
// a stack of functions. Each part writes into its rows of an Eigen vector; of another kind of
// vector it writes all of one, whose entries are then copied.

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

/// y = (A₁x; A₂x; …), all with the same number of columns. Owns the A, which can be renewed.
template <class... A>
class stacked_operator {
  static_assert(sizeof...(A) >= 1);

 public:
  static constexpr law_set laws{};

  explicit stacked_operator(A... parts) : parts_(std::move(parts)...) {}

  /// A_{I+1}.
  template <std::size_t I>
  [[nodiscard]] auto const& part() const noexcept {
    return boost::hana::at_c<I>(parts_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& part() noexcept {
    return boost::hana::at_c<I>(parts_);
  }

  [[nodiscard]] index rows() const {
    index n = 0;
    for_each([&](auto const& a, auto, index) { n += a.rows(); });
    return n;
  }
  [[nodiscard]] index cols() const { return boost::hana::at_c<0>(parts_).cols(); }

  template <class X>
    requires(linear_operator<A, plain_t<X>> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return boost::hana::unpack(parts_, [&](auto const&... a) {
      return boost::hana::make_tuple(
          make_stacked_part_workspace(slant::workspace(a, x), slant::like(x, a.rows()))...);
    });
  }
  template <class X, class Y, class W>
    requires(applies<A, X, plain_t<X>> && ...)
  void apply(X const& x, Y& y, W& w) const {
    for_each([&](auto const& a, auto i, index first) {
      auto& own = boost::hana::at_c<i()>(w);
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
    requires(has_adjoint<A, plain_t<X>> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return boost::hana::unpack(parts_, [&](auto const&... a) {
      return boost::hana::make_tuple(part_adjoint_workspace(a, x)...);
    });
  }
  /// y = A₁ᵀx₁ + A₂ᵀx₂ + ….
  template <class X, class Y, class W>
    requires(adds_adjoint<A, plain_t<X>, Y> && ...)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    vectors::set_zero(y);
    for_each([&](auto const& a, auto i, index first) {
      auto& own = boost::hana::at_c<i()>(w);
      slant::local(own.rows) = slant::local(x).middleRows(first, a.rows());
      accumulate<true>(a, scalar_t<X>(1), own.rows, y, own.inner);
    });
  }

 private:
  template <class P, class X>
  [[nodiscard]] static auto part_adjoint_workspace(P const& a, X const& x) {
    auto rows = slant::like(x, a.rows());
    auto inner = accumulate_workspace<true>(a, rows);
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
      (one(boost::hana::at_c<I>(parts_), std::integral_constant<std::size_t, I>{}), ...);
    }(std::index_sequence_for<A...>{});
  }

  boost::hana::tuple<A...> parts_;
};

}  // namespace slant::detail

namespace slant {

// --- stack ---------------------------------------------------------------------------------------

/// (F₁(y); F₂(y); …). Each F is `Function const&` (referenced) or a function type (owned).
template <class... F>
class stack_map : public slanting_base {
  template <class V>
  static constexpr bool usable = (slanting_function<std::remove_cvref_t<F>, V> && ...);

 public:
  /// @throws bad_input if the numbers of arguments differ.
  explicit stack_map(held<F>... parts) : parts_(std::move(parts)...) {
    for_each([&](auto const& f, auto i, index) {
      detail::require_equal_sizes("f" + std::to_string(i() + 1) + ".cols()", f.cols(), cols(),
                                  "f1.cols()");
    });
  }

  [[nodiscard]] index rows() const {
    index n = 0;
    for_each([&](auto const& f, auto, index) { n += f.rows(); });
    return n;
  }
  [[nodiscard]] index cols() const { return part<0>().cols(); }
  /// F_{I+1}.
  template <std::size_t I>
  [[nodiscard]] auto const& part() const noexcept {
    return boost::hana::at_c<I>(parts_).get();
  }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return boost::hana::unpack(parts_, [&](auto const&... f) {
      return boost::hana::make_tuple(detail::make_stacked_part_workspace(
          slant::workspace(f.get(), y), slant::like(y, f.get().rows()))...);
    });
  }
  template <class Y, class V, class W>
    requires usable<plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    for_each([&](auto const& f, auto i, index first) {
      auto& own = boost::hana::at_c<i()>(w);
      slant::evaluate(f, y, own.rows, own.inner);
      slant::local(v).segment(first, f.rows()) = slant::local(own.rows);
    });
  }
  template <class Y>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    return boost::hana::unpack(
        parts_, [&](auto const&... f) { return detail::stacked_operator(f.get().slant(y)...); });
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i, index) {
      slant::update_slant(f, y, g.template part<i()>(), boost::hana::at_c<i()>(w).inner);
    });
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i, index) {
      slant::update_slant_after_value(f, y, g.template part<i()>(),
                                      boost::hana::at_c<i()>(w).inner);
    });
  }

 private:
  /// visit(function, its number as a constant, its first row).
  template <class Visit>
  void for_each(Visit visit) const {
    index first = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      auto const one = [&](auto const& f, auto i) {
        visit(f, i, first);
        first += f.rows();
      };
      (one(part<I>(), std::integral_constant<std::size_t, I>{}), ...);
    }(std::index_sequence_for<F...>{});
  }

  boost::hana::tuple<held<F>...> parts_;
};

namespace detail {

/// One complaint per row that is no function; a fold over the rows would only say that one is not.
template <class Row>
void check_row() {
  static_assert(slanting_part<Row>, "a row of a stack must be a slanting function");
}

}  // namespace detail

/// y ↦ (F₁(y); F₂(y); …). Lvalues are referenced.
/// @throws bad_input if the numbers of arguments differ.
template <class... F>
  requires(sizeof...(F) >= 1)
[[nodiscard]] auto stack(F&&... f) {
  if constexpr (!(slanting_part<F> && ...)) {
    (detail::check_row<F>(), ...);
    return detail::stand_in{};
  } else {
    return stack_map<kept_t<F>...>(held<kept_t<F>>(std::forward<F>(f))...);
  }
}

}  // namespace slant
