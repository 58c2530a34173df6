// SPDX-License-Identifier: MIT
//
// Descent without end. For a semidefinite A the function q(x) = ½ xᵀA x − bᵀx has no minimum over Λ
// if there is a direction d with
//
//     A d = 0,   rᵀd < 0,   x + t d ∈ Λ for all t ≥ 0.
//
// In floating point: the curvature dᵀA d is below its own rounding error, the slope above its.
#pragma once

#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/flat_direction.hpp>

#include <limits>

namespace slant {

/// Curvature pᵀAp below which p counts as a direction of the kernel: ε σ ‖p‖², σ ≈ σ_max.
template <class V, class S>
[[nodiscard]] S flatness(V const& p, S σ) {
  S const size = norm(p);
  return std::numeric_limits<S>::epsilon() * size * (size * σ);
}

/// The same for the direction of a CG method; 0 if A is declared definite, which has no kernel.
/// `learn`: σ is not known and grows with the curvatures that are seen.
template <bool Definite, class Directions, class S>
[[nodiscard]] S kernel_curvature(Directions const& d, S& σ, bool learn) {
  if constexpr (Definite) {
    return S(0);
  } else {
    if (learn) {
      S const seen = d.curvature / inner_product(d.p, d.p);
      if (seen > σ) σ = seen;
    }
    return flatness(d.p, σ);
  }
}

/// Compares iterates with an earlier one, which is replaced whenever the number of comparisons is a
/// power of two (Brent's cycle detection): steps may repeat in cycles of any length and add up to
/// such a direction, although none of them is one. Spends no product: A d is a difference of
/// gradients.
template <class V>
class recession_watch {
 public:
  /// For vectors of n entries like the prototype.
  recession_watch(V const& prototype, index n) : x_(like(prototype, n)), r_(like(prototype, n)) {}

  /// Forgets the iterates so far: they belong to another gradient.
  void forget() { seen_ = 0; }

  /// Looks at s.x and its gradient s.r, in multiples of s.unit. If true, s.directions.p is the
  /// negative direction.
  template <class Set, class State>
  [[nodiscard]] bool found(Set const& set, State& s) {
    using S = scalar_t<V>;
    bool const yes = seen_ > 0 && [&] {
      slant::local(s.φ) = slant::local(s.r) - slant::local(r_);
      slant::local(s.trial) = slant::local(s.x) - slant::local(x_);
      S const slope = -inner_product(s.trial, s.r);
      return !(inner_product(s.trial, s.φ) > flatness(s.trial, s.σ / s.unit)) &&
             is_descent(slope, s.trial, S(s.size_of_b + norm(s.r))) &&
             !(slant::minimum(s.x, set.step_to_boundary(slant::local(s.x), slant::local(s.trial))) <
               std::numeric_limits<S>::infinity());
    }();
    if (yes) slant::local(s.directions.p) = -slant::local(s.trial);
    if ((seen_ & (seen_ - 1)) == 0) {
      slant::local(x_) = slant::local(s.x);
      slant::local(r_) = slant::local(s.r);
    }
    ++seen_;
    return yes;
  }

 private:
  V x_;             // the earlier iterate
  V r_;             // its gradient
  index seen_ = 0;  // comparisons so far
};

}  // namespace slant
