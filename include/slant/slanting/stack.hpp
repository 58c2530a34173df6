// SPDX-License-Identifier: MIT
//
// Several slanting functions of the same argument, one above the other:
//
//     auto F = slant::stack(equilibrium, complementarity, friction);   // F(y) = (F₁(y); F₂(y); …)
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/block.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Of one function: `rows` are its own rows of the value.
template <class Inner, class Vector>
struct stacked_part_workspace {
  Inner inner;
  Vector rows;
};

template <class Inner, class Vector>
stacked_part_workspace(Inner, Vector) -> stacked_part_workspace<Inner, Vector>;

}  // namespace slant::detail

namespace slant {

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
      return boost::hana::make_tuple(detail::stacked_part_workspace{
          slant::workspace(f.get(), y), slant::like(y, f.get().rows())}...);
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
    return boost::hana::unpack(parts_, [&](auto const&... f) {
      return slant::block(slant::block_row(f.get().slant(y))...);
    });
  }
  template <class Y, class W>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return slant::block(slant::block_row(
          slant::slant_from_value(part<I>(), y, boost::hana::at_c<I>(w).inner))...);
    }(std::index_sequence_for<F...>{});
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i, index) {
      slant::update_slant(f, y, g.template block<i(), 0>(), boost::hana::at_c<i()>(w).inner);
    });
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i, index) {
      slant::update_slant_after_value(f, y, g.template block<i(), 0>(),
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
