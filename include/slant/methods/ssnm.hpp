// SPDX-License-Identifier: MIT
//
// The semismooth Newton method of the thesis for min ½xᵀA x − bᵀx over smooth inequalities f(x) ≤ 0
// [T §2.3, Algorithm SSNM]:
//
//     STEP 1   𝒜 = {i : zᵢ + ρ fᵢ(x) > 0}, ℐ the others
//     STEP 2   F°(y) y⁺ = F°(y) y − F(y),  y = (x, z), with F of [T (2.11)], F° of [T (2.13)]
//     STEP 3   err = ‖x⁺ − x‖ / (‖x⁺‖ + 1); stop if err < tol
//
// The linear solver is a part: saddle_direct ("without any adjustments"), or the three
// implementations of [T §3], schur_bicgstab (A), bicgstab_solver (B), schur_cg (C). They solve for
// the increments y⁺ − y from zero, which is the warm start of [T Remark 3.1], to the adaptive
// precision of [T §3.4].
//
// Converges locally and superlinearly; there is no globalisation, and from zero it may cycle (the ×
// cells of [T Table 4.2]). For a globalised run the same function and solvers fit into
// semismooth_newton; the default method is another one.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/estimated_multipliers.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/methods/ssnm_options.hpp>
#include <slant/methods/ssnm_problem.hpp>
#include <slant/methods/ssnm_state.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// SSNM: solve(ssnm{qp, solver, options}, x0, step_below(tol, 1.0) || at_most(1000)); step_below
/// with the offset 1 is the rule of [T], in which 1 has the unit of x.
/// Requires a separable_qp whose set is made of blocks with smooth inequalities and, for the
/// solvers other than bicgstab_solver, whose A is a matrix.
template <class QP, class LinearSolver>
  requires ssnm_parts<std::remove_cvref_t<QP>, LinearSolver>
class ssnm<QP, LinearSolver> {
  using problem_type = std::remove_cvref_t<QP>;

 public:
  using vector_type = typename problem_type::vector_type;
  using scalar = typename problem_type::scalar;
  using function_type = ssnm_function<problem_type>;
  using state_type = ssnm_state<function_type, vector_type, LinearSolver>;
  using options = ssnm_options<scalar>;

  /// Throws bad_input for options out of range.
  explicit ssnm(held<QP> qp, LinearSolver solver = {}, options o = {})
      : qp_(std::move(qp)),
        solver_(std::move(solver)),
        options_(validated(o)),
        f_(slant::kkt(qp_.get().a(), qp_.get().b(), qp_.get().set(), options_.rho)) {
    solver_.validate();
  }

  /// Multipliers as the option says. Throws bad_input if x0 or F is not finite or of the wrong
  /// size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    check(x0);
    auto z = like(x0, f_.multipliers());
    vectors::set_zero(z);
    if (options_.multipliers == ssnm_multipliers::zero) return start(x0, z);
    auto r = like(x0, f_.unknowns());
    slant::apply(problem().a(), x0, r);
    vectors::subtract(problem().b(), r);
    estimated_multipliers(problem().set(), x0, r, z);
    auto s = start(x0, z);
    ++s.work.setup_applications;
    return s;
  }
  /// From x⁰ and (λ⁰, μ⁰) = z⁰.
  [[nodiscard]] state_type start(vector_type const& x0, vector_type const& z0) const {
    check(x0);
    detail::check_size("z0", index(slant::local(z0).size()), f_.multipliers());
    detail::check_finite("z0", z0);
    auto blank = [&] { return like(x0, f_.cols()); };
    auto y = blank();
    x_of(y) = slant::local(x0);
    z_of(y) = slant::local(z0);
    auto residual = blank();
    auto f_workspace = slant::workspace(f_, y);
    slant::evaluate(f_, y, residual, f_workspace);
    detail::check_finite("F(x0)", residual);
    auto g = f_.slant(y);
    auto prepared = solver_.prepare(g, residual);
    state_type s{x0,
                 z0,
                 y,
                 std::move(residual),
                 blank(),
                 std::move(g),
                 std::move(f_workspace),
                 std::move(prepared)};
    s.forcing = forcing_history<scalar>::starting_at(scalar(1));
    s.residual_scale = norm(problem().b());
    classify(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    scalar const tolerance = inner_tolerance(s);
    auto const r = solver_.solve(s.slant_operator, s.residual, {tolerance, s.residual_norm, 0},
                                 s.direction, s.prepared);
    s.solver_status = r.status;
    s.linear_residual = r.residual_norm;
    s.inner_iterations = r.iterations;
    s.work.inner_iterations += r.iterations;
    s.work.operator_applications += r.operator_applications;
    s.work.factorizations += r.factorizations;
    if (!(r.residual_norm < s.residual_norm)) {
      s.status = r.status == status::breakdown ? status::breakdown : status::stalled;
      return;
    }
    vectors::add(s.direction, s.y);
    slant::evaluate(f_, s.y, s.residual, s.f_workspace);
    slant::update_slant_after_value(f_, s.y, s.slant_operator, s.f_workspace);
    vectors::negate(s.x, s.x);
    slant::local(s.x) += x_of(s.y);
    s.step_norm = norm(s.x);
    slant::local(s.x) = x_of(s.y);
    slant::local(s.multipliers) = z_of(s.y);
    ++s.iteration;
    classify(s);
    s.forcing.record(s.step_norm / (s.x_norm + scalar(1)));
  }

 private:
  [[nodiscard]] problem_type const& problem() const { return qp_.get(); }

  static options validated(options const& o) {
    o.validate();
    return o;
  }
  void check(vector_type const& x0) const {
    detail::check_size("x0", index(slant::local(x0).size()), f_.unknowns());
    detail::check_finite("x0", x0);
  }
  template <class Y>
  [[nodiscard]] auto x_of(Y& y) const {
    return slice(f_.cols(), 0, f_.unknowns()).segment(y);
  }
  template <class Y>
  [[nodiscard]] auto z_of(Y& y) const {
    return slice(f_.cols(), f_.unknowns(), f_.multipliers()).segment(y);
  }

  void classify(state_type& s) const {
    s.residual_norm = norm(s.residual);
    s.x_norm = norm(s.x);
    s.active = index(slant::local(s.slant_operator.active()).count());
    if (s.residual_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.residual_norm)) s.status = status::breakdown;
  }
  /// tol⁽ᵏ⁾, relative to ‖F(y)‖.
  [[nodiscard]] scalar inner_tolerance(state_type& s) const {
    scalar const tol = options_.inner_tolerance > scalar(0) ? options_.inner_tolerance
                                                            : s.forcing.next(options_.precision);
    if (!options_.absolute_precision) return tol;
    // More than all of F cannot be asked to go: a direction that changes nothing helps nobody.
    return std::min<scalar>(tol / s.residual_norm, scalar(0.5));
  }

  held<QP> qp_;
  LinearSolver solver_;
  options options_;
  function_type f_;
};

template <class QP>
ssnm(QP&&) -> ssnm<kept_t<QP>>;
template <class QP, class LinearSolver>
ssnm(QP&&, LinearSolver) -> ssnm<kept_t<QP>, LinearSolver>;
template <class QP, class LinearSolver>
ssnm(QP&&, LinearSolver, ssnm_options<typename std::remove_cvref_t<QP>::scalar>)
    -> ssnm<kept_t<QP>, LinearSolver>;

}  // namespace slant
