// SPDX-License-Identifier: MIT
//
// An estimate of ‖x − x*‖_A from the gradient g = A x − b at x ∈ Λ, by a Newton step. In the bound
//
//     e ≤ ½ (δ + √(δ² + 4γ)),     δ = ‖g − s‖_{A⁻¹} certificates/energy_error.hpp
//
// s may be the balanced part of g + A D for any D: then g − s = −A D + rest, and
//
//     δ ≤ ‖D‖_A + ‖rest‖_{A⁻¹}.
//
// D is the Newton step: next to the solution it is x* − x, the rest vanishes, and so does what is
// estimated too high. It goes to x₁ = P_Λ(z), z = x − ρ g, of a function φ to prox_{ρφ}(z), and from
// there on the face of x₁ by conjugate gradients (face_correction) for the gradient there and the
// subgradient v = (z − x₁)/ρ. The inequality holds for every D; estimated are what more of
// these iterations would add, and ‖rest‖_{A⁻¹} unless the caller has a bound of it.
//
// Cost: one application of A, and one for each iteration, some 10.
//
// With equations G x = e the face is cut by ker G, and the step to it begins with the shortest one
// that meets them (constrained_certificate.hpp).
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/sets/curved_face.hpp>
#include <slant/sets/proximal_step.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace slant {

// --- face correction -----------------------------------------------------------------------------
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

/// t and what is known of it. V: vectors, M: preconditioner.
template <class V, class M>
class face_correction {
 public:
  using scalar = scalar_t<V>;

  V t;                 ///< the step
  V image = t;         ///< A t
  V remainder = t;     ///< Π g + H t
  scalar energy{0};    ///< ‖t‖_A
  scalar bend{0};      ///< ‖t‖_{C/ρ}, from the curvature of the blocks
  scalar missing{0};   ///< estimate of the energy norm that more iterations would add to t
  bool found = false;  ///< false: along what is left of g the face has no curvature, or M vanishes

  face_correction(V const& prototype, M const& m)
      : t(prototype), m_workspace_(workspace(m, prototype)) {}

  /// The step for the gradient g in at most `most` iterations; returns how many. 1/ρ ≈ ‖A‖ up to a
  /// factor, s = mean(diag M). `sizes`, for a semidefinite A, as in dual_norm.
  template <class A, class WA, class Face>
  index compute(A const& a, WA& of_a, M const& m, V const& g, Face const& face, scalar const& ρ,
                scalar const& s, index most, std::optional<gradient_size<scalar>> const& sizes) {
    using std::sqrt;
    scalar const ε = detail::epsilon<scalar>();
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

  /// Puts a step before t, with its image; the face is the one of t.
  template <class Face>
  void precede(V const& step, V const& image_of_step, Face const& face, scalar const& ρ) {
    vectors::add(step, t);
    vectors::add(image_of_step, image);
    vectors::set_zero(z_);
    face.add_curvature(scalar(1) / ρ, t, z_);
    energy = detail::root_of_product(t, image);
    bend = detail::root_of_product(t, z_);
  }

 private:
  V r_ = t, p_ = t, Ap_ = t, z_ = t, weighed_ = t;
  workspace_t<M, V> m_workspace_;
};

/// Where x is, and what the estimate may use.
template <class V>
struct estimated_point {
  using scalar = scalar_t<V>;

  V const& x;          ///< of Λ
  V const& gradient;   ///< A x − b
  V const& stiffness;  ///< of the size of diag(A)⁻¹
  scalar ρ;            ///< its size as one number, the step of the projection
  index most;          ///< iterations
  /// For an A that may be singular: what the gradient was computed from.
  std::optional<gradient_size<scalar>> sizes;
  /// false: what the iterations have left of the gradient is part of the rest, for few iterations
  /// and a norm_of that bounds. true: what more of them would add is estimated.
  bool trusts_iterations = true;
  /// With equations: Q x − x̄, and ‖x‖ + ‖x̄‖.
  V const* offset = nullptr;
  scalar size_of_offset{0};
};

/// The estimate at the top of this file for programs qp with a preconditioner like m. Refers to qp.
/// Face: curved_face, or cut_face with equations.
template <class QP, class M, class Face = curved_face<typename QP::scalar>>
class newton_estimate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  newton_estimate(QP const& qp, M const& m, Face face)
      : qp_(&qp), face_(std::move(face)), correction_(qp.b(), m) {}
  newton_estimate(QP const& qp, M const& m) : newton_estimate(qp, m, Face(function_of(qp))) {}

  /// Infinite where nothing is known: A shows no curvature along the gradient on the face, or no
  /// step on it meets the equations.
  /// norm_of(d) → ‖d‖_{A⁻¹}, asked once at most.
  template <class WA, class Norm>
  [[nodiscard]] scalar operator()(estimated_point<vector_type> const& at, M const& m, WA& of_a,
                                  Norm const& norm_of) {
    vectors::waxpy(-at.ρ, at.gradient, at.x, trial_);
    auto const& step_of_φ = slant::at_step(function_of(*qp_), at.ρ);
    slant::project(step_of_φ, slant::local(trial_), slant::local(projected_));
    static_cast<void>(face_.assign(step_of_φ, slant::local(trial_), scalar(1)));
    vectors::difference(projected_, at.x, step_);
    apply(step_, image_, of_a);
    vectors::sum(at.gradient, image_, rest_);
    if constexpr (!quadratic_program<QP>) {  // of a set v is normal to the face
      vectors::subtract(projected_, trial_);
      vectors::axpy(scalar(1) / at.ρ, trial_, rest_);
    }
    if constexpr (is_cut) {
      vectors::sum(*at.offset, step_, trial_);
      face_.lift(trial_, lift_);
      vectors::subtract(lift_, trial_);
      if (!face_.meets(trial_, at.size_of_offset)) return detail::infinity<scalar>();
      vectors::negate(lift_, lift_);
      apply(lift_, image_of_lift_, of_a);
      vectors::add(image_of_lift_, rest_);
      face_.add_curvature(scalar(1) / at.ρ, lift_, rest_);
    }
    applications_ +=
        correction_.compute(qp_->a(), of_a, m, rest_, face_, at.ρ, at.ρ, at.most, at.sizes);
    if (!correction_.found || !detail::is_finite(correction_.energy)) {
      return detail::infinity<scalar>();
    }
    if constexpr (is_cut) correction_.precede(lift_, image_of_lift_, whole_face(face_), at.ρ);
    if (!at.trusts_iterations) {
      vectors::set_zero(correction_.remainder);
      correction_.missing = scalar(0);
    }
    return put_together(at, norm_of);
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }
  [[nodiscard]] Face const& face() const { return face_; }

 private:
  /// Equations cut the face.
  static constexpr bool is_cut = requires(Face const& f, vector_type const& x, vector_type& y) {
    f.lift(x, y);
    f.balance(x, y);
  };

  template <class WA>
  void apply(vector_type const& x, vector_type& y, WA& of_a) {
    vectors::set_zero(y);
    if (!(slant::norm(x) > scalar(0))) return;
    slant::apply(qp_->a(), x, y, of_a);
    ++applications_;
  }

  /// The bound for x from s balanced at x, or for x₁ from s balanced there and ‖x₁ − x‖_A on top: a
  /// point inside Λ has a gap of the first order that x₁ has not. Curved blocks are balanced with a
  /// part of the gradient or by the gap alone. What the diagonal of A says is best is taken.
  template <class Norm>
  [[nodiscard]] scalar put_together(estimated_point<vector_type> const& at, Norm const& norm_of) {
    vectors::add(correction_.image, image_);
    vectors::sum(at.gradient, image_, balanced_);
    if constexpr (is_cut) {  // by a multiplier of the equations
      face_.balance(balanced_, trial_);
      vectors::subtract(trial_, balanced_);
    }
    vectors::subtract(correction_.image, image_);
    scalar const way = detail::root_of_product(step_, image_);
    bound_split best;
    consider(best, at, projected_, correction_.energy, correction_.bend, way);
    vectors::add(correction_.t, step_);
    vectors::add(correction_.image, image_);
    vectors::set_zero(trial_);
    whole_face(face_).add_curvature(scalar(1) / at.ρ, step_, trial_);
    consider(best, at, at.x, detail::root_of_product(step_, image_),
             detail::root_of_product(step_, trial_), scalar(0));
    if (!detail::is_finite(best.bound)) return best.bound;
    scalar const rest = norm_of(rest_);
    if constexpr (is_cut) {  // (ν⁺ − ν*)ᵀ(Q x − x̄) is of the second order
      using std::sqrt;
      scalar const lifted = detail::root_of_product(lift_, image_of_lift_);
      scalar const root = sqrt(lifted) * sqrt(scalar(2) * (rest + correction_.missing));
      best.root_of_gap = detail::root_of_squares<scalar>(best.root_of_gap, root);
    }
    scalar const δ = detail::root_of_squares<scalar>(best.moved, correction_.missing) + rest;
    return error_bound_of_root<scalar>(δ, best.root_of_gap) + best.above;
  }

  /// How a bound is put together: δ = √(moved² + missing²) + ‖rest‖_{A⁻¹}, γ, and what comes on
  /// top.
  struct bound_split {
    scalar bound = detail::infinity<scalar>();
    scalar moved{0}, root_of_gap{0}, above{0};
  };
  /// Splits the gradient at the end of the step into a part that Λ balances at x and a rest, what is
  /// missing on the face left out. `moved` and `bend`: ‖·‖_A and ‖·‖_{C/ρ} of the step.
  void consider(bound_split& best, estimated_point<vector_type> const& at, vector_type const& x,
                scalar const& moved, scalar const& bend, scalar const& above) {
    using std::sqrt;
    scalar const bent = bend / scalar(sqrt(scalar(2)));
    for (scalar const factor : {scalar(1), scalar(0x1p27)}) {
      vectors::copy(at.stiffness, weight_);
      whole_face(face_).curved_components(
          [&](index i) { slant::local(weight_).coeffRef(i) *= factor; });
      auto const split = balance(function_of(*qp_), x, balanced_, weight_, trial_);
      vectors::subtract(correction_.remainder, trial_);
      scalar const root = split.root_of_gap > bent ? split.root_of_gap : bent;
      vectors::multiply(at.stiffness, trial_, weight_);
      scalar const rest = detail::root_of_product(trial_, weight_);
      scalar const bound = error_bound_of_root<scalar>(moved + rest, root) + above;
      // A gap that is NaN may have lost the comparison.
      if (!(bound < best.bound) || !detail::is_finite(split.root_of_gap)) continue;
      best = {bound, moved, root, above};
      vectors::copy(trial_, rest_);
    }
  }

  QP const* qp_;
  index applications_ = 0;
  Face face_;
  face_correction<vector_type, M> correction_;
  vector_type projected_ = qp_->b(), step_ = projected_, image_ = projected_,
              balanced_ = projected_, rest_ = projected_, trial_ = projected_, weight_ = projected_;
  vector_type lift_ = like(balanced_, is_cut ? slant::local(balanced_).size() : 0);
  vector_type image_of_lift_ = lift_;
};

}  // namespace slant
