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
// with x by Nesterov and Todd (parts/lorentz_pairs.hpp). Next to a curved boundary a multiplier
// along the gradient leaves x no way to go: a unit disc in the plane took 1767 steps to nowhere.
// All other inequalities keep ν_i, with the slacks z = −f(x), which are no unknowns of their own.
// So every iterate is a point of the interior, f(x) + z = 0 always holds, and W is semidefinite
// even where f is not convex (barrier.hpp). c_min is a fifth, not 1e-30: with no centring the
// iterates run into the boundary and the next steps are short. ϑ may not fall much faster than the
// first ∇L does, for the same reason. The start lies on a curve ν_i z_i = ϑ with lengths and forces
// taken from the data, so that units do not matter, and at P_Λ(0) where q is smaller there than at
// P_Λ(x0); where the forces turn out too small, and steps short for that reason, they are raised.
// Components without constraint have no multiplier, no slack and no part in ϑ.
//
// Rejected, by measurement: a predictor and a corrector in every step. They take fewer steps but
// more products, as the second right-hand side needs conjugate gradients of its own.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/parts/recession.hpp>
#include <slant/operators/identity.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/block_queries.hpp>

#if SLANT_USES_COMPILED
#include <slant/problems/any_qp.hpp>
#endif

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace slant {

/// What interior_point works on: min ½ xᵀA x − bᵀx over x ∈ Λ, A symmetric positive semidefinite,
/// Λ a product of blocks with smooth inequalities in which a step to the boundary is known.
template <class QP>
concept interior_point_problem =
    quadratic_program<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type> &&
    convex_set<typename QP::set_type, local_t<typename QP::vector_type>> &&
    has_block_inequalities<typename QP::set_type, local_t<typename QP::vector_type>> &&
    has_step_to_boundary<typename QP::set_type, local_t<typename QP::vector_type>>;

namespace detail {

template <class QP, class M>
struct interior_point_demands {
  static constexpr bool told = true;
};
template <askable_program QP, class M>
struct interior_point_demands<QP, M> {
  using set_type = typename QP::set_type;
  using points = local_t<typename QP::vector_type>;
  static constexpr bool smooth = has_block_inequalities<set_type, points>;
  static_assert(smooth,
                "the set must be made of blocks with a smooth inequality form and "
                "step_to_boundary(x, d)");
  static_assert(!smooth || has_step_to_boundary<set_type, points>,
                "the set must have step_to_boundary(x, d)");
  static constexpr bool told =
      preconditioner_demands<M, typename QP::vector_type, law_demand::semidefinite>::told;
};

}  // namespace detail

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP, class M = identity_operator>
class interior_point : public detail::refused_program<
                           QP, interior_point_state<std::remove_cvref_t<QP>, identity_operator>,
                           interior_point_options<detail::program_scalar_t<QP>>> {
  static_assert(detail::program_demands<std::remove_cvref_t<QP>>::told);
  static_assert(
      detail::interior_point_demands<std::remove_cvref_t<QP>, std::remove_cvref_t<M>>::told);

 public:
  using interior_point::refused_method::refused_method;
};

template <class QP>
interior_point(QP&&, interior_point_options<detail::program_scalar_t<QP>> = {})
    -> interior_point<kept_t<QP>, identity_operator>;
template <class QP, class M>
interior_point(QP&&, M&&, interior_point_options<detail::program_scalar_t<QP>> = {})
    -> interior_point<kept_t<QP>, kept_t<M>>;

namespace detail {

/// What `interior_point` does with a problem that has all it needs.
template <class QP, class M>
class interior_point_steps : public preconditioned_program<QP, M, interior_point_options> {
  using base = preconditioned_program<QP, M, interior_point_options>;
  using base::qp_, base::m_, base::options_, base::preconditioned;

 public:
  using typename base::problem, typename base::vector_type, typename base::scalar;
  using state_type = interior_point_state<problem, typename base::preconditioner>;
  using base::base;

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
  [[nodiscard]] auto const& blocks() const { return qp_.get().set(); }

  static constexpr index patience = 30;       // steps without progress that mean stalled
  static constexpr index inner_steps = 1000;  // of conjugate gradients in one Newton step at most
  /// Inner accuracy, relative to the right-hand side: not the one that [K §3.2.4] proposes (0.1 and
  /// 0.9), but that of its Table 3 with the fewest products.
  static constexpr adaptive_precision forcing{.r_tol = 0.3, .c_fact = 0.99};

  // The constants of [K §3.2.4] are γ, ω, ρ and those of c but c_min.
  static constexpr double closeness = 1e-3;          // γ: ν_i z_i ≥ γ ϑ
  static constexpr double sufficient = 0.1;          // ω: ϑ⁺ ≤ (1 − α ω (1 − c)) ϑ
  static constexpr double centring_most = 0.5;       // c_max
  static constexpr double centring_scale = 1.25e-5;  // c_s
  static constexpr double residual_factor = 1e9;  // β₀: ‖∇L‖ ≤ β ϑ with β₀ times the β of the start
  static constexpr double to_boundary = 0.999;  // at most so much of the way there
  static constexpr double shorten = 0.9;  // ρ₁, ρ₂: of α until ν_i z_i ≥ γ ϑ, ϑ falls enough
  static constexpr double shorten_residual = 0.5;  // ρ₃: of α until ‖∇L‖ ≤ β ϑ
  static constexpr index shortenings = 200;        // at most so often in one step
  /// ϑ⁺ ≥ ahead · φ ϑ⁰, φ = Π(1 − α) what the steps leave of the first ∇L: ϑ that falls faster
  /// brings the iterates to the boundary at the wrong place. It may also grow up to grow · φ ϑ⁰.
  static constexpr double ahead = 0.1, grow = 10;
  /// Where, before any long step, a Newton step would leave Λ within 1/raise_above of its length and
  /// predicts multipliers so many times as large, ν and ϑ are raised to them. Halves the steps of a
  /// flow past an obstacle (examples/stokes, g = 10) and leaves the bricks as they are.
  static constexpr double raise_above = 5;
  static constexpr index most_raises = 10;
  /// c_z: first slacks of sets without an end, in natural lengths, where [K] has 1 as for c_ν. With
  /// a tenth there are twice as many steps.
  static constexpr double start_length = 3;
  // Where the set has discs or cones, on which force and point turn into line at the rate of ϑ,
  // these are larger.
  /// c_ν: first multipliers, in natural forces. On bricks 0.6 takes fewer products than 0.3.
  static scalar start_force(state_type const& s) { return scalar(s.pairs.empty() ? 0.3 : 0.6); }
  /// c_min, 1e-30 in [K].
  static scalar least_centring(state_type const& s) { return scalar(s.pairs.empty() ? 0.1 : 0.2); }
  /// A step shorter than this is computed again with its own second-order term [Mehrotra]; the
  /// longer of the two is made. 0: never.
  static scalar correct_below(state_type const& s) { return scalar(s.pairs.empty() ? 0 : 0.3); }

  static constexpr scalar infinity = detail::infinity<scalar>();

  /// D, and α = ½ / mean(diag A) of the reduced gradient.
  void set_diagonal(state_type& s) const {
    auto const& qp = qp_.get();
    auto const of_a = [&] {
      if constexpr (preconditioned) {
        static_cast<void>(
            estimate_diagonal(m_.get(), qp.set(), options_.mean_diagonal, s.diagonal, "M"));
        slant::local(s.diagonal) = slant::local(s.diagonal).cwiseInverse();
        return mean_diagonal(qp.a(), s.x, options_.mean_diagonal);
      } else {
        return estimate_diagonal(qp.a(), qp.set(), options_.mean_diagonal, s.diagonal);
      }
    };
    auto const mean = of_a();
    s.work.setup_applications += mean.applications;
    s.trace = mean.value * scalar(slant::global_size(s.x));
    s.step_length = mean.value > scalar(0) ? scalar(scalar(0.5) / mean.value) : scalar(1);
    check_step_length(s.step_length, "mean of the diagonal", mean.value);
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
    bool const bent = bend > flatness(s.reduced, s.trace) && is_finite(best);
    return s.reduced_gradient_norm * (bent ? best : s.step_length);
  }

  /// x, which is P_Λ(0), becomes P_Λ(x0) unless q is larger there: far from everything the method
  /// would have to find its forces anew on the way. One product, none if the two are the same.
  void choose_start(state_type& s, vector_type const& x0) const {
    auto const& qp = qp_.get();
    slant::project(qp.set(), slant::local(x0), slant::local(s.projected));
    vectors::difference(s.projected, s.x, s.trial);
    if (norm(s.trial) == scalar(0)) return;
    // q(P_Λ(x0)) − q(x) = dᵀ(r + ½ A d), d the way there.
    slant::apply(qp.a(), s.trial, s.reduced, s.a_workspace);
    ++s.work.setup_applications;
    check_finite("A x0", s.reduced);
    vectors::waxpy(scalar(1) / (scalar(2) * s.unit), s.reduced, s.r, s.reduced);
    if (!(inner_product(s.trial, s.reduced) > scalar(0))) s.x = s.projected;
  }

  /// ν_i z_i = ϑ at x.
  void begin(state_type& s, scalar const& force, scalar const& length) const {
    auto const& qp = qp_.get();
    s.gradient(qp);
    check_finite("A x0 - b", s.r);
    s.reduce(qp);
    static_cast<void>(s.barrier.slacks(blocks(), s.x, s.slacks));
    count(s);
    slant::local(s.products) =
        slant::local(s.counted).cwiseProduct(slant::local(s.slacks).cwiseMin(length));
    scalar const ϑ = s.degree > scalar(0)
                         ? scalar(force * inner_product(s.products, s.counted) / s.degree)
                         : scalar(0);
    slant::local(s.multipliers) =
        slant::local(s.smooth).cwiseProduct((ϑ / slant::local(s.slacks).array()).matrix());
    vectors::scale(ϑ, s.counted, s.products);
    s.measure = ϑ;
    s.first_measure = ϑ;
    s.infeasible = scalar(1);
    s.least = ϑ;
    s.pairs.begin(blocks(), s.x, s.barrier.per_unit(), ϑ);
    estimate_multipliers(s);
    s.barrier.linearise(blocks(), s.x);
    set_lagrangian(s, s.r, s.multipliers, scalar(0));
    s.residual_bound =
        scalar(residual_factor) * std::max<scalar>(s.lagrangian_norm, s.gradient_scale / s.unit);
    if (s.constraints > 0) s.residual_bound /= ϑ;
    s.x_norm = norm(s.x);
    s.forcing = forcing_history<scalar>::starting_at(scalar(1));
    if (!is_finite(s.lagrangian_norm) || !is_finite(s.measure)) {
      s.status = status::breakdown;
    }
  }

  /// ν and ϑ of the size that the Newton step Δx, Δν asks for, if those at hand are too small by
  /// far: Δx leaves Λ almost at once, as no force holds it back. Whether they were.
  bool raise(state_type& s) const {
    if (s.constraints == 0 || s.under_way || s.raises == most_raises) return false;
    vectors::sum(s.multipliers, s.multiplier_step, s.trial_multipliers);
    s.pairs.growth(blocks(), [&](index row, scalar const& factor) {
      slant::local(s.trial_multipliers).coeffRef(row) =
          factor * slant::local(s.multipliers).coeff(row);
    });
    scalar const growth = norm(s.trial_multipliers) / norm(s.multipliers);
    if (!(growth > scalar(raise_above)) || !is_finite(growth) ||
        scalar(raise_above) * way_out(s, s.step) > scalar(1)) {
      return false;
    }
    vectors::scale(growth, s.multipliers);
    vectors::scale(growth, s.products);
    s.pairs.raise(growth);
    s.measure *= growth;
    s.first_measure = s.measure / s.infeasible;
    s.least *= growth;
    set_lagrangian(s, s.r, s.multipliers, scalar(0));
    ++s.raises;
    return true;
  }

  /// Which rows are counted, and which of them have a multiplier of their own.
  void count(state_type& s) const {
    auto& counted = slant::local(s.counted);
    counted = (s.barrier.per_unit().array() > scalar(0)).template cast<scalar>().matrix();
    s.constraints = index(inner_product(s.counted, s.counted) + scalar(0.5));
    vectors::copy(s.counted, s.smooth);
    s.pairs.visit(blocks(), [&](auto const& block, auto const&, auto const& at) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      for (int i = 0; i < k; ++i) {
        slant::local(s.smooth).coeffRef(at.row + i) = scalar(0);
        if (i > 0) counted.coeffRef(at.row + i) = scalar(0);
      }
    });
    s.degree = inner_product(s.counted, s.counted);
  }

  /// The multipliers of the inequalities of pairs: y_0/(2 p_0) of the first, next to none of the
  /// one that tells the two halves of a cone apart.
  void estimate_multipliers(state_type& s) const {
    auto& ν = slant::local(s.multipliers);
    auto const& z = slant::local(s.slacks);
    s.pairs.visit_bound(blocks(), [&](auto const& block, auto const& place, auto const& at) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      ν.coeffRef(at.row) = s.pairs.multiplier(block, place, at, s.x) / s.barrier.per_unit()(at.row);
      for (int i = 1; i < k; ++i) ν.coeffRef(at.row + i) = s.measure / z.coeff(at.row + i);
    });
  }

  /// ∇L = gradient + G ν − Σ Tᵀ(y + αΔy), G as it stands.
  void set_lagrangian(state_type& s, vector_type const& gradient, vector_type const& ν,
                      scalar const& α) const {
    vectors::copy(gradient, s.lagrangian);
    vectors::multiply(s.smooth, ν, s.row_scratch);
    s.barrier.jacobian().apply_adjoint_add(scalar(1), s.row_scratch, s.lagrangian);
    s.pairs.subtract_forces(blocks(), α, s.lagrangian);
    s.barrier.keep_fixed(s.lagrangian);
    s.lagrangian_norm = norm(s.lagrangian);
  }

  /// The smallest of the counted products of rows without a pair, on this process.
  static scalar least_product(state_type const& s) {
    scalar least = infinity;
    auto const& smooth = slant::local(s.smooth);
    for (index i = 0; i < index(smooth.size()); ++i) {
      scalar const& product = slant::local(s.products).coeff(i);
      if (smooth.coeff(i) > scalar(0) && !(product >= least)) least = product;
    }
    return least;
  }

  /// sup{α : x + α d ∈ Λ} on all processes.
  scalar way_out(state_type const& s, vector_type const& d) const {
    return slant::minimum(s.x,
                          scalar(blocks().step_to_boundary(slant::local(s.x), slant::local(d))));
  }

  /// The point at the fraction α of the step: 1 if it will do, else the factor that shortens α.
  scalar judge(state_type& s, scalar const& α) const {
    vectors::waxpy(α, s.step, s.x, s.trial);
    vectors::waxpy(α, s.multiplier_step, s.multipliers, s.trial_multipliers);
    bool inside = s.barrier.slacks(blocks(), s.trial, s.trial_slacks) ||
                  (draw_inside(s), s.barrier.slacks(blocks(), s.trial, s.trial_slacks));
    slant::local(s.products) = slant::local(s.smooth)
                                   .cwiseProduct(slant::local(s.trial_multipliers))
                                   .cwiseProduct(slant::local(s.trial_slacks));
    scalar least = least_product(s);
    inside = inside && s.pairs.judge(blocks(), s.trial, α, s.products, least);
    if (!slant::everywhere(s.x, inside)) return scalar(shorten);
    if (s.constraints == 0) return scalar(1);
    scalar const measure = inner_product(s.products, s.counted) / s.degree;
    if (!(slant::minimum(s.x, least) >= scalar(closeness) * measure)) {
      return scalar(shorten);
    }
    scalar const fall = scalar(1) - α * scalar(sufficient) * (scalar(1) - s.centring);
    scalar const due = (scalar(1) - α) * s.infeasible * s.first_measure;
    if (!(measure <= std::max<scalar>(fall * s.measure, scalar(grow) * due)))
      return scalar(shorten);
    if (!(measure >= scalar(ahead) * due)) {
      return scalar(shorten_residual);
    }
    s.barrier.linearise(blocks(), s.trial);
    vectors::waxpy(α, s.inner.image, s.r, s.rhs);
    set_lagrangian(s, s.rhs, s.trial_multipliers, α);
    if (!(s.lagrangian_norm <= s.residual_bound * measure)) return scalar(shorten_residual);
    s.trial_measure = measure;
    s.trial_least = slant::minimum(s.x, least);
    return scalar(1);
  }

  /// Blocks of the trial point that were rounded onto their boundary go back towards their middle,
  /// by rounding errors, so that A x is what it was.
  void draw_inside(state_type& s) const {
    slant::visit_blocks(blocks(), [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (detail::inequalities_of<block_type> > 0) {
        auto const from = place.value(s.trial);
        auto const middle = place.value(s.centre);
        auto at = from;
        scalar back = scalar(2) * detail::epsilon<scalar>();
        while (!(block.inequality(at).maxCoeff() < scalar(0)) &&
               back < scalar(1024) * detail::epsilon<scalar>()) {
          at = from + back * (middle - from);
          back *= scalar(2);
        }
        place.put(s.trial, at);
      }
    });
  }

  void choose_centring(state_type& s) const {
    s.centring = scalar(0);
    if (s.constraints == 0) return;
    scalar const ξ = s.least / s.measure;
    scalar const q = ξ < scalar(1) ? scalar((scalar(1) - ξ) / ξ) : scalar(0);
    s.centring =
        std::min(scalar(centring_most),
                 std::max(least_centring(s), scalar(scalar(centring_scale) * (q * q * q))));
  }

  /// c where a step had the length α [Mehrotra].
  [[nodiscard]] static scalar centring_after(state_type const& s, scalar const& α) {
    scalar const rest = scalar(1) - α;
    return std::min(scalar(centring_most), std::max<scalar>(least_centring(s), rest * rest * rest));
  }

  /// Δx, A Δx and Δν; false if there is none. `again`: in place of the step at hand; `corrected`:
  /// that much of its second-order term is taken into account.
  bool solve_newton(state_type& s, bool again = false, scalar const& corrected = scalar(0)) const {
    auto const& qp = qp_.get();
    s.pairs.scale(blocks(), s.x);
    s.barrier.assemble(blocks(), s.x, s.multipliers, s.slacks, s.unit, s.diagonal, s.pairs);
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
    s.pairs.subtract_target(blocks(), aim, corrected, s.rhs);
    s.barrier.keep_fixed(s.rhs);
    // rhs = r + G(…): what is left of the two below the rounding error of r cannot be told from it.
    scalar const target = std::max<scalar>(
        s.forcing.next(forcing) * norm(s.rhs) * scalar(corrected > scalar(0) ? 0.3 : 1.0),
        detail::epsilon<scalar>() * norm(s.r));
    // A step that was cut short says little about the next one.
    bool const warm = again || s.step_fraction > scalar(0.1);
    auto const inner = s.inner.solve(qp.a(), s.a_workspace, m_.get(), s.barrier, s.diagonal, s.rhs,
                                     target, options_.inner_share, inner_steps, warm, s.trace);
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
    s.pairs.set_step(blocks(), s.step);
    return true;
  }

  /// Is Δx, or the direction at which conjugate gradients ended, one without curvature and without
  /// end in which q falls (parts/recession.hpp)? Or Δx less its part in range(A), where steps are
  /// long and hardly anything of the last could be gone? step is this direction then.
  bool descends_for_ever(state_type& s) const {
    if constexpr (spd_operator<typename problem::operator_type, vector_type>) {
      return false;
    } else {
      auto const is_flat = [&](vector_type const& d, vector_type const& image) {
        return !(inner_product(d, image) > flatness(d, s.trace));
      };
      // Seldom asked, for the products that it takes.
      bool const drifts = s.step_fraction < scalar(0.01) && s.iteration > 0 &&
                          (s.iteration & (s.iteration + 1)) == 0;
      if ((drifts || is_flat(s.inner.t, s.inner.image)) &&
          is_endless(s, s.inner.t, s.inner.image)) {
        return true;
      }
      return s.inner.flat && is_flat(s.inner.direction, s.inner.direction_image) &&
             is_endless(s, s.inner.direction, s.inner.direction_image);
    }
  }
  bool is_endless(state_type& s, vector_type const& d, vector_type const& image) const {
    constexpr index most_products = 100;
    if (!(inner_product(d, s.r) < scalar(0))) return false;
    vectors::copy(d, s.trial);
    vectors::copy(image, s.rhs);
    if (way_out(s, d) < infinity) {
      // What of d leads out of Λ is left away: (P_Λ(x + τ d) − x)/τ for a long τ.
      scalar const long_way = unit_near(norm(s.x)) / (detail::epsilon<scalar>() * norm(d));
      if (!detail::is_finite(long_way)) return false;
      vectors::waxpy(long_way, d, s.x, s.trial);
      slant::project(qp_.get().set(), slant::local(s.trial), slant::local(s.trial));
      vectors::difference(s.trial, s.x, s.trial);
      vectors::scale(scalar(1) / long_way, s.trial);
      if (!(inner_product(s.trial, s.r) < scalar(0))) return false;
      slant::apply(qp_.get().a(), s.trial, s.rhs, s.a_workspace);
      ++s.work.operator_applications;
    }
    scalar const σ = s.trace / scalar(slant::global_size(s.x));
    auto const keep = [&](vector_type const& x, vector_type& y) {
      vectors::copy(x, y);
      s.barrier.keep_fixed(y);
    };
    bool const is_one = confirm_descent(qp_.get(), s, keep, s.trial, s.rhs, s.reduced, s.lagrangian,
                                        s.projected, σ, most_products);
    if (is_one) vectors::copy(s.trial, s.step);
    s.reduce(qp_.get());
    return is_one;
  }

  /// The step length α, 0 if there is none; the point at its end is the trial point.
  scalar length(state_type& s) const {
    scalar to_end = way_out(s, s.step);
    auto const& ν = slant::local(s.multipliers);
    auto const& dν = slant::local(s.multiplier_step);
    scalar of_ν = infinity;
    for (index i = 0; i < index(ν.size()); ++i) {
      if (dν.coeff(i) < scalar(0)) of_ν = std::min<scalar>(of_ν, -ν.coeff(i) / dν.coeff(i));
    }
    of_ν = std::min<scalar>(of_ν, s.pairs.way_out(blocks()));
    to_end = std::min(to_end, slant::minimum(s.x, of_ν));
    scalar α = std::min<scalar>(scalar(1), scalar(to_boundary) * to_end);
    for (index j = 0; j < shortenings && α > scalar(0); ++j) {
      scalar const factor = judge(s, α);
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
    s.pairs.accept(blocks(), α);
    estimate_multipliers(s);
    if (s.constraints == 0) set_lagrangian(s, s.r, s.multipliers, scalar(0));
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
    detail::judge_reduced_gradient(s);
    if (s.status != status::running) return;
    if (s.progress.stalled(s.iteration, s.reduced_gradient_norm, patience)) {
      s.status = status::stalled;
    }
  }
};

template <class QP, class M>
auto interior_point_steps<QP, M>::start(vector_type const& x0) const -> state_type {
  auto const& qp = qp_.get();
  detail::check_start_in_set(x0, qp.b());
  state_type s(qp, m_.get(), x0);
  set_diagonal(s);
  auto origin = like(x0, qp.size());
  vectors::set_zero(origin);
  bool const solved = s.begin(qp, origin);
  using std::sqrt;
  scalar const per_entry = sqrt(scalar(scalar(1) / scalar(slant::global_size(x0))));
  scalar const force = start_force(s) * norm(s.r) * per_entry;
  scalar const length = scalar(start_length) * first_way(s) * per_entry;
  if (!solved) choose_start(s, x0);
  s.trial = s.x;
  enter_interior(blocks(), solved ? scalar(1) : length, s.x, s.barrier.per_unit(),
                 [&](auto const& place) { s.barrier.hold(place); });
  vectors::copy(s.x, s.centre);
  if (solved) {
    s.x = s.trial;
    s.status = status::converged;
    return s;
  }
  begin(s, force, length);
  return s;
}

template <class QP, class M>
void interior_point_steps<QP, M>::step(state_type& s) const {
  if (s.status != status::running) return;
  choose_centring(s);
  bool solved = solve_newton(s);
  while (solved && raise(s)) solved = solve_newton(s, true);
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
  set_lagrangian(s, s.r, s.multipliers, scalar(0));
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
