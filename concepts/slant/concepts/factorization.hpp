// SPDX-License-Identifier: MIT
//
// Factorisations: something that solves with a matrix it has taken apart.
//
// Intuition. Factor once, solve often. `inverse(factorization)` turns it into an operator.
//
// Minimal definition. rows(), and solve(b, x): x = A⁻¹ b, x overwritten, not aliasing b; or
// workspace(b), which can be copied, and solve(b, x, w). b and x have rows() rows, also on entry:
// no factorisation resizes x. A nonsymmetric one may add solve_adjoint(b, x).
// `laws` are those of the factored matrix.
//
// Laws.   A solve(b) = b up to κ(A) ε.
//
// Models. slant::ldlt (sparse, Eigen), slant::cholmod, slant::dense_ldlt.
//
// A singular or indefinite matrix is bad input of the constructor (named with the pivot where it
// showed), so an object of this type can always solve.
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant {

template <class F, class V>
concept has_plain_solve = requires(F const& f, V const& b, V& x) { f.solve(b, x); };

template <class F, class V>
concept has_workspace_solve =
    requires(F const& f, V const& b, V& x, workspace_t<F, V>& w) { f.solve(b, x, w); };

/// x = A⁻¹ b for vectors of type V; see the top of this file.
template <class F, class V>
concept factorization = has_rows<F> && has_copyable_workspace<F, V> &&
                        (has_plain_solve<F, V> || has_workspace_solve<F, V>);

namespace detail {

/// x = A⁻¹ b with w made by workspace(f, b), whether f needs it or not.
template <class F, class B, class X, class W>
void solve_with(F const& f, B const& b, X& x, W& w) {
  if constexpr (requires { f.solve(b, x, w); }) {
    f.solve(b, x, w);
  } else {
    f.solve(b, x);
  }
}

}  // namespace detail

}  // namespace slant
