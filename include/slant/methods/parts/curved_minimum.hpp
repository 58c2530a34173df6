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
// Preconditioner: krylov/preconditioner.hpp.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/operators/identity.hpp>

#include <cmath>
#include <type_traits>

namespace slant {

/// What became of the minimisation.
template <class S>
struct inner_result {
  index iterations;     ///< products spent
  S residual;           ///< ‖Π r + H t‖, in units of r
  bool finite;          ///< no number left the range of the scalar
  S first_residual{0};  ///< ‖Π r‖, where it is of interest
  S first_energy{0};    ///< ‖Π r‖_M, about ‖t‖_H
  bool flat = false;    ///< ended where H has no curvature
};

/// Counts it in the state of a method; false, with the status breakdown, if it is not finite.
template <class S, class State>
bool note_inner(inner_result<S> const& inner, State& s) {
  s.inner_iterations = inner.iterations;
  s.work.inner_iterations += inner.iterations;
  s.work.operator_applications += inner.iterations;
  if (!inner.finite) s.status = status::breakdown;
  return inner.finite;
}

/// The minimiser t, its image, and what the iteration works in. V: vectors, WA and WM: workspaces
/// of A and M.
template <class V, class M>
class curved_minimum {
 public:
  using scalar = scalar_t<V>;

  V t;          ///< the step, in range(G)
  V image = t;  ///< A t

  curved_minimum(V const& prototype, index n, M const& m)
      : t(like(prototype, n)),
        weighed_(like(prototype, preconditioned ? n : 0)),
        m_workspace_(workspace(m, prototype)) {}

  /// t with ‖Π r + H t‖ ≤ max(target, floor ‖Π r‖), or the last one after at most `most` steps. t
  /// has the units of r over those of A. r is the gradient at t = 0, s = mean(diag M). With an
  /// energy, in the units of ‖r‖_M: t stays 0 if ‖Π r‖_M is no more, and the iteration ends where
  /// ‖Π r + H t‖_M is an eighth of it. A shift stands for A + shift I. `roughly`: with A as M knows
  /// it, if it does (multiplies_roughly).
  template <class A, class WA, class Face>
  inner_result<scalar> minimise(A const& a, WA& a_workspace, M const& m, V const& r,
                                Face const& face, scalar const& ρ, scalar const& s, scalar target,
                                index most, scalar const& floor = scalar(0),
                                scalar const& energy = scalar(0), scalar const& shift = scalar(0),
                                bool roughly = false) {
    using std::sqrt;
    vectors::set_zero(t);
    vectors::set_zero(image);
    // Twice: r may be nearly normal to the face, and what rounding leaves of that is no residual.
    face.keep(r, z_);
    face.keep(z_, g_);
    scalar size = norm(g_);
    scalar gz(0), first_energy(0);
    scalar const first = size;
    if (target < floor * size) target = floor * size;
    enter_face(m, face, scalar(scalar(1) / ρ), m_workspace_);
    bool finite = detail::is_finite(size);
    index k = 0;
    bool flat = false;
    bool const asks = energy > scalar(0) && size > scalar(0);
    while (k < most && (size > target || (asks && k == 0))) {
      precondition_on_face(m, face, s, g_, z_, weighed_, m_workspace_);
      scalar const next = inner_product(g_, z_);
      finite = finite && detail::is_finite(next);
      if (!(next > scalar(0))) break;  // M vanishes along g: it says nothing about this direction
      if (k == 0) first_energy = sqrt(next);
      if (energy > scalar(0) && sqrt(next) <= (k == 0 ? energy : energy / scalar(8))) break;
      scalar const β = k == 0 ? scalar(0) : next / gz;
      turn(β, z_, p_);
      if (!multiply_roughly(m, face, β, roughly)) slant::apply(a, p_, Ap_, a_workspace);
      gz = next;
      ++k;
      face.keep(Ap_, z_);
      face.add_curvature(scalar(1) / ρ, p_, z_);
      if (shift > scalar(0)) vectors::axpy(shift, p_, z_);
      scalar const bend = inner_product(p_, z_);
      finite = finite && detail::is_finite(bend);
      if (!(bend > scalar(0))) {  // a direction of the kernel of H: the step ends here
        flat = true;
        break;
      }
      scalar const α = gz / bend;
      vectors::axpy(α, p_, t);
      vectors::axpy(α, Ap_, image);
      vectors::axpy(α, z_, g_);
      size = norm(g_);
    }
    return {k, size, finite && detail::is_finite(size), first, first_energy, flat};
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

  /// p ← β p − z.
  static void turn(scalar const& β, V const& z, V& p) {
    if (β == scalar(0)) {
      vectors::negate(z, p);
    } else {
      vectors::waxpby(β, p, scalar(-1), z, p);
    }
  }
  /// A p by A as M knows it, if it does and if that is wanted. Where z is what M found last the image
  /// of that is cheaper, and that of p follows.
  template <class Face>
  bool multiply_roughly(M const& m, Face const&, scalar const& β, bool roughly) {
    if constexpr (multiplies_roughly<M, V>) {
      if (roughly && finds_preconditioned<M, V, Face>) {
        m.multiply_last_roughly(z_, weighed_, m_workspace_);
        turn(β, weighed_, Ap_);
      } else if (roughly) {
        m.multiply_roughly(p_, Ap_, m_workspace_);
      }
      return roughly;
    }
    return false;
  }

  V g_ = t;    // Π r + H t
  V p_ = t;    // direction
  V Ap_ = t;   // its image
  V z_ = t;    // preconditioned g, then H p
  V weighed_;  // M W g, or A z
  workspace_t<M, V> m_workspace_;
};

// --- newton segment ------------------------------------------------------------------------------
//
// The segment from an iterate y of Newton's method for the natural residual
//
//     F(y) = y − P_Λ(z),     z = y − ρ (A y − b),
//
// to the end of its full step. Both y and z are linear along it, so F is known everywhere on it at
// the price of a projection: the search for a step length spends no product by A.

/// y and z, and the same at the end of the step.
template <class V>
struct newton_segment {
  using scalar = scalar_t<V>;

  V y;             ///< may leave Λ by terms of second order
  V z = y;         ///< y − ρ (A y − b)
  V target_y = y;  ///< y at the end of the full step
  V target_z = y;  ///< z at the end of the full step

  newton_segment(V const& prototype, index n) : y(like(prototype, n)) {}

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
