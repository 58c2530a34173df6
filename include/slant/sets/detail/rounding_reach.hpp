// SPDX-License-Identifier: MIT
//
// Membership and state of a point that is only known up to rounding, as when z = x − c has lost the
// last digits of x and c: the bands of the set itself do not know about that.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/detail/scaling.hpp>

#include <algorithm>

namespace slant::detail {

/// Every block of the set contains its part of x. The bound on the rounding error of a block knows
/// its own components only: a large one elsewhere excuses nothing here.
template <class C, class X>
[[nodiscard]] bool blocks_contain(C const& set, X const& x) {
  bool inside = true;
  set.visit([&](auto const& block, auto const& p) {
    inside = inside && block.contains(argument_of(block, p, x));
  });
  return inside;
}

/// Some point within the distance δ of z (sum of moduli) lies in the set, as far as the projection
/// tells.
template <class C, class Z, class S>
[[nodiscard]] bool contains_within(C const& set, Z const& z, S const& δ) {
  if (set.contains(z)) return true;
  if (!is_finite(δ)) return false;
  auto nearest = slant::project(set, z);
  slant::local(nearest) -= z;
  return S(slant::local(nearest).template lpNorm<1>()) <= δ;
}

/// The most confined state of a point within the distance δ of z: z itself and z ± δ e_j are looked
/// at, the latter moved into the set.
template <class C, class Z, class S>
[[nodiscard]] block_state state_within(C const& set, Z const& z, S const& δ) {
  block_state most = set.state(z);
  if (!(δ > S(0)) || !is_finite(δ)) return most;
  auto probe = z;
  for (index j = 0; j < index(z.size()); ++j) {
    for (S const& side : {S(δ), S(-δ)}) {
      probe.coeffRef(j) = z.coeff(j) + side;
      most = std::max(most, set.state(slant::project(set, probe)));
    }
    probe.coeffRef(j) = z.coeff(j);
  }
  return most;
}

}  // namespace slant::detail
