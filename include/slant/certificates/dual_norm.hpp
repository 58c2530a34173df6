// SPDX-License-Identifier: MIT
//
// ‖d‖_{A⁻¹} = √(dᵀA⁻¹d) for an operator A of which only the action is known, by preconditioned
// conjugate gradients for A y = d from zero:
//
//     ‖y‖_A² = Σ αₖ rₖᵀM rₖ  ≤  ‖d‖²_{A⁻¹}  ≤  (‖y‖_A + ‖r‖_{A⁻¹})²,   r = d − A y,  y ⊥_A A⁻¹r
//
// Every step adds a positive term, so the sum is a lower bound at any time. With M ⪰ A⁻¹ the
// remainder is at most √(rᵀM r) and the result an upper bound, up to the rounding of A y. Otherwise
// it is an estimate: the terms of the last steps stand for the remainder [Strakoš, Tichý 2002].
//
// Where A is only semidefinite, d belongs to the range of A up to rounding. What rounding leaves of
// d outside of it has no dual norm; it is known by the size of the numbers that d was computed
// from, see gradient_size, and by directions p along which A has no more curvature than rounding of
// A p.
//
// Cost: one application of A and one of M a step, until the remainder is a tenth or the limit is
// met.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <type_traits>

namespace slant {

/// Temporaries of dual_norm for vectors like `prototype` and a preconditioner m.
template <class V, class M>
struct dual_norm_workspace {
  V r, z = r, p = r, image = r;
  workspace_t<M, V> of_m;

  dual_norm_workspace(M const& m, V const& prototype)
      : r(prototype), of_m(workspace(m, prototype)) {}
};

/// Result of dual_norm.
template <class S>
struct dual_norm_result {
  S value;             ///< of ‖d‖_{A⁻¹}
  index applications;  ///< of A
};

/// What d = A x − b was computed from: rounding may leave some ε(λ‖x‖ + ‖b‖) of it, λ = ‖A‖.
template <class S>
struct gradient_size {
  S point;  ///< ‖x‖
  S load;   ///< ‖b‖
};

/// ‖d‖_{A⁻¹} in at most `most` steps. `dominates`: M ⪰ A⁻¹. Infinite where A or M shows no curvature
/// along what is left of d; with `sizes`, for a semidefinite A, only if that is more than rounding.
template <class A, class M, class V, class WA>
[[nodiscard]] auto dual_norm(A const& a, M const& m, V const& d, index most, bool dominates,
                             WA& of_a, dual_norm_workspace<V, M>& w,
                             std::optional<gradient_size<scalar_t<V>>> sizes = {})
    -> dual_norm_result<scalar_t<V>> {
  using S = scalar_t<V>;
  using std::sqrt;
  S const ε = detail::epsilon<S>();
  S const room = S(4) * sqrt(S(slant::global_size(d)));
  S const unit = unit_near(slant::norm(d));
  vectors::scale(scalar_t<V>(1) / unit, d, w.r);
  slant::apply(m, w.r, w.z, w.of_m);
  vectors::copy(w.z, w.p);
  S rz = slant::inner_product(w.r, w.z), energy(0), recent(0), stiffest(0);
  index k = 0;
  // ‖r‖ is no more than rounding.
  auto const is_rounding = [&] {
    return sizes &&
           slant::norm(w.r) <= room * ε * (stiffest * (sizes->point / unit) + sizes->load / unit);
  };
  // ‖r‖, 1 at first, is far below the rounding of d: products may be 0 by underflow, as where M is
  // A⁻¹ but for rounding and each step leaves ε of r.
  auto const is_gone = [&] { return slant::norm(w.r) <= ε * ε; };
  // Once it is rounding: its norm then, and the energy up to there, for if the rest is in the
  // kernel.
  S noise(-1), without_noise(0);
  while (k < most && rz > S(0)) {
    slant::apply(a, w.p, w.image, of_a);
    ++k;
    S const bend = slant::inner_product(w.p, w.image);
    S quotient = bend, flat(0);
    if (sizes) {
      S const length = slant::norm(w.p);  // its square may leave the range of the numbers
      quotient = bend / length / length;
      stiffest = std::max<S>(stiffest, quotient);
      flat = room * ε * stiffest;
    }
    if (!(quotient > flat)) {
      if (noise >= S(0)) return {unit * sqrt(without_noise), k};
      if (is_gone()) break;
      return {is_rounding() ? S(unit * sqrt(energy)) : detail::infinity<S>(), k};
    }
    S const α = rz / bend, term = α * rz;
    energy += term;
    recent = recent / S(2) + term;
    vectors::axpy(-α, w.image, w.r);
    slant::apply(m, w.r, w.z, w.of_m);
    S const next = slant::inner_product(w.r, w.z);
    vectors::waxpy(next / rz, w.p, w.z, w.p);
    rz = next;
    if (noise < S(0) && is_rounding()) {
      noise = slant::norm(w.r);
      without_noise = energy;
    }
    if (noise >= S(0)) {
      if (slant::norm(w.r) <= noise / S(10)) break;
    } else if (dominates ? S(100) * rz < energy : k > 4 && S(100) * recent < energy) {
      break;
    }
  }
  // M vanishes along what is left of d, or is not semidefinite, or d is not finite: nothing is
  // known of it.
  if (!(rz > S(0)) && !is_gone() && !is_rounding()) return {detail::infinity<S>(), k};
  S const rest = noise >= S(0) ? S(0) : dominates ? rz : recent;
  return {unit * (sqrt(energy) + (rest > S(0) ? S(sqrt(rest)) : S(0))), k};
}

}  // namespace slant

namespace slant::detail {

/// √(xᵀy) for a product that is ≥ 0 but for rounding.
template <class V>
[[nodiscard]] auto root_of_product(V const& x, V const& y) {
  using S = scalar_t<V>;
  using std::sqrt;
  S const ux = unit_near(slant::norm(x)), uy = unit_near(slant::norm(y));
  S const product = slant::total(x, S((slant::local(x) / ux).dot(slant::local(y) / uy)));
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
  return S(unit * (detail::epsilon<S>() / S(2)) * S(sqrt(slant::total(x, sum))));
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

/// What preconditions the conjugate gradients of a certificate: M, or in its place diag(A)⁻¹.
template <class V, class M>
class certificate_preconditioner {
 protected:
  using scalar = scalar_t<V>;
  static constexpr bool is_plain = std::same_as<M, identity_operator>;
  using preconditioner_type = std::conditional_t<is_plain, diagonal_operator<V const&>, M>;

  certificate_preconditioner(M const& m, V const& b)
      : m_(m), stiffness_(b), most_(std::min(slant::global_size(b) + 8, index(200))) {}

  [[nodiscard]] decltype(auto) preconditioner() const {
    if constexpr (is_plain) {
      return preconditioner_type(held<V const&>(stiffness_));
    } else {
      return (m_);
    }
  }
  /// From the mean of the diagonal and b; x and g are scratch. Returns the applications of A.
  template <class A, class W>
  index learn(A const& a, scalar const& mean, V const& b, V& x, V& g, W& w) {
    typical_ = mean > scalar(0) ? scalar(scalar(1) / mean) : scalar(1);
    index const applications = set_stiffness<is_plain>(a, typical_, stiffness_, x, g, w);
    vectors::multiply(stiffness_, b, g);
    size_of_load_ = root_of_product(b, g);
    return applications;
  }

  M m_;
  V stiffness_;             // of the size of diag(A)⁻¹
  scalar typical_{1};       // 1/mean(diag A)
  scalar size_of_load_{0};  // √(Σ bᵢ²/aᵢᵢ)
  index most_;              // iterations
};

}  // namespace slant::detail
