// SPDX-License-Identifier: MIT
//
// ‖d‖_{A⁻¹} = √(dᵀA⁻¹d) for an operator A of which only the action is known, by preconditioned
// conjugate gradients for A y = d from zero:
//
//     ‖y‖_A² = Σ αₖ rₖᵀM rₖ  ≤  ‖d‖²_{A⁻¹}  ≤  (‖y‖_A + ‖r‖_{A⁻¹})²,       r = d − A y,  y ⊥_A r's
//     error
//
// Every step adds a positive term, so the sum is a lower bound at any time. With M ⪰ A⁻¹ the
// remainder is at most √(rᵀM r) and the result an upper bound, up to the rounding of A y. Otherwise
// it is an estimate: the terms of the last steps stand for the remainder [Strakoš, Tichý 2002].
//
// Cost: one application of A and one of M a step, until the remainder is a tenth or the limit is
// met.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/unit.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace slant {

/// Temporaries of dual_norm for vectors like `prototype` and a preconditioner m.
template <class V, class M>
struct dual_norm_workspace {
  V r, z, p, image;
  workspace_t<M, V> of_m;

  dual_norm_workspace(M const& m, V const& prototype)
      : r(prototype), z(prototype), p(prototype), image(prototype), of_m(workspace(m, prototype)) {}
};

/// Result of dual_norm.
template <class S>
struct dual_norm_result {
  S value;             ///< of ‖d‖_{A⁻¹}
  index applications;  ///< of A
};

/// ‖d‖_{A⁻¹} in at most `most` steps. `dominates`: M ⪰ A⁻¹. `enough`, if positive: ends as soon as
/// the value is known to be below or, since it only grows, above. NaN where A or M is not definite
/// on what d needs.
template <class A, class M, class V, class WA>
[[nodiscard]] auto dual_norm(A const& a, M const& m, V const& d, index most, bool dominates,
                             WA& of_a, dual_norm_workspace<V, M>& w,
                             scalar_t<V> const& enough = scalar_t<V>(0))
    -> dual_norm_result<scalar_t<V>> {
  using S = scalar_t<V>;
  using std::sqrt;
  S const unit = unit_near(slant::norm(d));
  slant::local(w.r) = slant::local(d) / unit;
  slant::apply(m, w.r, w.z, w.of_m);
  slant::local(w.p) = slant::local(w.z);
  S rz = slant::inner_product(w.r, w.z), energy(0), recent(0);
  index k = 0;
  while (k < most && rz > S(0)) {
    slant::apply(a, w.p, w.image, of_a);
    ++k;
    S const bend = slant::inner_product(w.p, w.image);
    if (!(bend > S(0))) return {std::numeric_limits<S>::infinity(), k};  // no bound from here
    S const α = rz / bend, term = α * rz;
    energy += term;
    recent = recent / S(2) + term;
    slant::local(w.r) -= α * slant::local(w.image);
    slant::apply(m, w.r, w.z, w.of_m);
    S const next = slant::inner_product(w.r, w.z);
    slant::local(w.p) = (next / rz) * slant::local(w.p) + slant::local(w.z);
    rz = next;
    if (enough > S(0) && dominates) {
      S const limit = enough / unit, least = sqrt(energy);
      if (least > limit || least + sqrt(rz > S(0) ? rz : S(0)) <= limit) break;
    }
    if (dominates ? S(100) * rz < energy : k > 4 && S(100) * recent < energy) break;
  }
  // M vanishes along what is left of d, or is not semidefinite: nothing is known of it.
  if (!(rz > S(0)) && slant::norm(w.r) > S(0)) return {std::numeric_limits<S>::infinity(), k};
  S const rest = dominates ? rz : recent;
  return {unit * (sqrt(energy) + (rest > S(0) ? S(sqrt(rest)) : S(0))), k};
}

}  // namespace slant
