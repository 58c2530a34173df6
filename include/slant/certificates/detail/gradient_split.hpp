// SPDX-License-Identifier: MIT
//
// What the certificates that take a Newton step share: how the gradient behind the step is split
// into a part that Λ balances and a rest, and sizes of A⁻¹.
#pragma once

#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/unit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::detail {

/// √(xᵀy) for a product that is ≥ 0 but for rounding.
template <class V>
[[nodiscard]] auto root_of_product(V const& x, V const& y) {
  using S = scalar_t<V>;
  using std::sqrt;
  S const ux = unit_near(slant::norm(x)), uy = unit_near(slant::norm(y));
  S const product = (slant::local(x) / ux).dot(slant::local(y) / uy);
  if (!(product > S(0))) return product == product ? S(0) : product;
  return S(S(sqrt(product)) * S(sqrt(ux)) * S(sqrt(uy)));
}

/// What rounding the entries of x is worth in the energy norm, of which g knows nothing.
template <class V>
[[nodiscard]] auto rounding_of(V const& x, V const& stiffness) {
  using S = scalar_t<V>;
  S sum(0);
  S const unit = unit_near(slant::norm(x));
  for (index i = 0; i < slant::local(x).size(); ++i) {
    S const entry = slant::local(x).coeff(i) / unit;
    sum += entry * entry / slant::local(stiffness).coeff(i);
  }
  using std::sqrt;
  return S(unit * (std::numeric_limits<S>::epsilon() / S(2)) * S(sqrt(sum)));
}

/// 1/diag A if A gives it or, with `probe`, has no more than 64 rows, else `typical`, the size of
/// A⁻¹. x and g are scratch. Returns the applications of A.
template <bool probe, class A, class V, class W>
index set_stiffness(A const& a, scalar_t<V> const& typical, V& stiffness, V& x, V& g, W& w) {
  using S = scalar_t<V>;
  auto const invert = [&] {
    for (index i = 0; i < slant::local(stiffness).size(); ++i) {
      auto& entry = slant::local(stiffness).coeffRef(i);
      entry = entry > S(0) ? S(S(1) / entry) : typical;
    }
  };
  vectors::fill(typical, stiffness);
  if (slant::diagonal_if_known(a, stiffness)) {
    invert();
    return 0;
  }
  if constexpr (probe) {
    index const n = slant::local(stiffness).size();
    if (!slant::everywhere(stiffness, n == slant::global_size(stiffness) && n <= 64)) return 0;
    for (index i = 0; i < n; ++i) {
      vectors::set_zero(x);
      slant::local(x).coeffRef(i) = S(1);
      slant::apply(a, x, g, w);
      slant::local(stiffness).coeffRef(i) = slant::local(g).coeff(i);
    }
    invert();
    return n;
  }
  return 0;
}

/// How a bound is put together: δ = √(moved² + missing²) + ‖rest‖_{A⁻¹}, γ, and what comes on
/// top.
template <class S>
struct bound_split {
  S bound = std::numeric_limits<S>::infinity();
  S moved{0}, root_of_gap{0}, above{0};
};

/// Splits the gradient at the end of a Newton step, `balanced`, into s and `rest` for x; curved
/// blocks with a part of the gradient or by the gap alone. What the diagonal of A says is less
/// becomes `best`. `moved` and `bend`, ‖·‖_A and ‖·‖_{C/ρ} of the step; `remainder`: what of it is
/// missing on the face, and counted elsewhere. m and d are scratch.
template <class Set, class Face, class V>
void consider_split(bound_split<scalar_t<V>>& best, Set const& set, Face const& face, V const& x,
                    V const& balanced, V const& remainder, V const& stiffness,
                    scalar_t<V> const& moved, scalar_t<V> const& bend, scalar_t<V> const& above,
                    V& rest, V& m, V& d) {
  using S = scalar_t<V>;
  using std::sqrt;
  S const bent = bend / S(sqrt(S(2)));
  for (S const factor : {S(1), S(0x1p27)}) {
    vectors::copy(stiffness, m);
    face.curved_components([&](index i) { slant::local(m).coeffRef(i) *= factor; });
    auto const split = balance(set, x, balanced, m, d);
    vectors::subtract(remainder, d);
    S const root = split.root_of_gap > bent ? split.root_of_gap : bent;
    vectors::multiply(stiffness, d, m);
    S const bound = error_bound_of_root<S>(moved + root_of_product(d, m), root) + above;
    // A gap that is NaN may have lost the comparison.
    if (!(bound < best.bound) || !is_finite(split.root_of_gap)) continue;
    best = {bound, moved, root, above};
    vectors::copy(d, rest);
  }
}

}  // namespace slant::detail
