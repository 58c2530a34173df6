// SPDX-License-Identifier: MIT
//
// Preconditioners of quadratic programs: what is asked of one, and its form on a face.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/operators/identity.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

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

/// One that knows H = Π A Π + κ C with the curvature C of the face as well: enter(face, κ, w).
template <class M, class V, class Face>
concept preconditions_curved_faces =
    preconditions_faces<M, V, Face> && requires(M const& m, Face const& face, scalar_t<V> const& κ,
                                                workspace_t<M, V>& w) { m.enter(face, κ, w); };

/// One that knows A itself as well, in short numbers: y ≈ A x by multiply_roughly(x, y, w), with
/// an error of about roughness · ‖A‖ ‖x‖, and by multiply_last_roughly for the x that it has found
/// last. Such as multigrid, whose finest level that is; where products wait for memory they cost a
/// quarter, and an eighth.
template <class M, class V>
concept multiplies_roughly =
    linear_operator<M, V> && requires(M const& m, V const& x, V& y, workspace_t<M, V>& w) {
      m.multiply_roughly(x, y, w);
      m.multiply_last_roughly(x, y, w);
      { M::roughness } -> std::convertible_to<scalar_t<V>>;
    };

// --- face preconditioner -------------------------------------------------------------------------
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
// (preconditions_faces) is asked for that where all is flat, one that knows it with curvature
// always. Where p equations cut the face (problems/cut_face.hpp), that is the inverse on the whole
// face between projectors onto the cut one, which differs from the inverse by a rank of 2 p at most.

/// The face that is cut, or face itself.
[[nodiscard]] decltype(auto) whole_face(auto const& face) {
  if constexpr (requires { face.whole(); }) {
    return face.whole();
  } else {
    return (face);
  }
}

/// What m has to know of a face before precondition_on_face; κ = 1/ρ.
void enter_face(auto const& m, auto const& face, auto const& κ, auto& of_m) {
  auto const& whole = whole_face(face);
  if constexpr (requires { m.enter(whole, κ, of_m); }) {
    m.enter(whole, κ, of_m);
  } else if constexpr (requires { m.enter(whole, of_m); }) {
    if (whole.curved_count() == 0) m.enter(whole, of_m);
  }
}

/// Whether precondition_on_face takes z from M as it is.
template <class M, class V, class Face>
concept finds_preconditioned =
    std::same_as<std::remove_cvref_t<decltype(whole_face(std::declval<Face const&>()))>, Face> &&
    preconditions_curved_faces<M, V, Face>;

/// z for g ∈ range(G); `weighed` is scratch, of no size without an M.
template <class M, class Face, class V, class WM>
void precondition_on_face(M const& m, Face const& face, scalar_t<V> const& s, V const& g, V& z,
                          V& weighed, WM& of_m) {
  if constexpr (std::is_same_v<M, identity_operator>) {
    face.weigh(g, z);
  } else {
    using whole = std::remove_cvref_t<decltype(whole_face(face))>;
    if constexpr (preconditions_faces<M, V, whole>) {
      if (preconditions_curved_faces<M, V, whole> || whole_face(face).curved_count() == 0) {
        if constexpr (std::same_as<whole, Face>) {
          m.apply_on_face(g, z, of_m);
        } else {
          m.apply_on_face(g, weighed, of_m);
          face.keep(weighed, z);
        }
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
