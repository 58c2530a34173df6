// SPDX-License-Identifier: MIT
//
// KPRGP, "KKT proportioning with reduced gradient projections" [K §3.1.2, (30)–(33), Theorem 1]:
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m
//
//     r(x)  = A x − b                          gradient
//     r̃(x)  = (x − P_Λ(x − α̃ r)) / α̃           reduced gradient, zero exactly at the solution
//     F, 𝒜  = blocks with f_i < 0, f_i = 0       free and active set
//     φ̃, β̃  = r̃ on F, r̃ on 𝒜;   φ = r on F
//
//     (1°) r̃ = 0:                     stop
//     (2°) β̃ᵀr < Γ² φ̃ᵀr:              conjugate gradient step over F; if it leaves Λ, expansion
//                                         x ← x − α̃ φ̃ instead
//     (3°) otherwise:                 proportioning  x ← x − α̃ β̃
//
// Every gradient step is a projected gradient step on some of the blocks: with d its change of x,
// q falls by at least (1/α̃ − σ_max/2) ‖d‖², so α̃ ∈ (0, 2/σ_max) decreases q whatever the sets are.
// For blocks as symmetric as balls, intervals and half lines q falls R-linearly by the factor
// 1 − α̃ σ_min / (2 + 2 max(Γ, 1/Γ)²) a step [K Theorem 1].
//
// Known weakness: on a curved boundary a sliding block moves only by fixed gradient steps.
#pragma once

#include <slant/krylov/spectral_bound.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/methods/kprgp_options.hpp>
#include <slant/methods/kprgp_problem.hpp>
#include <slant/methods/kprgp_state.hpp>
#include <slant/methods/separable_qp.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// KPRGP for a separable_qp: solve(kprgp{qp}, x0, reduced_gradient_below(1e-8) || at_most(500)).
/// Requires: psd_operator (A symmetric positive semidefinite) and separable_set with
/// step_to_boundary. Spends one application of A a step (two for an expansion) and, only if no
/// step_length is given, up to spectrum.steps once at the start. Statuses of its own: converged
/// (r̃ = 0), unbounded (q decreases for ever along −state.directions.p), stalled (‖r̃‖ has reached
/// the level of rounding errors), breakdown (overflow).
template <class QP>
  requires kprgp_problem<std::remove_cvref_t<QP>>
class kprgp<QP> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = kprgp_options<scalar>;
  using state_type = kprgp_state<problem>;

  explicit kprgp(held<QP> qp) : kprgp(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  kprgp(held<QP> qp, options o) : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
  }

  /// The state of P_Λ(x0). Throws bad_input if x0 or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_size("x0", index(slant::local(x0).size()), qp.size(), "the size of b,");
    detail::check_finite("x0", x0);
    state_type s(qp, x0);
    s.scale_of_b = norm(qp.b());
    slant::project(qp.set(), slant::local(x0), slant::local(s.x));
    s.step_length = step_length(s);
    gradient(s);
    detail::check_finite("A x0 - b", s.r);
    s.unit = unit_near(std::max<scalar>(s.scale_of_b, norm(s.r)));
    slant::local(s.r) *= scalar(1) / s.unit;
    restart(s);
    s.best_norm = s.reduced_gradient_norm;
    return s;
  }

  /// One step (2°) or (3°).
  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (strictly_proportional(s)) {
      if (!conjugate_gradient_step(s)) expansion_step(s);
    } else {
      proportioning_step(s);
    }
    ++s.iteration;
    note_progress(s);
  }

 private:
  /// [K (33)]: the error on the active set is small against the one on the free set.
  [[nodiscard]] bool strictly_proportional(state_type const& s) const {
    return s.βr < options_.Γ * options_.Γ * s.φr;
  }

  /// [K (31), (32)]. False if the step leaves Λ (then x may have moved up to the boundary).
  bool conjugate_gradient_step(state_type& s) const {
    auto& d = s.directions;
    s.face.keep(s.r, s.φ);
    d.advance(s.φ);
    d.image(qp_.get().a(), s.a_workspace);
    ++s.work.operator_applications;
    scalar const slope = inner_product(s.r, d.p);
    scalar const flat = flatness(d.p, s.step_length);
    if (!(d.curvature >= -flat)) {  // A is not what it promised, or not a number
      s.status = status::breakdown;
      return true;
    }
    if (d.curvature > flat && try_step(s, slope / d.curvature)) return true;

    slant::local(s.trial) = -slant::local(d.p);
    scalar const α_max = qp_.get().set().step_to_boundary(slant::local(s.x), slant::local(s.trial));
    if (!(α_max < std::numeric_limits<scalar>::infinity())) {
      s.status =
          is_descent(slope, d.p, s.gradient_scale / s.unit) ? status::unbounded : status::stalled;
      return true;
    }
    if (options_.half_step || !(d.curvature > flat)) {
      slant::local(s.x) += α_max * slant::local(s.trial);
      slant::local(s.r) -= (α_max / s.unit) * slant::local(d.Ap);
      split(s);
    }
    return false;
  }

  /// x − α p, p in multiples of unit, if it lies in Λ.
  bool try_step(state_type& s, scalar α) const {
    auto& d = s.directions;
    slant::local(s.trial) = slant::local(s.x) - (s.unit * α) * slant::local(d.p);
    if (!qp_.get().set().contains(slant::local(s.trial))) return false;
    std::swap(s.x, s.trial);
    if (options_.refresh > 0 && ++s.since_refresh >= options_.refresh) {
      gradient(s);
    } else {
      slant::local(s.r) -= α * slant::local(d.Ap);
    }
    split(s);
    s.last_step = kprgp_step::conjugate_gradient;
    return true;
  }

  /// x ← x − α̃ φ̃: may add blocks to the active set.
  void expansion_step(state_type& s) const {
    s.face.keep(s.projected, s.φ);
    s.face.keep_complement(s.x, s.trial);
    slant::local(s.x) = slant::local(s.φ) + slant::local(s.trial);
    gradient(s);
    restart(s);
    s.last_step = kprgp_step::expansion;
  }

  /// x ← x − α̃ β̃: may release blocks from the active set.
  void proportioning_step(state_type& s) const {
    s.face.keep_complement(s.projected, s.φ);
    s.face.keep(s.x, s.trial);
    slant::local(s.x) = slant::local(s.φ) + slant::local(s.trial);
    gradient(s);
    restart(s);
    s.last_step = kprgp_step::proportioning;
  }

  /// r = (A x − b) / unit; one application, none at x = 0.
  void gradient(state_type& s) const {
    s.since_refresh = 0;
    scalar const per_unit = scalar(1) / s.unit;
    if (norm(s.x) == scalar(0)) {
      slant::local(s.r) = -per_unit * slant::local(qp_.get().b());
      return;
    }
    slant::apply(qp_.get().a(), s.x, s.r, s.a_workspace);
    ++s.work.operator_applications;
    slant::local(s.r) = per_unit * (slant::local(s.r) - slant::local(qp_.get().b()));
  }

  /// A new face at x; the next direction is φ itself.
  void restart(state_type& s) const {
    s.face.assign(qp_.get().set(), slant::local(s.x));
    s.directions.live = false;
    split(s);
    if constexpr (!declares_positive_definite<typename problem::operator_type>) {
      // Steps that leave Λ again and again may still sum up to a direction that never does.
      if (s.recession.found(qp_.get().set(), s)) s.status = status::unbounded;
    }
  }

  /// P_Λ(x − α̃ r), r̃ and its two parts' products with r.
  void split(state_type& s) const {
    auto x = slant::local(s.x).array();
    auto r = slant::local(s.r).array();
    scalar const α = s.step_length * s.unit;
    slant::local(s.trial) = slant::local(s.x) - α * slant::local(s.r);
    slant::project(qp_.get().set(), slant::local(s.trial), slant::local(s.projected));
    // Where the projection does nothing r̃ = r, exactly: the quotient would lose ‖x‖ε/α̃.
    auto projected = slant::local(s.projected).array();
    slant::local(s.reduced) =
        (projected == slant::local(s.trial).array()).select(r, (x - projected) / α).matrix();
    s.reduced_gradient_norm = s.unit * norm(s.reduced);
    scalar const noise = std::numeric_limits<scalar>::epsilon() * norm(s.x) / α;
    s.face.keep(s.reduced, s.φ);
    s.φr = gain(s.φ, s.r, noise);
    s.face.keep_complement(s.reduced, s.φ);
    s.βr = gain(s.φ, s.r, noise);
    note_scale(s);
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.reduced_gradient_norm)) {
      s.status = status::breakdown;
    }
  }

  /// φ̃ᵀr or β̃ᵀr. On a curved boundary r̃ is nearly orthogonal to r, and close to the solution the
  /// product is lost in the rounding errors of r̃ = (x − P)/α̃. Then its lower bound ‖r̃‖² stands for
  /// it (x ∈ Λ, so (x − P)ᵀ(z − P) ≤ 0 for z = x − α̃ r): as if Γ were larger for such blocks.
  static scalar gain(vector_type const& part, vector_type const& r, scalar noise) {
    scalar const product = inner_product(part, r);
    scalar const bound = inner_product(part, part);
    return product > bound + noise * norm(r) ? product : bound;
  }

  /// max(‖b‖, ‖A x‖), with ‖A x‖ of the first iterate kept if b = 0: else x → 0 would have no
  /// scale.
  void note_scale(state_type& s) const {
    slant::local(s.trial) = s.unit * slant::local(s.r) + slant::local(qp_.get().b());
    scalar const image = norm(s.trial);
    if (s.scale_of_b == scalar(0)) s.scale_of_b = image;
    s.gradient_scale = std::max(s.scale_of_b, image);
  }

  /// Rounding errors end the descent somewhere; whoever asks for more is told so.
  void note_progress(state_type& s) const {
    if (s.reduced_gradient_norm < s.best_norm) {
      s.best_norm = s.reduced_gradient_norm;
      s.best_iteration = s.iteration;
    }
    index const patience = options_.patience + 10 * qp_.get().size();
    if (s.status == status::running && s.iteration - s.best_iteration > patience) {
      s.status = status::stalled;
    }
  }

  [[nodiscard]] scalar step_length(state_type& s) const {
    if (options_.step_length) return *options_.step_length;
    auto const bound = largest_eigenvalue_bound(qp_.get().a(), s.x, options_.spectrum);
    s.work.setup_applications += bound.applications;
    // A = 0: any step is as good as another; one that moves x by the size of b.
    if (!(bound.upper > scalar(0))) return scalar(1);
    // I − α̃ A contracts best with α̃ = 2 / (σ_max + σ_min); with A = I that is the whole solution.
    scalar const best = scalar(2) / (scalar(1) + bound.smallest_ritz / bound.ritz);
    return std::min<scalar>(options_.step_factor, best) / bound.upper;
  }

  held<QP> qp_;
  options options_;
};

template <class QP>
kprgp(QP&&) -> kprgp<kept_t<QP>>;
template <class QP>
kprgp(QP&&, kprgp_options<typename std::remove_cvref_t<QP>::scalar>) -> kprgp<kept_t<QP>>;

}  // namespace slant
