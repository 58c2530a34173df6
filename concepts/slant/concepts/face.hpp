// SPDX-License-Identifier: MIT
//
// Faces: which blocks of a point can still move.
//
// Intuition. At a point x of Λ = Λ₁ × … × Λ_m each block is in the interior of its set (free), on a
// smooth piece of its boundary along which it can slide (sliding), or pinned (fixed). This
// partition is what active-set, semismooth Newton and interior-point methods hand to each other.
//
// Minimal definition. A face is default-constructible and has
//     size()                 the number of blocks,
//     state(i)               what block i can do,
//     assign(set, x)         makes it the face of x ∈ set,
//     keep(x, y)             y = x on the free components, 0 elsewhere; y may be x,
//     keep_complement(x, y)  y = 0 on the free components, x elsewhere; y may be x.
// A set that wants faces of its own has face_of(x).
//
// Laws.   keep ∘ keep = keep,   ⟨keep x, y⟩ = ⟨x, keep y⟩,   keep x + keep_complement x = x.
//
// Models. slant::face, for every set whose blocks have a state.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <concepts>

namespace slant {

/// What one block of a point can do.
enum class block_state : unsigned char {
  free,     ///< interior: any small motion stays in the set
  sliding,  ///< on a smooth boundary of positive dimension: tangential motion is left
  fixed     ///< a bound, a single point, a zero radius, an apex: no motion is left
};

template <class F>
concept has_block_count = requires(F const& face) {
  { face.size() } -> std::convertible_to<index>;
};
template <class F>
concept has_block_state_at = requires(F const& face, index i) {
  { face.state(i) } -> std::same_as<block_state>;
};
template <class F, class C, class X>
concept has_assign = requires(F& face, C const& set, X const& x) { face.assign(set, x); };
/// Cuts vectors down to their free components: keep(x, y), y may be x.
template <class F, class V>
concept has_keep = requires(F const& face, V const& x, V& y) { face.keep(x, y); };
/// Cuts vectors down to their other components: keep_complement(x, y), y may be x.
template <class F, class V>
concept has_keep_complement =
    requires(F const& face, V const& x, V& y) { face.keep_complement(x, y); };

/// A face that can be told by itself; see the top of this file.
template <class F, class V>
concept block_partition = std::default_initializable<F> && has_block_count<F> &&
                          has_block_state_at<F> && has_keep<F, V> && has_keep_complement<F, V>;

/// A face for the points X of the set C, cutting down vectors V.
template <class F, class C, class X, class V>
concept face_for = block_partition<F, V> && has_assign<F, C, X>;

}  // namespace slant
