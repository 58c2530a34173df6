// SPDX-License-Identifier: MIT
//
// The quadratic program of a Newton step (sets/curved_face.hpp),
//
//     minimise  rᵀt + ½ tᵀ(A + C/ρ) t   over   t ∈ range(G),     H = Π A Π + C/ρ,
//
// by preconditioned conjugate gradients from t = 0:
//
//     p ← z − …,  t ← t + α p,  A t ← A t + α A p,  g ← g + α H p.
//
// A t comes along, so whoever takes the step knows the gradient r + A t at its end: one product by
// A a step and none besides.
//
// Preconditioner: methods/face_preconditioner.hpp.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/face_preconditioner.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// What became of the minimisation.
template <class S>
struct inner_result {
  index iterations;     ///< products spent
  S residual;           ///< ‖Π r + H t‖, in units of r
  bool finite;          ///< no number left the range of the scalar
  S first_residual{0};  ///< ‖Π r‖, where it is of interest
};

/// The minimiser t, its image, and what the iteration works in. V: vectors, WA and WM: workspaces
/// of A and M.
template <class V, class M>
class curved_minimum {
 public:
  using scalar = scalar_t<V>;

  V t;      ///< the step, in range(G)
  V image;  ///< A t

  curved_minimum(V const& prototype, index n, M const& m)
      : t(like(prototype, n)),
        image(like(prototype, n)),
        g_(like(prototype, n)),
        p_(like(prototype, n)),
        Ap_(like(prototype, n)),
        z_(like(prototype, n)),
        weighed_(like(prototype, preconditioned ? n : 0)),
        m_workspace_(workspace(m, prototype)) {}

  /// t with ‖Π r + H t‖ ≤ max(target, floor ‖Π r‖), or the last one after at most `most` steps. t
  /// has the units of r over those of A. r is the gradient at t = 0, s = mean(diag M).
  template <class A, class WA, class Face>
  inner_result<scalar> minimise(A const& a, WA& a_workspace, M const& m, V const& r,
                                Face const& face, scalar const& ρ, scalar const& s, scalar target,
                                index most, scalar const& floor = scalar(0)) {
    vectors::set_zero(t);
    vectors::set_zero(image);
    // Twice: r may be nearly normal to the face, and what rounding leaves of that is no residual.
    face.keep(r, z_);
    face.keep(z_, g_);
    scalar size = norm(g_);
    scalar gz(0);
    scalar const first = size;
    if (target < floor * size) target = floor * size;
    if constexpr (preconditions_faces<M, V, Face>) {
      if (face.curved_count() == 0) m.enter(face, m_workspace_);
    }
    bool finite = detail::is_finite(size);
    index k = 0;
    while (k < most && size > target) {
      precondition_on_face(m, face, s, g_, z_, weighed_, m_workspace_);
      scalar const next = inner_product(g_, z_);
      finite = finite && detail::is_finite(next);
      if (!(next > scalar(0))) break;  // M vanishes along g: it says nothing about this direction
      if (k == 0) {
        vectors::negate(z_, p_);
      } else {
        vectors::waxpby(next / gz, p_, scalar(-1), z_, p_);
      }
      gz = next;
      slant::apply(a, p_, Ap_, a_workspace);
      ++k;
      face.keep(Ap_, z_);
      face.add_curvature(scalar(1) / ρ, p_, z_);
      scalar const bend = inner_product(p_, z_);
      finite = finite && detail::is_finite(bend);
      if (!(bend > scalar(0))) break;  // a direction of the kernel of H: the step ends here
      scalar const α = gz / bend;
      vectors::axpy(α, p_, t);
      vectors::axpy(α, Ap_, image);
      vectors::axpy(α, z_, g_);
      size = norm(g_);
    }
    return {k, size, finite && detail::is_finite(size), first};
  }

  /// ‖Π r + H t‖ from t and its image.
  template <class Face>
  scalar residual(V const& r, Face const& face, scalar const& ρ) {
    vectors::sum(r, image, z_);
    face.keep(z_, g_);
    face.add_curvature(scalar(1) / ρ, t, g_);
    return norm(g_);
  }

 private:
  static constexpr bool preconditioned = !std::is_same_v<M, identity_operator>;

  V g_;        // Π r + H t
  V p_;        // direction
  V Ap_;       // its image
  V z_;        // preconditioned g, then H p
  V weighed_;  // M W g
  workspace_t<M, V> m_workspace_;
};

}  // namespace slant
