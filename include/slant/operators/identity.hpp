// SPDX-License-Identifier: MIT
//
// The identity on n unknowns, for every vector type and scalar.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>

#include <string>

namespace slant {

/// y = x.
class identity_operator {
 public:
  static constexpr char const* symbol = "I";
  static constexpr law_set laws =
      slant::laws<slant::self_adjoint, slant::positive_definite, slant::projector>;

  explicit identity_operator(index n) : n_(n) {
    if (n < 0) throw bad_input("n", std::to_string(n), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return n_; }
  [[nodiscard]] index cols() const noexcept { return n_; }

  void apply(has_local auto const& x, auto& y) const { vectors::copy(x, y); }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    vectors::axpy(α, x, y);
  }
  template <has_local D>
  void diagonal(D& d) const {
    vectors::fill(scalar_t<D>(1), d);
  }
  template <has_local Y>
  void columns(index first, Y& y) const {
    vectors::set_zero(y);
    for (index j = 0; j < slant::local(y).cols(); ++j) {
      slant::local(y)(first + j, j) = scalar_t<Y>(1);
    }
  }
  [[nodiscard]] identity_operator inverse() const noexcept { return *this; }

 private:
  index n_;
};

/// The identity on vectors with n components.
[[nodiscard]] inline identity_operator identity(index n) {
  return identity_operator(n);
}

/// y = 0; as a block of block() it is skipped at compile time and costs nothing. Square says
/// whether the type promises as many rows as columns, and the laws of 0.
template <bool Square>
class zero_operator {
 public:
  static constexpr char const* symbol = "0";
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::projector>.when(Square);

  zero_operator(index rows, index cols) : rows_(rows), cols_(cols) {
    if (rows < 0) throw bad_input("rows", detail::show(rows), "a size >= 0");
    if (cols < 0) throw bad_input("cols", detail::show(cols), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return rows_; }
  [[nodiscard]] index cols() const noexcept { return cols_; }

  void apply(has_local auto const&, auto& y) const { vectors::set_zero(y); }
  template <has_local X, class Y>
  void apply_add(scalar_t<X>, X const&, Y&) const {}
  void apply_adjoint(has_local auto const&, auto& y) const { vectors::set_zero(y); }
  template <has_local X, class Y>
  void apply_adjoint_add(scalar_t<X>, X const&, Y&) const {}
  void diagonal(has_local auto& d) const { vectors::set_zero(d); }
  void columns(index, has_local auto& y) const { vectors::set_zero(y); }

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
