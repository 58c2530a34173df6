// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction solved, for those who do not want to choose: Newton's method for
// the residual of Alart and Curnier, which costs no more than a problem of Tresca's; where it ends
// without a solution (much friction, a bad start) successive approximations over Tresca's problems,
// each of which is convex. The answer is the one that has converged; if none has, that with the
// smaller residual of Alart and Curnier ‖λ − P(λ − ρ (A λ − b))‖, which both are measured with. The
// work is that of all.
//
//     contact::dual problem(contact::friction_disc{}, slant::factorize(K), data);
//     auto const r = contact::solve_coulomb(problem, F, {.tolerance = 1e-10});
//     if (r.converged()) u = problem.displacement(r.λ);
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/coulomb.hpp>
#include <slant/contact/coulomb_newton.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace slant::contact {

/// Options of solve_coulomb.
struct solve_coulomb_options {
  double tolerance = 1e-10;  ///< of the residuals, relative to those at λ = 0
  index newton_steps = 60;   ///< of Newton's method at most; 0: none, if the others are some
  index outer_steps = 300;   ///< of successive approximations at most; 0: none, if the others are

  /// Throws bad_input naming the option, its value and what was expected.
  void validate() const {
    if (!(tolerance > 0 && tolerance < 1)) {
      throw bad_input("tolerance", slant::detail::show(tolerance), "a number in (0, 1)");
    }
    if (newton_steps < 0) {
      throw bad_input("newton_steps", slant::detail::show(newton_steps), "a number >= 0");
    }
    if (outer_steps < 0) {
      throw bad_input("outer_steps", slant::detail::show(outer_steps), "a number >= 0");
    }
    if (newton_steps == 0 && outer_steps == 0) {
      throw bad_input("newton_steps and outer_steps", "0 and 0", "at least one of them > 0");
    }
  }
};

/// Result of solve_coulomb.
template <class V>
struct coulomb_result {
  V λ;                                     ///< (λ_ν, λ_t), as the dual problem orders them
  slant::status status = status::running;  ///< converged, or how the last method ended
  std::string reason{};                    ///< the same as a sentence
  std::string_view method{};               ///< "Newton" or "successive approximations"
  index steps = 0;                         ///< of that method
  slant::work work{};                      ///< of all

  /// True only if the accuracy asked for was reached.
  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

template <class V, class Report>
void add_work(coulomb_result<V>& r, Report const& report) {
  r.work.operator_applications += report.state.work.operator_applications;
  r.work.setup_applications += report.state.work.setup_applications;
  r.work.inner_iterations += report.state.work.inner_iterations;
  r.work.factorizations += report.state.work.factorizations;
}

template <class V, class Report>
void take_answer(coulomb_result<V>& r, Report const& report, std::string_view method, V λ) {
  r.λ = std::move(λ);
  r.status = report.status;
  r.reason = report.reason;
  r.method = method;
  r.steps = report.iterations();
}

/// Successive approximations from x0.
template <class Radii>
[[nodiscard]] auto approximate(Radii& radii, typename Radii::vector_type const& x0,
                               solve_coulomb_options const& o) {
  identity_operator const I(radii.b().size());
  return slant::solve(
      coulomb(radii, I, {.goal = o.tolerance}), x0,
      reduced_gradient_below(typename Radii::scalar(o.tolerance)) || at_most(o.outer_steps));
}

}  // namespace detail

/// Solves the problem at the top of this file; the slip bounds of the dual problem have no meaning
/// here. F has a coefficient for every contact node. Throws bad_input if it has not, or a
/// coefficient is negative or not finite, or for options out of range.
template <class Dual>
[[nodiscard]] auto solve_coulomb(Dual& problem, typename Dual::vector_type const& F,
                                 solve_coulomb_options const& o = {})
    -> coulomb_result<typename Dual::vector_type> {
  using S = scalar_t<typename Dual::vector_type>;
  o.validate();
  coulomb_result<typename Dual::vector_type> r{problem.zero()};
  coulomb_radii radii(problem, coefficients(F));
  // Every contact sticks still, so that the start keeps its tangential forces.
  auto start = unconstrained_start(radii.qp());
  r.work.setup_applications = start.applications;
  constexpr std::string_view approximations = "successive approximations";
  if (o.newton_steps == 0) {
    auto const report = detail::approximate(radii, start.x, o);
    detail::add_work(r, report);
    detail::take_answer(r, report, approximations, report.x());
    return r;
  }
  coulomb_cones const cones(problem, F);
  auto const ρ = residual_step(cones);
  r.work.setup_applications += ρ.applications;
  auto const residual = coulomb_residual(cones, ρ.length);
  auto const newton =
      slant::solve(coulomb_newton(residual, o.tolerance), cones.by_contacts(start.x),
                   residual_below(S(o.tolerance)) || at_most(o.newton_steps));
  detail::add_work(r, newton);
  detail::take_answer(r, newton, "Newton", cones.by_directions(newton.x()));
  if (r.converged() || o.outer_steps == 0) return r;

  auto const report = detail::approximate(radii, start.x, o);
  detail::add_work(r, report);
  bool better = report.converged();
  if (!better) {
    S const size = norm(slant::evaluate(residual, cones.by_contacts(report.x())));
    ++r.work.operator_applications;
    better =
        size < newton.state.residual_norm || !slant::detail::is_finite(newton.state.residual_norm);
  }
  if (better) detail::take_answer(r, report, approximations, report.x());
  return r;
}

}  // namespace slant::contact
