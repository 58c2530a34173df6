// SPDX-License-Identifier: MIT
//
// What may precondition a method for a quadratic program.
#pragma once

#include <slant/concepts/linear_operator.hpp>

#include <concepts>

namespace slant {

/// A self-adjoint semidefinite M ≈ A⁻¹ for the vectors of the problem.
template <class M, class QP> concept preconditioner_for = psd_operator<M, typename QP::vector_type>;

/// A preconditioner with a form of its own for each face without curved blocks: after enter(face,
/// w) y ≈ (A_FF)⁻¹ x by apply_on_face(x, y, w), self-adjoint and definite on the face, 0 off it.
/// Such as multigrid, whose sweeps pass over what is held.
template <class M, class V, class Face>
concept preconditions_faces =
    linear_operator<M, V> &&
    requires(M const& m, V const& x, V& y, Face const& face, workspace_t<M, V>& w) {
      m.enter(face, w);
      m.apply_on_face(x, y, w);
      { face.curved_count() } -> std::convertible_to<index>;
    };

}  // namespace slant
