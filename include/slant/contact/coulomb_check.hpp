// SPDX-License-Identifier: MIT
//
// The violation of Coulomb's law at multipliers λ and the displacements u = K⁻¹(f − Bᵀλ) that they
// lead to, node by node, as a force:
//
//     λ_ν − max(0, λ_ν + ρ (N u − d)),     λ_t − P(λ_t + ρ (T u − w)),    ‖P‖ ≤ F max(0, λ_ν).
//
// Relative to max(‖f‖, ‖Bᵀλ‖). Why not the gradient A λ − b: where bodies nearly move rigidly both
// A λ and b are far larger than u, and relative to ‖b‖ any forces are a solution. Here nothing is
// larger than what loads and forces of contact leave over: ρ = ‖f − Bᵀλ‖/‖u‖ is the stiffness that
// the body shows under p = f − Bᵀλ, at most λ_max(K), so that of rounding nothing is made but
// rounding. It is no bound of the error: Coulomb's law minimises no energy. One product by B and
// one by Bᵀ; no projection or method of the library takes part.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/vector.hpp>

#include <algorithm>
#include <utility>

namespace slant::contact {

/// What coulomb_check finds. NaN where λ or u holds one.
template <class S>
struct coulomb_violation {
  S relative = S(0);   ///< of all nodes, over max(‖f‖, ‖Bᵀλ‖)
  S largest = S(0);    ///< of one node, over the same
  index contact = -1;  ///< which node that is; −1: there is none
};

/// The check at the top of this file for a dual problem (contact/tresca.hpp) and coefficients F of
/// its contact nodes. Refers to the problem.
template <class Dual>
class coulomb_check {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;

  coulomb_check(Dual const& problem, vector_type F) : problem_(&problem), F_(std::move(F)) {}
  coulomb_check(Dual const&&, vector_type) = delete;

  /// Throws bad_input if the sizes are not those of the problem.
  [[nodiscard]] coulomb_violation<scalar> operator()(vector_type const& λ,
                                                     vector_type const& u) const {
    auto const& p = *problem_;
    slant::detail::check_size("lambda", index(λ.size()), index(p.b().size()));
    slant::detail::check_size("u", index(u.size()), index(p.load().size()));
    vector_type const forces = p.constraints().transpose() * λ;
    vector_type const gaps = p.openings(u);  // −(N u − d), −(T u − w)
    scalar const unit = std::max<scalar>(p.load().stableNorm(), forces.stableNorm());
    scalar const size = unit > scalar(0) ? unit : scalar(1), moved = u.stableNorm();
    // u = 0 moves nothing: then any gap that is not there counts.
    scalar const ρ = moved > scalar(0) ? (p.load() - forces).stableNorm() / size / moved
                                       : scalar(1) / largest(gaps);
    coulomb_violation<scalar> v;
    index const m = F_.size(), k = m > 0 ? index(λ.size()) / m - 1 : 0;
    vector_type each(m), part(k + 1);
    for (index i = 0; i < m; ++i) {
      scalar const pressure = λ(i) / size, pushed = pressure - ρ * gaps(i);
      scalar const bound = F_(i) * (pressure > scalar(0) ? pressure : scalar(0));
      part(0) = pushed > scalar(0) ? ρ * gaps(i) : pressure;
      auto const τ = λ.segment(m + k * i, k) / size;
      part.tail(k) = τ - ρ * gaps.segment(m + k * i, k);
      scalar const length = part.tail(k).stableNorm();
      scalar const kept = length > bound ? bound / length : scalar(1);
      part.tail(k) = τ - kept * part.tail(k);
      // Norms may pass over a NaN.
      scalar const sum = pressure + gaps(i) + τ.sum() + gaps.segment(m + k * i, k).sum();
      each(i) = sum == sum ? scalar(part.stableNorm()) : sum;
      if (each(i) > v.largest || each(i) != each(i)) {
        v.largest = each(i);
        v.contact = i;
      }
    }
    bool const known = v.largest == v.largest;
    v.relative = m > 0 && known ? scalar(each.stableNorm()) : v.largest;
    return v;
  }

 private:
  static scalar largest(vector_type const& x) {
    scalar const size = x.size() > 0 ? scalar(x.cwiseAbs().maxCoeff()) : scalar(0);
    return size > scalar(0) ? size : scalar(1);
  }

  Dual const* problem_;
  vector_type F_;
};

}  // namespace slant::contact
