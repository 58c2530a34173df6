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
//     shorten     α: 0.999 of the way to the boundary, then until
//                 ν_i z_i ≥ γ ϑ⁺,   ϑ⁺ ≤ (1 − α ω (1 − c)) ϑ,   ‖∇L⁺‖ ≤ β ϑ⁺            no product
//     accept      x ← x + α Δx, r ← r + α A Δx, ν ← ν + α Δν
//
// with ϑ = νᵀz / number of constraints. Where it differs from [K]: the slacks are z = −f(x), not
// unknowns of their own. So every iterate is a point of the interior, f(x) + z = 0 always holds,
// and W is semidefinite even for a cone, whose f is not convex (barrier.hpp). The start lies on a
// curve ν_i z_i = ϑ with lengths and forces taken from the data, so that units do not matter.
// Components without constraint have no multiplier, no slack and no part in ϑ.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/distributed.hpp>
#include <slant/methods/estimated_diagonal.hpp>
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

/// The method at the top of this file: solve(interior_point{qp}, x0, reduced_gradient_below(1e-8)
/// || at_most(100)), options second. Requires of the problem that A is psd_operator and that the
/// blocks of the set have a smooth inequality form and step_to_boundary; single points keep their
/// values. Statuses of its own: converged (P_Λ(0) is the solution); stalled; unbounded; breakdown.
template <class QP>
  requires interior_point_problem<std::remove_cvref_t<QP>>
class interior_point<QP> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = interior_point_options<scalar>;
  using state_type = interior_point_state<problem>;

  explicit interior_point(held<QP> qp) : interior_point(std::move(qp), options{}) {}
  /// Throws bad_input for options out of range.
  interior_point(held<QP> qp, options o) : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
  }

  /// The state of a point in the interior on the way from P_Λ(x0) to the middle of Λ. Throws
  /// bad_input if x0 or A x0 is not finite or of the wrong size, and naming a block without
  /// interior.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    auto const& qp = qp_.get();
    detail::check_size("x0", index(slant::local(x0).size()), qp.size(), "the size of b,");
    detail::check_finite("x0", x0);
    state_type s(qp, x0);
    set_diagonal(s);
    auto origin = like(x0, qp.size());
    slant::local(origin).setZero();
    bool const solved = s.begin(qp, origin);
    scalar const per_entry = root(scalar(1) / scalar(slant::global_size(x0)));
    scalar const force = options_.start_force * norm(s.r) * per_entry;
    scalar const length = options_.start_length * first_way(s) * per_entry;
    s.trial = s.x;
    slant::project(qp.set(), slant::local(x0), slant::local(s.x));
    enter_interior(blocks(), solved ? scalar(1) : length, options_.start_depth, s.x, s.centre,
                   s.barrier.per_unit());
    if (solved) {
      s.x = s.trial;
      s.status = status::converged;
      return s;
    }
    begin(s, force, length);
    return s;
  }

  /// One Newton step.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    choose_centring(s);
    if (solve_newton(s)) {
      if (descends_for_ever(s)) {
        s.status = status::unbounded;
      } else {
        shorten(s);
      }
    }
    ++s.iteration;
    if (s.status == status::running) note_progress(s);
  }

  /// r from x, where it has been updated; one product.
  bool refresh(state_type& s) const {
    if (s.since_refresh == 0) return false;
    s.gradient(qp_.get());
    s.reduce(qp_.get());
    set_lagrangian(s, s.r, s.multipliers);
    s.status = status::running;
    note_progress(s);
    return true;
  }

 private:
  [[nodiscard]] auto const& blocks() const { return qp_.get().set(); }

  static constexpr scalar infinity = std::numeric_limits<scalar>::infinity();
  using column = Eigen::Array<scalar, Eigen::Dynamic, 1>;

  static scalar root(scalar const& v) {
    using std::sqrt;
    return sqrt(v);
  }

  /// The length of the first projected gradient step with the best step length: that of what Λ does
  /// not bound. α, the step length of a typical direction, would be too short by far where A is ill
  /// conditioned and b is smooth. One product.
  scalar first_way(state_type& s) const {
    if (s.reduced_gradient_norm == scalar(0)) return scalar(0);
    slant::apply(qp_.get().a(), s.reduced, s.lagrangian, s.a_workspace);
    ++s.work.setup_applications;
    scalar const bend = inner_product(s.reduced, s.lagrangian);
    scalar const best = inner_product(s.reduced, s.reduced) / bend;
    bool const bent = bend > scalar(0) && detail::is_finite(best);
    return s.reduced_gradient_norm * (bent ? best : s.step_length);
  }

  /// ν_i z_i = ϑ at x.
  void begin(state_type& s, scalar const& force, scalar const& length) const {
    auto const& qp = qp_.get();
    s.gradient(qp);
    detail::check_finite("A x0 - b", s.r);
    s.reduce(qp);
    auto const& live = s.barrier.per_unit().array();
    slant::local(s.row_scratch) = (live > scalar(0)).template cast<scalar>().matrix();
    scalar const count = inner_product(s.row_scratch, s.row_scratch);
    s.constraints = static_cast<index>(count + scalar(0.5));
    static_cast<void>(s.barrier.slacks(blocks(), s.x, s.slacks));
    slant::local(s.trial_slacks) =
        ((live > scalar(0)).template cast<scalar>() * slant::local(s.slacks).array().min(length))
            .matrix();
    scalar const ϑ = s.constraints > 0
                         ? scalar(force * inner_product(s.trial_slacks, s.row_scratch) / count)
                         : scalar(0);
    slant::local(s.multipliers) =
        (live > scalar(0))
            .select(ϑ / slant::local(s.slacks).array(), column::Zero(live.size()))
            .matrix();
    s.barrier.linearise(blocks(), s.x);
    set_lagrangian(s, s.r, s.multipliers);
    s.measure = ϑ;
    s.residual_bound =
        options_.residual_factor * std::max<scalar>(s.lagrangian_norm, s.gradient_scale / s.unit);
    if (s.constraints > 0) s.residual_bound /= ϑ;
    s.x_norm = norm(s.x);
    s.forcing = forcing_history<scalar>::starting_at(scalar(1));
    if (!detail::is_finite(s.lagrangian_norm) || !detail::is_finite(s.measure)) {
      s.status = status::breakdown;
    }
  }

  /// ∇L = gradient + G ν, G as it stands.
  void set_lagrangian(state_type& s, vector_type const& gradient, vector_type const& ν) const {
    slant::local(s.lagrangian) = slant::local(gradient);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), ν, s.lagrangian);
    s.barrier.keep_fixed(s.lagrangian);
    s.lagrangian_norm = norm(s.lagrangian);
  }

  /// min ν_i z_i over the constraints with a bound, on all processes.
  static scalar least_product(state_type const& s, vector_type const& ν, vector_type const& z) {
    scalar least = infinity;
    auto const& multiplier = slant::local(ν);
    auto const& slack = slant::local(z);
    for (index i = 0; i < index(multiplier.size()); ++i) {
      if (!(s.barrier.per_unit()(i) > scalar(0))) continue;
      scalar const product = multiplier.coeff(i) * slack.coeff(i);
      if (!(product >= least)) least = product;
    }
    return slant::minimum(s.x, least);
  }

  void choose_centring(state_type& s) const {
    s.centring = scalar(0);
    if (s.constraints == 0) return;
    scalar const ξ = least_product(s, s.multipliers, s.slacks) / s.measure;
    scalar const q = ξ < scalar(1) ? scalar((scalar(1) - ξ) / ξ) : scalar(0);
    s.centring =
        std::min(options_.centring_most,
                 std::max(options_.centring_least, scalar(options_.centring_scale * (q * q * q))));
  }

  /// Δx, A Δx and Δν; false if there is none.
  bool solve_newton(state_type& s) const {
    auto const& qp = qp_.get();
    s.barrier.assemble(blocks(), s.x, s.multipliers, s.slacks, s.unit, s.diagonal);
    auto const z = slant::local(s.slacks).array();
    auto const ν = slant::local(s.multipliers).array();
    auto& centred = slant::local(s.row_scratch);
    centred = ((s.barrier.per_unit().array() > scalar(0)).template cast<scalar>() *
               (s.centring * s.measure / z))
                  .matrix();
    slant::local(s.rhs) = slant::local(s.r);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), s.row_scratch, s.rhs);
    s.barrier.keep_fixed(s.rhs);
    scalar const target = s.forcing.next(options_.forcing) * norm(s.rhs);
    auto const inner = s.inner.solve(qp.a(), s.a_workspace, s.barrier, s.rhs, target,
                                     options_.inner_steps, options_.warm_start);
    s.inner_iterations = inner.iterations;
    s.work.inner_iterations += inner.iterations;
    s.work.operator_applications += inner.iterations;
    slant::local(s.step) = s.unit * slant::local(s.inner.t);
    s.step_norm = norm(s.step);
    if (!inner.finite || !detail::is_finite(s.step_norm)) {
      s.status = status::breakdown;
      return false;
    }
    s.barrier.jacobian().apply(s.step, s.multiplier_step);
    auto& dν = slant::local(s.multiplier_step);
    dν = (centred.array() - ν + ν / z * dν.array()).matrix();
    return true;
  }

  /// Is Δx a direction without curvature and without end in which q falls (recession.hpp)?
  bool descends_for_ever(state_type& s) const {
    if constexpr (spd_operator<typename problem::operator_type, vector_type>) {
      return false;
    } else {
      // The trace of A is at least its largest eigenvalue.
      slant::local(s.trial).setOnes();
      scalar const trace = inner_product(s.trial, s.diagonal) / s.unit;
      if (inner_product(s.step, s.inner.image) > flatness(s.step, trace)) return false;
      scalar const slope = -inner_product(s.step, s.r);
      return is_descent(slope, s.step, scalar(s.size_of_b + norm(s.r))) && !(way_out(s) < infinity);
    }
  }

  /// sup{α : x + α Δx ∈ Λ} on all processes.
  scalar way_out(state_type const& s) const {
    return slant::minimum(
        s.x, scalar(blocks().step_to_boundary(slant::local(s.x), slant::local(s.step))));
  }

  /// The step length α and the point at its end.
  void shorten(state_type& s) const {
    scalar to_end = way_out(s);
    auto const& ν = slant::local(s.multipliers);
    auto const& dν = slant::local(s.multiplier_step);
    scalar of_ν = infinity;
    for (index i = 0; i < index(ν.size()); ++i) {
      if (dν.coeff(i) < scalar(0)) of_ν = std::min<scalar>(of_ν, -ν.coeff(i) / dν.coeff(i));
    }
    to_end = std::min(to_end, slant::minimum(s.x, of_ν));
    scalar α = std::min<scalar>(scalar(1), options_.to_boundary * to_end);
    for (index j = 0; j < options_.shortenings && α > scalar(0); ++j) {
      scalar const factor = judge(s, α);
      if (factor == scalar(1)) {
        accept(s, α);
        return;
      }
      α *= factor;
    }
    s.status = status::stalled;
  }

  /// The point at the fraction α of the step: 1 if it will do, else the factor that shortens α.
  scalar judge(state_type& s, scalar const& α) const {
    slant::local(s.trial) = slant::local(s.x) + α * slant::local(s.step);
    slant::local(s.trial_multipliers) =
        slant::local(s.multipliers) + α * slant::local(s.multiplier_step);
    bool const inside = s.barrier.slacks(blocks(), s.trial, s.trial_slacks) ||
                        (draw_inside(s), s.barrier.slacks(blocks(), s.trial, s.trial_slacks));
    if (!slant::everywhere(s.x, inside)) return options_.shorten_centred;
    if (s.constraints == 0) return scalar(1);
    scalar const measure =
        inner_product(s.trial_multipliers, s.trial_slacks) / scalar(s.constraints);
    if (!(least_product(s, s.trial_multipliers, s.trial_slacks) >= options_.closeness * measure)) {
      return options_.shorten_centred;
    }
    scalar const fall = scalar(1) - α * options_.sufficient * (scalar(1) - s.centring);
    if (!(measure <= fall * s.measure)) return options_.shorten_measure;
    s.barrier.linearise(blocks(), s.trial);
    slant::local(s.rhs) = slant::local(s.r) + α * slant::local(s.inner.image);
    set_lagrangian(s, s.rhs, s.trial_multipliers);
    if (!(s.lagrangian_norm <= s.residual_bound * measure)) return options_.shorten_residual;
    s.measure = measure;
    return scalar(1);
  }

  /// Blocks of the trial point that were rounded onto their boundary go back by a few units of the
  /// last digit, towards their middle.
  void draw_inside(state_type& s) const {
    slant::visit_blocks(blocks(), [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (detail::inequalities_of<block_type> > 0) {
        auto const from = place.value(s.trial);
        auto const middle = place.value(s.centre);
        auto at = from;
        scalar back = scalar(2) * std::numeric_limits<scalar>::epsilon();
        while (!(block.inequality(at).maxCoeff() < scalar(0)) && back < scalar(1e-6)) {
          at = from + back * (middle - from);
          back *= scalar(2);
        }
        place.put(s.trial, at);
      }
    });
  }

  void accept(state_type& s, scalar const& α) const {
    std::swap(s.x, s.trial);
    std::swap(s.multipliers, s.trial_multipliers);
    std::swap(s.slacks, s.trial_slacks);
    slant::local(s.r) += α * slant::local(s.inner.image);
    if (s.constraints == 0) set_lagrangian(s, s.r, s.multipliers);
    ++s.since_refresh;
    s.step_fraction = α;
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
    auto const no_energy = [] { return std::pair(scalar(infinity), scalar(0)); };
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, no_energy)) {
      s.status = status::stalled;
    }
  }

  /// D and α. Not inlined: g++ 12 would see *step_length read where there is none.
  [[gnu::noinline]] void set_diagonal(state_type& s) const {
    auto const& qp = qp_.get();
    auto const mean = estimate_diagonal(qp.a(), qp.set(), options_.mean_diagonal, s.diagonal);
    s.work.setup_applications += mean.applications;
    if (options_.step_length) {
      s.step_length = *options_.step_length;
      return;
    }
    s.step_length = mean.value > scalar(0) ? scalar(scalar(0.5) / mean.value) : scalar(1);
    if (!(s.step_length > scalar(0)) || !detail::is_finite(s.step_length)) {
      throw bad_input("A", "mean of the diagonal " + detail::show(mean.value),
                      "one whose reciprocal is a finite number > 0");
    }
  }

  held<QP> qp_;
  options options_;
};

}  // namespace slant
