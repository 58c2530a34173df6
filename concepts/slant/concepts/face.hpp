// SPDX-License-Identifier: MIT
//
// Faces: which blocks of a point can still move.
//
// Intuition. At a point x of Λ = Λ₁ × … × Λ_m each block is in the interior of its set (free), on a
// smooth piece of its boundary along which it can slide (sliding), or pinned (fixed). This
// partition is what active-set, semismooth Newton and interior-point methods hand to each other.
//
// Minimal definition. A face has size(), state(i), fill from a set and a point (`assign`), and
// `keep(x, y)`: y = x on the free components, 0 elsewhere.
//
// Laws.  keep ∘ keep = keep,   ⟨keep x, y⟩ = ⟨x, keep y⟩,   free + sliding + fixed = size().
//
// Models. slant::face.
#pragma once

namespace slant {

/// What one block of a point can do.
enum class block_state : unsigned char {
  free,     ///< interior: any small motion stays in the set
  sliding,  ///< on a smooth boundary of positive dimension: tangential motion is left
  fixed     ///< a bound, a single point, a zero radius, an apex: no motion is left
};

}  // namespace slant
