// SPDX-License-Identifier: MIT
//
// The adjoint of an operator as an operator. Closure: Aᵀ keeps every law of A
// (‖2A − I‖ ≤ 1, which is firm nonexpansiveness, is the same for Aᵀ).
#pragma once

#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// y = Aᵀ x. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class adjoint_operator {
  using part = std::remove_cvref_t<A>;

 public:
  static constexpr law_set laws = laws_of<A>;

  explicit adjoint_operator(held<A> a) : a_(std::move(a)) {}

  [[nodiscard]] index rows() const { return a_.get().cols(); }
  [[nodiscard]] index cols() const { return a_.get().rows(); }

  template <class X>
    requires has_adjoint<part, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return slant::adjoint_workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires detail::applies_adjoint<part, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(a_.get(), x, y, w);
  }
  template <class X, class Y, class W>
    requires detail::accumulates_adjoint<part, X, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint_add(a_.get(), α, x, y, w);
  }

  template <class X>
    requires linear_operator<part, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return slant::workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires detail::applies<part, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply(a_.get(), x, y, w);
  }
  template <class X, class Y, class W>
    requires detail::accumulates<part, X, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::apply_add(a_.get(), α, x, y, w);
  }

  template <class D>
    requires has_diagonal<part, D>
  void diagonal(D& d) const {
    a_.get().diagonal(d);
  }
  /// Rows of A, by applying Aᵀ to unit vectors.
  template <class Y>
    requires has_adjoint<part, plain_t<Y>>
  void columns(index first, Y& y) const {
    slant::apply_adjoint(a_.get(), detail::unit_columns(y, cols(), first), y);
  }
  [[nodiscard]] auto inverse() const
    requires detail::knows_its_inverse<part>
  {
    using inverse_part = std::remove_cvref_t<decltype(a_.get().inverse())>;
    return adjoint_operator<inverse_part>{held<inverse_part>(a_.get().inverse())};
  }

 private:
  held<A> a_;
};

/// Aᵀ; of an operator that knows its adjoint, such as an expression, what it says.
template <adjoint_operand A>
[[nodiscard]] auto adjoint(A&& a) {
  if constexpr (!eigen_matrix<A> && requires { a.adjoint(); }) {
    return a.adjoint();
  } else {
    return adjoint_operator<part_t<A>>{held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
  }
}

}  // namespace slant
