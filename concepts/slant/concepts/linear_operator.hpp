// SPDX-License-Identifier: MIT
//
// Linear operators: y = A x, and nothing else unless said.
//
// Intuition. An operator is two sizes and one function. It overwrites its result, never reads it,
// and never aliases it with its argument. It is const: two threads may apply it at the same time.
//
// Sizes. x has cols() entries and y has rows(), on entry too: no operator resizes y. slant::apply
// and its relatives (capabilities.hpp) check that; a member apply may rely on it.
//
// Minimal definition.
//     rows(), cols()     sizes (of the local parts, if vectors are distributed)
//     apply(x, y)        y = A x                                             (a leaf), or
//     workspace(x)       a copyable value that holds all temporaries for arguments like x, and
//     apply(x, y, w)     y = A x with those temporaries                      (a composition)
//
// Laws.   A(αx + βy) = αAx + βAy,   apply into a y full of NaN gives the same as into zeros,
//         plus what the type declares (laws.hpp).
//
// Models. everything in slant/operators, slant::testing::archetype::linear_operator.
//
// Why a workspace and not a mutable member: const would be a lie between threads. Why not let
// apply return a vector: it would allocate in every iteration. Why copyable: the states of methods
// hold workspaces, and a state is saved by copying it.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>

namespace slant {

template <class A>
concept has_rows = requires(A const& a) {
  { a.rows() } -> std::convertible_to<index>;
};

template <class A>
concept has_cols = requires(A const& a) {
  { a.cols() } -> std::convertible_to<index>;
};

template <class A, class V>
concept has_workspace = requires(A const& a, V const& x) { a.workspace(x); };

/// The workspace of everything that needs none.
struct no_workspace {};

namespace detail {

struct workspace_fn {
  template <class A, class X>
  [[nodiscard]] auto operator()(A const& a, X const& x) const {
    if constexpr (has_workspace<A, X>) {
      return a.workspace(x);
    } else {
      return no_workspace{};
    }
  }
};

}  // namespace detail

/// All temporaries that apply(a, x, ·) needs for arguments like x; allocate once, use often.
inline constexpr detail::workspace_fn workspace{};

template <class A, class V>
using workspace_t = decltype(slant::workspace(std::declval<A const&>(), std::declval<V const&>()));

template <class A, class V>
concept has_plain_apply = requires(A const& a, V const& x, V& y) { a.apply(x, y); };

/// A workspace is a value. (What it holds between two applications need not be copied.)
template <class A, class V> concept has_copyable_workspace = std::copyable<workspace_t<A, V>>;

template <class A, class V>
concept has_workspace_apply =
    requires(A const& a, V const& x, V& y, workspace_t<A, V>& w) { a.apply(x, y, w); };

namespace detail {

/// Throws bad_input unless x and y have the sizes of A x = y.
void check_operands(auto const& a, auto const& x, auto const& y) {
  check_rows("x", x, index(a.cols()), "cols() of the operator");
  check_rows("y", y, index(a.rows()), "rows() of the operator");
  check_same_columns("y", y, x, "one for each column of x");
}

struct apply_fn {
  template <class A, class X, class Y, class W>
  void operator()(A const& a, X const& x, Y& y, W& w) const {
    check_operands(a, x, y);
    if constexpr (requires { a.apply(x, y, w); }) {
      a.apply(x, y, w);
    } else {
      a.apply(x, y);
    }
  }
  /// Without a workspace: one is made and thrown away. For set-up and tests, not for loops.
  template <class A, class X, class Y>
  void operator()(A const& a, X const& x, Y& y) const {
    with_own_workspace(a, x, y);
  }

 private:
  // Inlined into a loop, g++ 12 warns of a use after free: Eigen's resize is not exception safe.
  template <class A, class X, class Y>
  [[gnu::noinline]] void with_own_workspace(A const& a, X const& x, Y& y) const {
    auto w = slant::workspace(a, x);
    (*this)(a, x, y, w);
  }
};

}  // namespace detail

/// y = A x. y is overwritten and must not alias x.
/// Throws bad_input if x has not cols() rows, or y not rows().
inline constexpr detail::apply_fn apply{};

/// An operator on vectors of type V (or on matrices of several right-hand sides, V = MatrixXd).
template <class A, class V>
concept linear_operator = has_rows<A> && has_cols<A> && has_copyable_workspace<A, V> &&
                          (has_plain_apply<A, V> || has_workspace_apply<A, V>);

/// ⟨A x, y⟩ = ⟨x, A y⟩ is promised.
template <class A, class V>
concept self_adjoint_operator = linear_operator<A, V> && declares_self_adjoint<A>;

/// Symmetric positive semidefinite: ½xᵀAx is convex. What minimisation methods ask for.
template <class A, class V>
concept psd_operator = self_adjoint_operator<A, V> && declares_positive_semidefinite<A>;

/// Symmetric positive definite. What conjugate gradients ask for.
template <class A, class V>
concept spd_operator = psd_operator<A, V> && declares_positive_definite<A>;

}  // namespace slant
