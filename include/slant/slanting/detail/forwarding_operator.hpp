// SPDX-License-Identifier: MIT
//
// Base of the operators F°(y): everything is passed on to derived.underlying(), which is either a
// reference to an operator or a composition of references made for the one call (it costs a few
// pointers). So all parts of F°(y) stay accessible and can be renewed in place, while applying them
// is left to slant/operators.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/operators/detail/applicable.hpp>

#include <type_traits>

namespace slant::detail {

/// Derived has underlying() const and declares its own laws.
template <class Derived>
class forwarding_operator {
  template <class D>
  using underlying_t = std::remove_cvref_t<decltype(std::declval<D const&>().underlying())>;

 public:
  [[nodiscard]] index rows() const { return self().underlying().rows(); }
  [[nodiscard]] index cols() const { return self().underlying().cols(); }

  template <class X, class D = Derived>
    requires linear_operator<underlying_t<D>, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return slant::workspace(self().underlying(), x);
  }
  template <class X, class Y, class W, class D = Derived>
    requires applies<underlying_t<D>, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(self().underlying(), x, y, w);
  }
  template <class X, class Y, class W, class D = Derived>
    requires accumulates<underlying_t<D>, X, Y>
  void apply_add(scalar_t<X> const& α, X const& x, Y& y, W& w) const {
    slant::apply_add(self().underlying(), α, x, y, w);
  }

  /// What a slice shows of x.
  template <class X, class D = Derived>
    requires shows_segment<underlying_t<D>, X>
  [[nodiscard]] auto segment(X const& x) const {
    return self().underlying().segment(x);
  }

  template <class X, class D = Derived>
    requires has_adjoint<underlying_t<D>, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return slant::adjoint_workspace(self().underlying(), x);
  }
  template <class X, class Y, class W, class D = Derived>
    requires applies_adjoint<underlying_t<D>, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    slant::apply_adjoint(self().underlying(), x, y, w);
  }
  template <class X, class Y, class W, class D = Derived>
    requires accumulates_adjoint<underlying_t<D>, X, Y>
  void apply_adjoint_add(scalar_t<X> const& α, X const& x, Y& y, W& w) const {
    slant::apply_adjoint_add(self().underlying(), α, x, y, w);
  }

  template <class Y, class D = Derived>
    requires has_diagonal<underlying_t<D>, Y>
  void diagonal(Y& d) const {
    self().underlying().diagonal(d);
  }
  template <class Y, class D = Derived>
    requires has_columns<underlying_t<D>, Y>
  void columns(index first, Y& y) const {
    self().underlying().columns(first, y);
  }

 private:
  [[nodiscard]] Derived const& self() const { return static_cast<Derived const&>(*this); }
};

}  // namespace slant::detail
