// SPDX-License-Identifier: MIT
//
// A safe step of the gradient method x ← P_Λ(x − α r). Every α ∈ (0, 2/σ_max) decreases
// q(x) = ½ xᵀA x − bᵀx. I − α A contracts best with α = 2/(σ_max + σ_min); steps close to 2/σ_max
// are better still where A is ill-conditioned, for few components of r belong to its largest
// eigenvalues.
#pragma once

#include <slant/krylov/spectral_bound.hpp>

#include <algorithm>

namespace slant {

/// Result of safe_gradient_step.
template <class S>
struct gradient_step {
  S length;            ///< α
  S σ;                 ///< σ_max to a few digits, from below
  index applications;  ///< products spent
};

/// α = min(factor, 2/(1 + θ_min/θ_max)) / (upper bound of σ_max), θ the extreme Ritz values.
/// 1 if A = 0. Throws bad_input if 1/σ_max is not a finite number > 0, or as the bound does.
template <class A, class V>
[[nodiscard]] auto safe_gradient_step(A const& a, V const& prototype, scalar_t<V> factor,
                                      spectral_bound_options const& options = {})
    -> gradient_step<scalar_t<V>> {
  using S = scalar_t<V>;
  auto const bound = largest_eigenvalue_bound(a, prototype, options);
  if (bound.upper == S(0)) return {S(1), S(0), bound.applications};
  S const best = S(2) / (S(1) + bound.smallest_ritz / bound.ritz);
  S const length = std::min<S>(factor, best) / bound.upper;
  if (!(length > S(0)) || !detail::is_finite(length)) {
    throw bad_input("A", "largest eigenvalue " + detail::show(bound.upper),
                    "one whose reciprocal is a finite number > 0");
  }
  return {length, bound.ritz, bound.applications};
}

}  // namespace slant
