// SPDX-License-Identifier: MIT
//
// Capabilities: what some operators can do besides y = A x. Each is a concept of its own, and an
// operator that cannot do a thing does not have the member; none exists only to throw.
//
//   has_adjoint             apply_adjoint(x, y[, w])         y = Aᵀx (free if self-adjoint)
//   has_accumulate          apply_add(α, x, y[, w])          y ← y + α A x; saves a temporary
//   has_adjoint_accumulate  apply_adjoint_add(α, x, y[, w])  y ← y + α Aᵀx
//   has_diagonal            diagonal(d)                      d = diag(A), d has rows() entries
//   has_columns             columns(first, Y)                Y = A(:, first : first + Y.cols())
//   has_inverse             inverse()                        an operator B with B A = I
//   applies_to_many         apply(X, Y[, w]) on matrices: several right-hand sides at once
//
// Laws.   ⟨A x, y⟩ = ⟨x, Aᵀy⟩,   apply_add(α, x, y) = y + α A x,   diagonal_i = ⟨A e_i, e_i⟩,
//         columns(j)_k = A e_{j+k},   inverse()(A x) = x,   A [x₁ … x_k] = [A x₁ … A x_k].
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant {

template <class A, class V>
concept has_adjoint_workspace = requires(A const& a, V const& x) { a.adjoint_workspace(x); };

template <class A>
inline constexpr bool is_self_adjoint = laws_of<A>.contains(law::self_adjoint);

namespace detail {

struct adjoint_workspace_fn {
  template <class A, class X>
  [[nodiscard]] auto operator()(A const& a, X const& x) const {
    if constexpr (has_adjoint_workspace<A, X>) {
      return a.adjoint_workspace(x);
    } else if constexpr (is_self_adjoint<A>) {
      return slant::workspace(a, x);
    } else {
      return no_workspace{};
    }
  }
};

}  // namespace detail

/// All temporaries that apply_adjoint(a, x, ·) needs for arguments like x.
inline constexpr detail::adjoint_workspace_fn adjoint_workspace{};

template <class A, class V>
using adjoint_workspace_t =
    decltype(slant::adjoint_workspace(std::declval<A const&>(), std::declval<V const&>()));

template <class A, class V>
concept has_plain_adjoint = requires(A const& a, V const& x, V& y) { a.apply_adjoint(x, y); };

template <class A, class V>
concept has_workspace_adjoint = requires(
    A const& a, V const& x, V& y, adjoint_workspace_t<A, V>& w) { a.apply_adjoint(x, y, w); };

/// y = Aᵀ x is available.
template <class A, class V>
concept has_adjoint =
    has_plain_adjoint<A, V> || has_workspace_adjoint<A, V> || self_adjoint_operator<A, V>;

namespace detail {

/// Throws bad_input unless x and y have the sizes of Aᵀx = y.
void check_adjoint_operands(auto const& a, auto const& x, auto const& y) {
  check_rows("x", x, index(a.rows()), "rows() of the operator, as the adjoint is applied");
  check_rows("y", y, index(a.cols()), "cols() of the operator, as the adjoint is applied");
  check_same_columns("y", y, x, "one for each column of x");
}

struct apply_adjoint_fn {
  template <class A, class X, class Y, class W>
  void operator()(A const& a, X const& x, Y& y, W& w) const {
    check_adjoint_operands(a, x, y);
    if constexpr (requires { a.apply_adjoint(x, y, w); }) {
      a.apply_adjoint(x, y, w);
    } else if constexpr (requires { a.apply_adjoint(x, y); }) {
      a.apply_adjoint(x, y);
    } else {
      static_assert(is_self_adjoint<A>, "this operator has no apply_adjoint(x, y)");
      slant::apply(a, x, y, w);
    }
  }
  template <class A, class X, class Y>
  void operator()(A const& a, X const& x, Y& y) const {
    auto w = slant::adjoint_workspace(a, x);
    (*this)(a, x, y, w);
  }
};

}  // namespace detail

/// y = Aᵀ x. y is overwritten and must not alias x.
/// Throws bad_input if x has not rows() rows, or y not cols().
inline constexpr detail::apply_adjoint_fn apply_adjoint{};

namespace detail {

/// slant::apply_add(a, α, x, y, w) works.
template <class A, class X, class Y>
concept accumulates = requires(A const& a, scalar_t<X> α, X const& x, Y& y) {
  a.apply_add(α, x, y);
} || requires(A const& a, scalar_t<X> α, X const& x, Y& y, workspace_t<A, plain_t<X>>& w) {
  a.apply_add(α, x, y, w);
};

/// slant::apply_adjoint_add(a, α, x, y, w) works.
template <class A, class X, class Y>
concept accumulates_adjoint = requires(A const& a, scalar_t<X> α, X const& x, Y& y) {
  a.apply_adjoint_add(α, x, y);
} || requires(A const& a, scalar_t<X> α, X const& x, Y& y, adjoint_workspace_t<A, plain_t<X>>& w) {
  a.apply_adjoint_add(α, x, y, w);
} || (is_self_adjoint<A> && !has_adjoint_workspace<A, plain_t<X>> && accumulates<A, X, Y>);

struct apply_add_fn {
  template <class A, class S, class X, class Y, class W>
  void operator()(A const& a, S α, X const& x, Y& y, W& w) const {
    check_operands(a, x, y);
    if constexpr (requires { a.apply_add(α, x, y, w); }) {
      a.apply_add(α, x, y, w);
    } else {
      a.apply_add(α, x, y);
    }
  }
};

struct apply_adjoint_add_fn {
  template <class A, class S, class X, class Y, class W>
  void operator()(A const& a, S α, X const& x, Y& y, W& w) const {
    check_adjoint_operands(a, x, y);
    if constexpr (requires { a.apply_adjoint_add(α, x, y, w); }) {
      a.apply_adjoint_add(α, x, y, w);
    } else if constexpr (requires { a.apply_adjoint_add(α, x, y); }) {
      a.apply_adjoint_add(α, x, y);
    } else {
      static_assert(is_self_adjoint<A>, "this operator has no apply_adjoint_add(α, x, y)");
      apply_add_fn{}(a, α, x, y, w);
    }
  }
};

}  // namespace detail

/// y ← y + α A x without a temporary of the caller's.
template <class A, class V> concept has_accumulate = detail::accumulates<A, V, V>;

/// y ← y + α A x. y must not alias x. Throws bad_input as apply does.
inline constexpr detail::apply_add_fn apply_add{};

/// y ← y + α Aᵀx without a temporary of the caller's.
template <class A, class V> concept has_adjoint_accumulate = detail::accumulates_adjoint<A, V, V>;

/// y ← y + α Aᵀx. y must not alias x. Throws bad_input as apply_adjoint does.
inline constexpr detail::apply_adjoint_add_fn apply_adjoint_add{};

/// d = diag(A). For set-up: it may allocate.
template <class A, class V> concept has_diagonal = requires(A const& a, V& d) { a.diagonal(d); };

/// Whether there is a diagonal is known at run time: diagonal_if_known(d) gives it and returns
/// true, or returns false. For operators that forget what they are made of.
template <class A, class V>
concept may_have_diagonal = has_diagonal<A, V> || requires(A const& a, V& d) {
  { a.diagonal_if_known(d) } -> std::same_as<bool>;
};

/// d = diag(A) where A gives it; whether it does. Without it d is as it was.
template <class A, class V>
[[nodiscard]] bool diagonal_if_known(A const& a, V& d) {
  if constexpr (has_diagonal<A, V>) {
    a.diagonal(d);
    return true;
  } else if constexpr (may_have_diagonal<A, V>) {
    return a.diagonal_if_known(d);
  } else {
    return false;
  }
}

/// Y = columns first … first + Y.cols() − 1 of A, for a dense matrix Y with rows() rows.
template <class A, class M>
concept has_columns = requires(A const& a, index first, M& y) { a.columns(first, y); };

/// The inverse is an operator too.
template <class A, class V>
concept has_inverse = requires(A const& a) {
  { a.inverse() } -> linear_operator<V>;
};

/// Several right-hand sides at once: the columns of a matrix M.
template <class A, class M> concept applies_to_many = linear_operator<A, M>;

// --- rounded -------------------------------------------------------------------------------------
//
// Operators that have a cheaper twin of lower precision.
//
// Intuition. An operator that is limited by the reading of its entries is applied in half the time
// if they are kept as floats. Inner iterations, whose result is a direction and not yet the
// solution, can work with that: whoever takes the step computes the residual with the operator
// itself.
//
// Minimal definition. rounded(): an operator of the same size, on the same vectors, with the same
// laws up to its precision. It owns what it needs; making it may take as long as an application.
//
// Law. ‖rounded(A) x − A x‖ is a few units of the lower precision times ‖A‖ ‖x‖, or times √κ(A)
// more where A is applied by its factors. Methods do not rely on it: they look at what comes out.
//
// Models. slant::condensed_operator<double>; slant::counted passes it on.

template <class A, class V>
concept has_rounded = requires(A const& a) {
  { a.rounded() } -> linear_operator<V>;
};

}  // namespace slant
