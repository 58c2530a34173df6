// SPDX-License-Identifier: MIT
//
// Faces: which blocks of a point can still move.
//
// Intuition. At a point x of Λ = Λ₁ × … × Λ_m each block is in the interior of its set (free), on a
// smooth piece of its boundary along which it can slide (sliding), or pinned (fixed). This
// partition is what active-set, semismooth Newton and interior-point methods hand to each other.
//
// Minimal definition. A face has size(), the number of blocks, state(i), assign(set, x), which
// makes it the face of x, and keep(x, y): y = x on the free components, 0 elsewhere.
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

/// Cuts vectors down to their free components: keep(x, y), y may be x.
template <class F, class V>
concept has_keep = requires(F const& face, V const& x, V& y) { face.keep(x, y); };

}  // namespace slant
