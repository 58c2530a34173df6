// SPDX-License-Identifier: MIT
//
// A preconditioner for H = Π A Π + C/ρ on a face (sets/curved_face.hpp), made of M ≈ A⁻¹.
//
// Where the boundary is flat (C = 0), M is the one to use; where its curvature outweighs A,
// (C/ρ)⁻¹. With s = mean(diag M) ≈ 1/mean(diag A) and W = (I + (s/ρ) C)⁻¹
//
//     z = W M W g + s W (I − W) g
//
// is M in the first case and s (s C/ρ)⁻¹ in the second. Without an M the same formula with M = s I
// leaves z = s W g, and z = W g does as well. An M that knows the inverse on a face
// (preconditions_faces) is asked for that where all is flat.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// z for g ∈ range(G); `weighed` is scratch, of no size without an M.
template <class M, class Face, class V, class WM>
void precondition_on_face(M const& m, Face const& face, scalar_t<V> const& s, V const& g, V& z,
                          V& weighed, WM& of_m) {
  if constexpr (std::is_same_v<M, identity_operator>) {
    face.weigh(g, z);
  } else {
    if constexpr (preconditions_faces<M, V, Face>) {
      if (face.curved_count() == 0) {
        m.apply_on_face(g, z, of_m);
        return;
      }
    }
    face.weigh(g, z);
    slant::apply(m, z, weighed, of_m);
    slant::local(weighed) += s * (slant::local(g) - slant::local(z));
    face.weigh(weighed, z);
  }
}

}  // namespace slant
