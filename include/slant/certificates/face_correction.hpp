// SPDX-License-Identifier: MIT
//
// The Newton step from x on its face, as a measure of how far the solution is:
//
//     t = argmin  gᵀt + ½ tᵀ(A + C/ρ) t   over   t ∈ range(G)             sets/curved_face.hpp
//
// with its image A t, by preconditioned conjugate gradients. Near a solution x + t is the next
// iterate of Newton's method, so that ‖t‖_A is the error of x up to a factor that tends to 1.
// Unlike ‖·‖_{A⁻¹} of the reduced gradient it charges nothing to what the constraints can take, and
// it needs A to be definite only on the face.
//
// Iterations end where the terms of the last steps are a hundredth of ‖t‖²_H, H = Π A Π + C/ρ: the
// sum of these terms approaches ‖t‖²_H from below [Hestenes, Stiefel 1952; Strakoš, Tichý 2002].
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace slant {

/// t and what is known of it. V: vectors, M: preconditioner.
template <class V, class M>
class face_correction {
 public:
  using scalar = scalar_t<V>;

  V t;                 ///< the step
  V image;             ///< A t
  V remainder;         ///< Π g + H t
  scalar energy{0};    ///< ‖t‖_A
  scalar bend{0};      ///< ‖t‖_{C/ρ}, from the curvature of the blocks
  scalar missing{0};   ///< estimate of the energy norm that more iterations would add to t
  bool found = false;  ///< false: along what is left of g the face has no curvature, or M vanishes

  face_correction(V const& prototype, M const& m)
      : t(prototype),
        image(prototype),
        remainder(prototype),
        r_(prototype),
        p_(prototype),
        Ap_(prototype),
        z_(prototype),
        weighed_(prototype),
        m_workspace_(workspace(m, prototype)) {}

  /// The step for the gradient g in at most `most` iterations; returns how many. 1/ρ ≈ ‖A‖ up to a
  /// factor, s = mean(diag M). `sizes`, for a semidefinite A, as in dual_norm.
  template <class A, class WA, class Face>
  index compute(A const& a, WA& of_a, M const& m, V const& g, Face const& face, scalar const& ρ,
                scalar const& s, index most, std::optional<gradient_size<scalar>> const& sizes) {
    using std::sqrt;
    scalar const ε = std::numeric_limits<scalar>::epsilon();
    scalar const room = scalar(4) * sqrt(scalar(slant::global_size(g)));
    vectors::set_zero(t);
    vectors::set_zero(image);
    energy = bend = missing = scalar(0);
    // Twice: g may be nearly normal to the face, and what rounding leaves of that is no residual.
    face.keep(g, z_);
    face.keep(z_, r_);
    scalar const unit = unit_near(slant::norm(r_));
    vectors::divide(unit, r_);
    enter_face(m, face, scalar(scalar(1) / ρ), m_workspace_);
    scalar gz(0), sum(0), recent(0), stiffest(0);
    auto const is_rounding = [&] {
      return sizes &&
             slant::norm(r_) <= room * ε * (stiffest * (sizes->point / unit) + sizes->load / unit);
    };
    // Once it is, t stays. What the residual then was, and what more iterations would add: nothing
    // if they find no curvature, because what is left is of the kernel.
    scalar noise(-1), beyond(0);
    index k = 0;
    found = slant::norm(r_) == scalar(0);
    vectors::copy(r_, remainder);
    while (!found && k < most) {
      precondition_on_face(m, face, s, r_, z_, weighed_, m_workspace_);
      scalar const next = slant::inner_product(r_, z_);
      if (!(next > scalar(0))) break;
      if (k == 0) {
        vectors::negate(z_, p_);
      } else {
        vectors::waxpby(next / gz, p_, scalar(-1), z_, p_);
      }
      gz = next;
      slant::apply(a, p_, Ap_, of_a);
      ++k;
      face.keep(Ap_, z_);
      face.add_curvature(scalar(1) / ρ, p_, z_);
      scalar const pHp = slant::inner_product(p_, z_);
      scalar quotient = pHp, flat(0);
      if (sizes) {
        scalar const length = slant::norm(p_);  // its square may leave the range of the numbers
        quotient = pHp / length / length;
        stiffest = std::max<scalar>(stiffest, quotient);
        flat = room * ε * stiffest;
      }
      if (!(quotient > flat)) {
        beyond = scalar(0);
        break;
      }
      scalar const α = gz / pHp, term = α * gz;
      vectors::axpy(α, z_, r_);
      sum += term;
      if (noise >= scalar(0)) {
        beyond += term;
        found = slant::norm(r_) <= noise / scalar(10);
        continue;
      }
      vectors::axpy(α, p_, t);
      vectors::axpy(α, Ap_, image);
      vectors::copy(r_, remainder);
      recent = recent / scalar(2) + term;
      bool const is_exact = slant::norm(r_) <= room * ε;
      if (is_exact) recent = scalar(0);
      found = is_exact || (k > 4 && scalar(100) * recent < sum);
      if (!found && is_rounding()) noise = slant::norm(r_);
    }
    found = found || noise >= scalar(0) || is_rounding() || (k == most && k > 4);
    missing = unit * sqrt(noise >= scalar(0) ? beyond : recent);
    vectors::set_zero(z_);
    face.add_curvature(scalar(1) / ρ, t, z_);
    scalar const curved = slant::inner_product(t, z_);
    bend = curved > scalar(0) ? scalar(unit * sqrt(curved)) : scalar(0);
    scalar const squared = slant::inner_product(t, image);
    energy = squared > scalar(0)  ? scalar(unit * sqrt(squared))
             : squared == squared ? scalar(0)
                                  : squared;
    vectors::scale(unit, t);
    vectors::scale(unit, image);
    vectors::scale(unit, remainder);
    return k;
  }

 private:
  V r_, p_, Ap_, z_, weighed_;
  workspace_t<M, V> m_workspace_;
};

}  // namespace slant
