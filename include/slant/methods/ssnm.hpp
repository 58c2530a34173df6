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

#include <slant/base/diagnosis.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/saddle_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/slanting/inequality_jacobian.hpp>
#include <slant/slanting/kkt_function.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// F of [T (2.11)] for a quadratic program, of which it refers to A and the set.
template <quadratic_program QP>
using ssnm_function = kkt_function<typename QP::operator_type const&, typename QP::vector_type,
                                   typename QP::set_type const&>;

/// A quadratic program, and a linear solver for its F°.
template <class QP, class LinearSolver>
concept ssnm_parts =
    quadratic_program<QP> && !detail::was_refused<QP> &&
    direction_solver<LinearSolver, slant_operator_t<ssnm_function<QP>, typename QP::vector_type>,
                     typename QP::vector_type>;

/// Where the multipliers of SSNM begin.
enum class ssnm_multipliers : unsigned char {
  zero,      ///< z = 0, whatever x is
  estimated  ///< those that x asks for, see estimated_multipliers
};

/// Options of ssnm.
template <class S>
struct ssnm_options {
  /// ρ > 0 of [T (2.8)], in units of A for half lines and intervals, of A over length for balls:
  /// the only place where the scale of A matters. [T] takes 1 with A = tridiag(−1, 2, −1).
  S rho = S(1);
  /// r_tol and c_fact of the adaptive precision [T §3.4]. Inner iterations of solvers that have any
  /// end where their residual is below tol⁽ᵏ⁾ times ‖F(y)‖.
  adaptive_precision precision{.r_tol = 0.01, .c_fact = 0.9};
  /// Not the adaptive precision but this tolerance in all steps; 0: the adaptive one.
  S inner_tolerance = S(0);
  /// tol⁽ᵏ⁾ is absolute, in units of F, as in [T]; it then depends on the units of A and b.
  bool absolute_precision = false;
  ssnm_multipliers multipliers = ssnm_multipliers::zero;

  [[gnu::cold]] void validate() const {
    detail::check_positive("rho", rho);
    precision.validate();
    detail::check_option("inner_tolerance", inner_tolerance,
                         inner_tolerance >= S(0) && inner_tolerance < S(1), "a number in [0, 1)");
  }
};

/// State of ssnm for the function F, vectors V and a linear solver.
template <class F, class V, class Solver>
struct ssnm_state {
  using scalar = scalar_t<V>;
  using slant_type = slant_operator_t<F, V>;

  V x;                                         ///< iterate
  V multipliers;                               ///< z, one per inequality
  V y;                                         ///< (x, z)
  V residual;                                  ///< F(y)
  slant_type slant_operator;                   ///< F°(y)
  workspace_t<F, V> f_workspace;               ///< temporaries of F
  prepared_t<Solver, slant_type, V> prepared;  ///< what the linear solver keeps
  V direction = residual;                      ///< dy of the last step

  scalar residual_norm{0};                        ///< ‖F(y)‖
  scalar residual_scale{0};                       ///< ‖b‖
  scalar step_norm = detail::infinity<scalar>();  ///< ‖x⁺ − x‖ of the last step
  scalar x_norm{0};                               ///< ‖x‖
  scalar linear_residual{0};                      ///< ‖F + F° dy‖ of the last step
  forcing_history<scalar> forcing{};              ///< err, and tol of the last step

  index inner_iterations = 0;  ///< of the linear solver in the last step
  index active = 0;            ///< inequalities in 𝒜 at y
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::status solver_status = slant::status::running;  ///< how the last linear solve ended
  slant::work work{};  ///< operator_applications: those of K⁻¹ in schur_bicgstab and schur_cg,
                       ///< those of F° in bicgstab_solver; evaluations of F are `iteration` + 1

  [[nodiscard, gnu::cold]] std::string reason() const {
    std::string const how(to_string(solver_status));
    return detail::reason_of(
        status,
        {.converged = "the optimality conditions hold exactly",
         .stalled = "no direction reduces ‖F‖ any more: it is down to rounding, or the inner "
                    "iteration stagnates (" +
                    how + ")",
         .breakdown = "the Newton system could not be solved (" + how +
                      "): A + Σ z ∇²f is singular, or not definite where the solver needs "
                      "it, or an active gradient vanishes or depends on others"});
  }
};

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP, class LinearSolver = schur_bicgstab>
class ssnm : public detail::refused_program<QP> {
  static consteval bool told() {
    using problem = std::remove_cvref_t<QP>;
    if constexpr (detail::askable_program<problem>) {
      using V = typename problem::vector_type;
      detail::refuse_solver<LinearSolver, slant_operator_t<ssnm_function<problem>, V>, V>();
    } else {
      static_assert(detail::program_demands<problem>::told);
    }
    return true;
  }
  static_assert(told());

 public:
  using ssnm::refused_method::refused_method;
};

// --- estimated multipliers -----------------------------------------------------------------------
//
// Multipliers for a point that another method has found, so that SSNM can go on from there: [T
// Remark 4.2] "appropriately modifies" λ and μ without saying how. Here, block by block, from
//
//     r + Σ zᵢ ∇fᵢ(x) = 0,   zᵢ ≥ 0,   zᵢ = 0 in the interior;        r = A x − b
//
// zᵢ = max(0, −∇fᵢᵀr / ‖∇fᵢ‖²) for the blocks that x is not inside of, else 0: least squares for
// each inequality by itself. At the solution these are the multipliers (of blocks with one
// inequality, or of which one at a time can be active).

/// One multiplier per smooth inequality of the set, in its order; r is the gradient A x − b. z has
/// as many entries as the set has inequalities and is overwritten.
template <class Set, class V, class Z>
void estimated_multipliers(Set const& set, V const& x, V const& r, Z&& z) {
  using S = scalar_t<V>;
  auto&& multipliers = slant::local(z);
  detail::visit_inequalities(
      set, [&](auto const& block, auto const& place, auto n, auto k, index row) {
        Eigen::Matrix<S, n, 1> const point = place.value(x);
        Eigen::Matrix<S, n, 1> const force = place.value(r);
        Eigen::Matrix<S, n, k> const gradients = block.inequality_gradient(point);
        bool inside = false;
        if constexpr (has_state<std::remove_cvref_t<decltype(block)>, Eigen::Matrix<S, n, 1>>) {
          inside = block.state(point) == block_state::free;
        } else {
          inside = (block.inequality(point).array() < S(0)).all();
        }
        for (int i = 0; i < k; ++i) {
          S const unit = unit_near(S(gradients.col(i).cwiseAbs().maxCoeff()));
          Eigen::Matrix<S, n, 1> const normal = gradients.col(i) / unit;
          S const slope = normal.squaredNorm(), push = -normal.dot(force);
          bool const pushes = !inside && push > S(0) && slope > S(0);
          multipliers[row + i] = pushes ? S(push / slope / unit) : S(0);
        }
      });
}

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

  /// F refers to the problem of its own object.
  ssnm(ssnm const& other) : ssnm(other.qp_, other.solver_, other.options_) {}
  ssnm& operator=(ssnm const&) = delete;
  /// Throws bad_input for options out of range.
  explicit ssnm(held<QP> qp, LinearSolver solver = {}, options o = {})
      : qp_(std::move(qp)),
        solver_(std::move(solver)),
        options_(o),
        f_(slant::kkt(qp_.get().a(), qp_.get().b(), qp_.get().set(), options_.rho)) {
    options_.validate();
    detail::validate_part(solver_);
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
    auto y = like(x0, f_.cols());
    x_of(y) = slant::local(x0);
    z_of(y) = slant::local(z0);
    auto residual = y;
    auto f_workspace = slant::workspace(f_, y);
    slant::evaluate(f_, y, residual, f_workspace);
    detail::check_finite("F(x0)", residual);
    auto g = slant::slant_from_value(f_, y, f_workspace);
    auto prepared = solver_.prepare(g, residual);
    state_type s{
        x0, z0, y, std::move(residual), std::move(g), std::move(f_workspace), std::move(prepared)};
    s.forcing = forcing_history<scalar>::starting_at(scalar(1));
    s.residual_scale = norm(problem().b());
    classify(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    scalar const tolerance = inner_tolerance(s);
    auto const r = solver_.solve(s.slant_operator, s.residual, {tolerance, s.residual_norm},
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

template <class QP, class LinearSolver = schur_bicgstab>
ssnm(QP&&, LinearSolver = {}, ssnm_options<detail::program_scalar_t<QP>> = {})
    -> ssnm<kept_t<QP>, LinearSolver>;

}  // namespace slant
