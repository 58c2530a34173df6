// SPDX-License-Identifier: MIT
//
// The segment from an iterate y of Newton's method for the natural residual
//
//     F(y) = y − P_Λ(z),     z = y − ρ (A y − b),
//
// to the end of its full step. Both y and z are linear along it, so F is known everywhere on it at
// the price of a projection: the search for a step length spends no product by A.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>

namespace slant {

/// y and z, and the same at the end of the step.
template <class V>
struct newton_segment {
  using scalar = scalar_t<V>;

  V y;         ///< may leave Λ by terms of second order
  V z;         ///< y − ρ (A y − b)
  V target_y;  ///< y at the end of the full step
  V target_z;  ///< z at the end of the full step

  newton_segment(V const& prototype, index n)
      : y(like(prototype, n)),
        z(like(prototype, n)),
        target_y(like(prototype, n)),
        target_z(like(prototype, n)) {}

  /// ‖F‖ at the fraction β of the step; projected = P_Λ(z) there, trial is scratch.
  template <class Set>
  [[nodiscard]] scalar residual_at(Set const& set, scalar const& β, V& projected, V& trial) const {
    between(z, target_z, β, trial);
    slant::project(set, slant::local(trial), slant::local(projected));
    between(y, target_y, β, trial);
    vectors::subtract(projected, trial);
    return norm(trial);
  }

  /// Takes the fraction β of the step.
  void advance(scalar const& β) {
    between(y, target_y, β, y);
    between(z, target_z, β, z);
  }

 private:
  /// Exact at both ends, however far they are apart.
  static void between(V const& from, V const& to, scalar const& β, V& point) {
    vectors::waxpby(scalar(1) - β, from, β, to, point);
  }
};

}  // namespace slant
