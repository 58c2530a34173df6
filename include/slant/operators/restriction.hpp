// SPDX-License-Identifier: MIT
//
// Restriction to some of the components: R gathers, Rᵀ scatters, R Rᵀ = I.
//
//     auto R = slant::restriction(n, {1, 4, 5});     // y = (x₁, x₄, x₅)
//     auto A_FF = slant::restricted(A, free);        // R A Rᵀ, keeps definiteness
//     A_FF.assign(other);                            // no allocation up to the reserved capacity
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/as_operator.hpp>
#include <slant/operators/congruence.hpp>
#include <slant/operators/detail/closure.hpp>
#include <slant/operators/detail/component_list.hpp>

#include <initializer_list>
#include <utility>

namespace slant {

/// y = R x: y_i = x_{c_i} for the components c.
class restriction : public detail::component_list {
 public:
  /// Throws bad_input unless the components are different numbers in [0, n). Room is reserved for
  /// n components, so that assign never allocates.
  template <class Components>
  restriction(index n, Components const& components) : component_list(n) {
    assign(components);
  }
  restriction(index n, std::initializer_list<index> components) : component_list(n) {
    assign(components);
  }

  [[nodiscard]] index rows() const noexcept { return size(); }
  [[nodiscard]] index cols() const noexcept { return full_size(); }

  template <has_local X, class Y>
  void apply(X const& x, Y& y) const {
    each(x, y, [](auto const& from, auto& to) { to = from; });
  }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    each(x, y, [&](auto const& from, auto& to) { to += α * from; });
  }
  template <has_local X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    vectors::set_zero(y);
    each(y, x, [](auto& to, auto const& from) { to = from; });
  }
  template <has_local X, class Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y) const {
    each(y, x, [&](auto& to, auto const& from) { to += α * from; });
  }

 private:
  /// f(full component c_i, short component i) for all i and all right-hand sides.
  template <class Full, class Short, class F>
  void each(Full& full, Short& shorter, F f) const {
    auto&& a = slant::local(full);
    auto&& b = slant::local(shorter);
    for (index j = 0; j < a.cols(); ++j) {
      for (index i = 0; i < size(); ++i) f(entry(a, component(i), j), entry(b, i, j));
    }
  }
  template <class M>
  static decltype(auto) entry(M& m, index i, index j) {
    if constexpr (std::is_const_v<M>) {
      return m.coeff(i, j);
    } else {
      return m.coeffRef(i, j);
    }
  }
};

/// y = R A Rᵀ x: the congruence with R, whose components may change, and which knows its diagonal
/// and columns. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class restricted_operator {
  using part = std::remove_cvref_t<A>;
  using congruence_type = congruence_operator<restriction const&, part const&, true>;

 public:
  static constexpr law_set laws = detail::restricted_laws(laws_of<A>);

  /// A is square of size r.cols(); slant::restricted checks it.
  restricted_operator(held<A> a, restriction r) : a_(std::move(a)), r_(std::move(r)) {}

  [[nodiscard]] index rows() const noexcept { return r_.rows(); }
  [[nodiscard]] index cols() const noexcept { return r_.rows(); }
  /// R.
  [[nodiscard]] restriction const& components() const noexcept { return r_; }
  /// Other components from now on; as restriction::assign. Workspaces stay valid.
  template <class Components>
  void assign(Components const& components) {
    r_.assign(components);
  }

  template <class X>
    requires linear_operator<part, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return congruence().workspace(x);
  }
  template <class X, class Y, class W>
    requires linear_operator<part, plain_t<X>>
  void apply(X const& x, Y& y, W& w) const {
    congruence().apply(x, y, w);
  }
  template <class X, class Y, class W>
    requires linear_operator<part, plain_t<X>>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    congruence().apply_add(α, x, y, w);
  }

  template <class X>
    requires has_adjoint<part, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return congruence().adjoint_workspace(x);
  }
  template <class X, class Y, class W>
    requires has_adjoint<part, plain_t<X>>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    congruence().apply_adjoint(x, y, w);
  }
  template <class X, class Y, class W>
    requires has_adjoint<part, plain_t<X>>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    congruence().apply_adjoint_add(α, x, y, w);
  }

  template <class D>
    requires has_diagonal<part, plain_t<D>>
  void diagonal(D& d) const {
    auto full = slant::like(d, r_.cols());
    a_.get().diagonal(full);
    r_.apply(full, d);
  }
  template <class Y>
    requires has_columns<part, plain_t<Y>>
  void columns(index first, Y& y) const {
    plain_t<Y> full(r_.cols(), 1);
    for (index j = 0; j < y.cols(); ++j) {
      a_.get().columns(r_.component(first + j), full);
      auto column = y.middleCols(j, 1);
      r_.apply(full, column);
    }
  }

 private:
  [[nodiscard]] congruence_type congruence() const { return {r_, a_.get()}; }

  held<A> a_;
  restriction r_;
};

/// R A Rᵀ for the given components. Throws bad_input if A is not square, or as restriction does.
template <operand A, class Components>
[[nodiscard]] auto restricted(A&& a, Components const& components) {
  held<part_t<A>> part{slant::as_operator(std::forward<A>(a))};
  detail::require_square("A", part.get());
  restriction r(part.get().rows(), components);
  return restricted_operator<part_t<A>>{std::move(part), std::move(r)};
}

}  // namespace slant
