// SPDX-License-Identifier: MIT
//
// F°(y) of a composition: its parts by value, where they can be renewed, and a rule that makes the
// operator out of references to them.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- forwarding operator -------------------------------------------------------------------------
//
// Base of the operators F°(y): everything is passed on to derived.underlying(), which is either a
// reference to an operator or a composition of references made for the one call (it costs a few
// pointers). So all parts of F°(y) stay accessible and can be renewed in place, while applying them
// is left to slant/operators.

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

// --- assembled operator --------------------------------------------------------------------------

/// Rule is a function object: rule(parts…) → an operator that refers to the parts.
template <class Rule, class... Parts>
class assembled_operator : public forwarding_operator<assembled_operator<Rule, Parts...>> {
  using made = std::invoke_result_t<Rule const&, Parts const&...>;

 public:
  static constexpr law_set laws = laws_of<made>;

  explicit assembled_operator(Rule rule, Parts... parts)
      : rule_(std::move(rule)), parts_(std::move(parts)...) {}

  [[nodiscard]] made underlying() const { return std::apply(rule_, parts_); }

  [[nodiscard]] Rule const& rule() const noexcept { return rule_; }
  [[nodiscard]] Rule& rule() noexcept { return rule_; }
  template <std::size_t I>
  [[nodiscard]] auto const& part() const noexcept {
    return std::get<I>(parts_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& part() noexcept {
    return std::get<I>(parts_);
  }

 private:
  [[no_unique_address]] Rule rule_;
  std::tuple<Parts...> parts_;
};

/// A copyable, assignable reference to an operator that lives in the slanting function.
template <class A>
class operator_view : public forwarding_operator<operator_view<A>> {
 public:
  static constexpr law_set laws = laws_of<A>;

  explicit operator_view(A const& a) noexcept : pointer_(&a) {}

  [[nodiscard]] A const& underlying() const noexcept { return *pointer_; }

 private:
  A const* pointer_;
};

// --- derivative ----------------------------------------------------------------------------------
//
// Derivatives that come as Eigen matrices, wrapped without looking at their entries: a NaN that
// shows up in an iteration is not bad input, it is for the method to report.

/// The operator itself, or an operator with the asserted laws that owns the matrix.
template <law_set L, operand D>
[[nodiscard]] auto derivative_operator(D&& d) {
  if constexpr (eigen_matrix<D>) {
    using matrix_type = typename std::remove_cvref_t<D>::PlainObject;
    return matrix_operator<matrix_type, L>(held<matrix_type>(matrix_type(std::forward<D>(d))));
  } else {
    return std::remove_cvref_t<D>(std::forward<D>(d));
  }
}

}  // namespace slant::detail
