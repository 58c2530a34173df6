// SPDX-License-Identifier: MIT
//
// Interior-point method by path following (algorithm PF) [K §3.2], for
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = {f(x) ≤ 0}                        [K (29)]
//
//     F(x, ν, z) = (∇L, f(x) + z, ν ∘ z),   ∇L = A x − b + G ν,   G = ∇f(x)              [K (35)]
//
//     centre      c = min(c_max, max(c_min, c_s ((1 − ξ)/ξ)³)),   ξ = min ν_i z_i / ϑ
//     solve       (A + W) Δx = −(r + c ϑ G z⁻¹)                  [K (43)], one product a step of CG
//                 Δν = c ϑ/z − ν + (ν/z) Gᵀ Δx                                         [K (42)]
//     raise       at the start: ν and ϑ by ‖ν + Δν‖/‖ν‖ where steps are short; solve again
//     shorten     α: 0.999 of the way to the boundary, then until
//                 ν_i z_i ≥ γ ϑ⁺,   ϑ⁺ ≤ (1 − α ω (1 − c)) ϑ,   ‖∇L⁺‖ ≤ β ϑ⁺            no product
//     correct     where α is short: solve again with the second-order term of this step [Mehrotra]
//     accept      x ← x + α Δx, r ← r + α A Δx, ν ← ν + α Δν
//
// with ϑ the mean of the products ν_i z_i. Where it differs from [K]: discs, ellipses and
// second-order cones have no multiplier, but a force y of any direction in the Lorentz cone, scaled
// with x by Nesterov and Todd (lorentz_pairs.hpp). Next to a curved boundary a multiplier along the
// gradient leaves x no way to go: a unit disc in the plane took 1767 steps to nowhere. All other
// inequalities keep ν_i, with the slacks z = −f(x), which are no unknowns of their own. So every
// iterate is a point of the interior, f(x) + z = 0 always holds, and W is semidefinite even where f
// is not convex (barrier.hpp). c_min is a fifth, not 1e-30: with no centring the iterates run into
// the boundary and the next steps are short. ϑ may not fall much faster than the first ∇L does, for
// the same reason. The start lies on a curve ν_i z_i = ϑ with lengths and forces taken from the
// data, so that units do not matter, and at P_Λ(0) where q is smaller there than at P_Λ(x0); where
// the forces turn out too small, and steps short for that reason, they are raised. Components
// without constraint have no multiplier, no slack and no part in ϑ.
//
// Rejected, by measurement: a predictor and a corrector in every step. They take fewer steps but
// more products, as the second right-hand side needs conjugate gradients of its own.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/interior_point_core.hpp>
#include <slant/methods/interior_point_options.hpp>
#include <slant/methods/interior_point_problem.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/interior_start.hpp>
#include <slant/methods/recession.hpp>
#include <slant/methods/separable_qp.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// What `interior_point` does with a problem that has all it needs.
template <class QP, class M>
class interior_point_steps : interior_point_core<QP, M> {
  using core = interior_point_core<QP, M>;

 public:
  using typename core::options;
  using typename core::problem;
  using typename core::scalar;
  using typename core::state_type;
  using typename core::vector_type;

  explicit interior_point_steps(held<QP> qp)
    requires(!core::preconditioned)
      : interior_point_steps(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  interior_point_steps(held<QP> qp, options o)
    requires(!core::preconditioned)
      : core(std::move(qp), std::move(o)) {}
  interior_point_steps(held<QP> qp, held<M> m)
      : interior_point_steps(std::move(qp), std::move(m), options{}) {}
  /// Throws bad_input if the size of M is not that of the problem, or for options out of range.
  interior_point_steps(held<QP> qp, held<M> m, options o)
      : core(std::move(qp), std::move(m), std::move(o)) {}

  /// The state of a point in the interior on the way from P_Λ(x0), or P_Λ(0) where q is smaller,
  /// to the middle of Λ. Throws
  /// bad_input if x0 or A x0 is not finite or of the wrong size, and naming a block without
  /// interior.
  [[nodiscard]] state_type start(vector_type const& x0) const;

  /// One Newton step.
  void step(state_type& s) const;

  /// r from x, where it has been updated; one product.
  bool refresh(state_type& s) const;

 private:
  using core::infinity;
  using core::m_;
  using core::options_;
  using core::qp_;

  void choose_centring(state_type& s) const {
    s.centring = scalar(0);
    if (s.constraints == 0) return;
    scalar const ξ = s.least / s.measure;
    scalar const q = ξ < scalar(1) ? scalar((scalar(1) - ξ) / ξ) : scalar(0);
    s.centring =
        std::min(options_.centring_most,
                 std::max(least_centring(s), scalar(options_.centring_scale * (q * q * q))));
  }

  [[nodiscard]] scalar correct_below(state_type const& s) const {
    return detail::set_or(options_.correct_below, scalar(s.pairs.empty() ? 0 : 0.3));
  }
  [[nodiscard]] scalar least_centring(state_type const& s) const {
    return detail::set_or(options_.centring_least, scalar(s.pairs.empty() ? 0.1 : 0.2));
  }

  /// c where a step had the length α [Mehrotra].
  [[nodiscard]] scalar centring_after(state_type const& s, scalar const& α) const {
    scalar const rest = scalar(1) - α;
    return std::min(options_.centring_most,
                    std::max<scalar>(least_centring(s), rest * rest * rest));
  }

  /// Δx, A Δx and Δν; false if there is none. `again`: in place of the step at hand; `corrected`:
  /// that much of its second-order term is taken into account.
  bool solve_newton(state_type& s, bool again = false, scalar const& corrected = scalar(0)) const {
    auto const& qp = qp_.get();
    s.pairs.scale(this->blocks(), s.x);
    s.barrier.assemble(this->blocks(), s.x, s.multipliers, s.slacks, s.unit, s.diagonal, s.pairs);
    auto const z = slant::local(s.slacks).array();
    auto const ν = slant::local(s.multipliers).array();
    auto const smooth = slant::local(s.smooth).array();
    auto& centred = slant::local(s.row_scratch);
    scalar const aim = s.centring * s.measure;
    if (corrected > scalar(0)) {
      centred = (smooth *
                 (aim + corrected * slant::local(s.multiplier_step).array() *
                            slant::local(s.slack_step).array()) /
                 z)
                    .matrix();
    } else {
      centred = (smooth * aim / z).matrix();
    }
    vectors::copy(s.r, s.rhs);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), s.row_scratch, s.rhs);
    s.pairs.subtract_target(this->blocks(), aim, corrected, s.rhs);
    s.barrier.keep_fixed(s.rhs);
    // rhs = r + G(…): what is left of the two below the rounding error of r cannot be told from it.
    scalar const target = std::max<scalar>(
        s.forcing.next(options_.forcing) * norm(s.rhs) * scalar(corrected > scalar(0) ? 0.3 : 1.0),
        std::numeric_limits<scalar>::epsilon() * norm(s.r));
    // A step that was cut short says little about the next one.
    bool const warm = options_.warm_start && (again || s.step_fraction > scalar(0.1));
    auto const inner = s.inner.solve(qp.a(), s.a_workspace, m_.get(), s.barrier, s.diagonal, s.rhs,
                                     target, options_.inner_steps, warm, s.trace);
    s.inner_iterations = inner.iterations;
    s.work.inner_iterations += inner.iterations;
    s.work.operator_applications += inner.iterations;
    vectors::scale(s.unit, s.inner.t, s.step);
    s.step_norm = norm(s.step);
    if (!inner.finite || !detail::is_finite(s.step_norm)) {
      s.status = status::breakdown;
      return false;
    }
    s.barrier.jacobian().apply(s.step, s.slack_step);
    slant::local(s.multiplier_step) =
        (centred.array() + smooth * ν * (slant::local(s.slack_step).array() / z - scalar(1)))
            .matrix();
    s.pairs.set_step(this->blocks(), s.step);
    return true;
  }

  /// Is Δx, or the direction at which conjugate gradients ended, one without curvature and without
  /// end in which q falls (recession.hpp)? step is this direction then.
  bool descends_for_ever(state_type& s) const {
    if constexpr (spd_operator<typename problem::operator_type, vector_type>) {
      return false;
    } else {
      if (is_endless(s, s.inner.t, s.inner.image)) return true;
      if (!s.inner.flat || !is_endless(s, s.inner.direction, s.inner.direction_image)) return false;
      vectors::scale(s.unit, s.inner.direction, s.step);
      return true;
    }
  }
  bool is_endless(state_type const& s, vector_type const& d, vector_type const& Ad) const {
    if (inner_product(d, Ad) > flatness(d, s.trace)) return false;
    return is_descent(scalar(-inner_product(d, s.r)), d, scalar(s.size_of_b + norm(s.r))) &&
           !(this->way_out(s, d) < infinity);
  }

  /// The step length α, 0 if there is none; the point at its end is the trial point.
  scalar length(state_type& s) const {
    scalar to_end = this->way_out(s, s.step);
    auto const& ν = slant::local(s.multipliers);
    auto const& dν = slant::local(s.multiplier_step);
    scalar of_ν = infinity;
    for (index i = 0; i < index(ν.size()); ++i) {
      if (dν.coeff(i) < scalar(0)) of_ν = std::min<scalar>(of_ν, -ν.coeff(i) / dν.coeff(i));
    }
    of_ν = std::min<scalar>(of_ν, s.pairs.way_out(this->blocks()));
    to_end = std::min(to_end, slant::minimum(s.x, of_ν));
    scalar α = std::min<scalar>(scalar(1), options_.to_boundary * to_end);
    for (index j = 0; j < options_.shortenings && α > scalar(0); ++j) {
      scalar const factor = this->judge(s, α);
      if (factor == scalar(1)) return α;
      α *= factor;
    }
    return scalar(0);
  }

  void accept(state_type& s, scalar const& α) const {
    std::swap(s.x, s.trial);
    std::swap(s.multipliers, s.trial_multipliers);
    std::swap(s.slacks, s.trial_slacks);
    vectors::axpy(α, s.inner.image, s.r);
    s.measure = s.trial_measure;
    s.least = s.trial_least;
    s.pairs.accept(this->blocks(), α);
    this->estimate_multipliers(s);
    if (s.constraints == 0) this->set_lagrangian(s, s.r, s.multipliers, scalar(0));
    ++s.since_refresh;
    s.step_fraction = α;
    s.infeasible *= scalar(1) - α;
    s.under_way = s.under_way || α > scalar(0.5);
    s.x_norm = norm(s.x);
    s.reduce(qp_.get());
    // [K]: err = ‖v⁺ − v‖ / ‖v⁺‖, here of x alone, since multipliers have other units.
    scalar const error = s.x_norm > scalar(0) ? scalar(α * s.step_norm / s.x_norm) : scalar(1);
    s.forcing.record(std::min<scalar>(error, scalar(1)));
  }

  void note_progress(state_type& s) const {
    if (s.reduced_gradient_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.reduced_gradient_norm)) s.status = status::breakdown;
    if (s.status != status::running) return;
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience)) {
      s.status = status::stalled;
    }
  }
};

template <class QP, class M>
auto interior_point_steps<QP, M>::start(vector_type const& x0) const -> state_type {
  auto const& qp = qp_.get();
  detail::check_size("x0", index(slant::local(x0).size()), qp.size(), "the size of b,");
  detail::check_finite("x0", x0);
  state_type s(qp, m_.get(), x0);
  this->set_diagonal(s);
  auto origin = like(x0, qp.size());
  vectors::set_zero(origin);
  bool const solved = s.begin(qp, origin);
  scalar const per_entry = this->root(scalar(1) / scalar(slant::global_size(x0)));
  scalar const start_force =
      detail::set_or(options_.start_force, scalar(s.pairs.empty() ? 0.3 : 0.6));
  scalar const force = start_force * norm(s.r) * per_entry;
  scalar const length = options_.start_length * this->first_way(s) * per_entry;
  if (!solved) this->choose_start(s, x0);
  s.trial = s.x;
  enter_interior(this->blocks(), solved ? scalar(1) : length, options_.start_depth, s.x, s.centre,
                 s.barrier.per_unit(), [&](auto const& place) { s.barrier.hold(place); });
  if (solved) {
    s.x = s.trial;
    s.status = status::converged;
    return s;
  }
  this->begin(s, force, length);
  return s;
}

template <class QP, class M>
void interior_point_steps<QP, M>::step(state_type& s) const {
  if (s.status != status::running) return;
  choose_centring(s);
  bool solved = solve_newton(s);
  while (solved && this->raise(s)) solved = solve_newton(s, true);
  if (solved) {
    if (descends_for_ever(s)) {
      s.status = status::unbounded;
    } else {
      scalar α = length(s);
      if (s.constraints > 0 && α < correct_below(s)) {
        scalar const c = s.centring, plain = α;
        s.centring = centring_after(s, α);
        α = solve_newton(s, true, α * α) ? length(s) : scalar(0);
        if (α < plain && s.status == status::running) {
          s.centring = c;
          α = solve_newton(s, true) ? length(s) : scalar(0);
        }
      }
      if (α > scalar(0)) {
        accept(s, α);
      } else if (s.status == status::running) {
        s.status = status::stalled;
      }
    }
  }
  ++s.iteration;
  if (s.status == status::running) note_progress(s);
}

template <class QP, class M>
bool interior_point_steps<QP, M>::refresh(state_type& s) const {
  if (s.since_refresh == 0) return false;
  s.gradient(qp_.get());
  s.reduce(qp_.get());
  this->set_lagrangian(s, s.r, s.multipliers, scalar(0));
  s.status = status::running;
  note_progress(s);
  return true;
}

}  // namespace detail

/// The method at the top of this file: solve(interior_point{qp}, x0, reduced_gradient_below(1e-8)
/// || at_most(100)), options second. Requires of the problem that A is psd_operator and that the
/// blocks of the set have a smooth inequality form and step_to_boundary; single points keep their
/// values. Statuses of its own: converged (P_Λ(0) is the solution); stalled; unbounded; breakdown.
template <class QP, class M>
  requires interior_point_problem<std::remove_cvref_t<QP>> &&
           preconditioner_for<std::remove_cvref_t<M>, std::remove_cvref_t<QP>>
class interior_point<QP, M> : public detail::interior_point_steps<QP, M> {
 public:
  using interior_point::interior_point_steps::interior_point_steps;
};

#if SLANT_USES_COMPILED
extern template class detail::interior_point_steps<any_qp<double, definite_laws>,
                                                   identity_operator>;
extern template class detail::interior_point_steps<any_qp<double, semidefinite_laws>,
                                                   identity_operator>;
extern template class detail::interior_point_steps<
    any_qp<double, definite_laws>, any_operator<Eigen::VectorXd, semidefinite_laws>>;
extern template class detail::interior_point_steps<
    any_qp<double, semidefinite_laws>, any_operator<Eigen::VectorXd, semidefinite_laws>>;
#endif

}  // namespace slant
