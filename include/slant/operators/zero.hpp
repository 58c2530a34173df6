// SPDX-License-Identifier: MIT
//
// The zero operator. As a block of block() it is skipped at compile time and costs nothing.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/detail/checks.hpp>

#include <type_traits>

namespace slant {

/// y = 0. Square says whether the type promises as many rows as columns, and the laws of 0.
template <bool Square>
class zero_operator {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::projector>.when(Square);

  zero_operator(index rows, index cols) : rows_(rows), cols_(cols) {
    if (rows < 0) throw bad_input("rows", detail::show(rows), "a size >= 0");
    if (cols < 0) throw bad_input("cols", detail::show(cols), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return rows_; }
  [[nodiscard]] index cols() const noexcept { return cols_; }

  template <has_local X, class Y>
  void apply(X const&, Y& y) const {
    vectors::set_zero(y);
  }
  template <has_local X, class Y>
  void apply_add(scalar_t<X>, X const&, Y&) const {}
  template <has_local X, class Y>
  void apply_adjoint(X const&, Y& y) const {
    vectors::set_zero(y);
  }
  template <has_local X, class Y>
  void apply_adjoint_add(scalar_t<X>, X const&, Y&) const {}
  template <has_local D>
  void diagonal(D& d) const {
    vectors::set_zero(d);
  }
  template <has_local Y>
  void columns(index, Y& y) const {
    vectors::set_zero(y);
  }

 private:
  index rows_;
  index cols_;
};

/// The zero operator on n unknowns.
[[nodiscard]] inline zero_operator<true> zero(index n) {
  return {n, n};
}
/// The rows × cols zero operator.
[[nodiscard]] inline zero_operator<false> zero(index rows, index cols) {
  return {rows, cols};
}

namespace detail {

template <class A>
inline constexpr bool is_zero_operator = false;
template <bool Square>
inline constexpr bool is_zero_operator<zero_operator<Square>> = true;

}  // namespace detail

}  // namespace slant
