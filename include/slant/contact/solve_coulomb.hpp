// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction solved, for those who do not want to choose: Newton's method for
// the residual of Alart and Curnier, which costs no more than a problem of Tresca's; where it ends
// without a solution (much friction, a bad start) successive approximations over Tresca's problems,
// each of which is convex. The answer is the one that has converged; if none has, that with the
// smaller residual of Alart and Curnier ‖λ − P(λ − ρ (A λ − b))‖, which both are measured with. The
// work is that of all.
//
// Both residuals are relative to those at λ = 0, which bodies that nearly move rigidly make as
// large as their motion: relative to it any forces are a solution. So what has converged is judged
// by another check, of (λ, u), by default coulomb_check. Where that contradicts the method goes on
// with a tolerance that is smaller by as much, as long as this helps; where it does not, the run
// ends `stalled` with what the check finds.
//
// From matrices, with the error in the energy norm as the check and contacts of unequal stiffness
// scaled: contact/certified_coulomb.hpp.
//
//     contact::dual problem(contact::friction_disc{}, slant::factorize(K), data);
//     auto const r = contact::solve_coulomb(problem, F, {.tolerance = 1e-10});
//     if (r.converged()) u = problem.displacement(r.λ);
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/coulomb/coulomb_certificate.hpp>
#include <slant/contact/coulomb/coulomb_newton.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/unconstrained_start.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace slant::contact {

/// Options of solve_coulomb.
struct solve_coulomb_options {
  /// Of the residuals, relative to those at λ = 0; and a hundredth of what the check may find. (On
  /// well-posed problems it finds 0.01 to 20 times the tolerance.)
  double tolerance = 1e-10;
  index newton_steps = 60;  ///< of Newton's method at most; 0: none, if the others are some
  index outer_steps = 300;  ///< of successive approximations at most; 0: none, if the others are

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
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
  V u{};                                   ///< displacement(λ) of the dual problem
  coulomb_violation<scalar_t<V>> law{};    ///< of (λ, u), and where it is largest
  scalar_t<V> error{};                     ///< of (λ, u), by the check: law.relative by default
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
                               double tolerance, index steps) {
  identity_operator const I(radii.b().size());
  return slant::solve(coulomb(radii, I, {.goal = tolerance}), x0,
                      reduced_gradient_below(typename Radii::scalar(tolerance)) || at_most(steps));
}

/// How often the tolerance is made smaller at most: it falls by orders of magnitude each time.
inline constexpr index coulomb_rounds = 8;

/// Judges r.λ: one solve with K.
template <class Dual, class V, class Check>
void judge(Dual const& problem, V const& F, Check const& check, coulomb_result<V>& r) {
  r.u = problem.displacement(r.λ);
  ++r.work.operator_applications;
  r.law = coulomb_check(problem, F)(r.λ, r.u);
  r.error = check(r.λ, r.u);
}

/// The answer of run(x, tolerance, steps) → report, again from where it ended with a smaller
/// tolerance while the check contradicts that it has converged.
template <class V, class Run, class Take, class Judge>
void settle(coulomb_result<V>& r, V x, double tolerance, index steps, Run const& run,
            Take const& take, Judge const& judged) {
  using S = scalar_t<V>;
  using slant::detail::show;
  S const allowed = S(100) * S(tolerance);
  S before = std::numeric_limits<S>::infinity();
  index done = 0;
  coulomb_result<V> last{};
  for (index round = 0;; ++round) {
    auto report = run(x, tolerance, steps - done);
    done += report.iterations();
    detail::add_work(r, report);
    take(report);
    r.steps = done;
    if (round == 0 && !r.converged()) return;
    judged();
    if (r.error <= allowed) {  // also where the smaller tolerance of this round was out of reach
      r.status = slant::status::converged;
      r.reason += "; the check finds " + show(r.error);
      return;
    }
    bool const helps = round == 0 || r.error <= S(0.5) * before;
    if (!r.converged() || !helps || round == coulomb_rounds || done >= steps) {
      if (r.converged()) r.status = slant::status::stalled;
      if (!(r.error <= before)) {  // the round before was nearer
        r.λ.swap(last.λ);
        r.u.swap(last.u);
        r.law = last.law;
        r.error = last.error;
      }
      r.reason = "the check finds " + show(r.error) + ", more than " + show(allowed) +
                 ", largest at contact " + show(r.law.contact) + "; " + r.reason;
      return;
    }
    last = r;
    before = r.error;
    double const smaller = static_cast<double>(allowed / r.error);
    tolerance *= 0.5 * std::max(std::numeric_limits<double>::epsilon(), smaller);
    x = std::move(report.state.x);
  }
}

}  // namespace detail

/// Solves the problem at the top of this file; the slip bounds of the dual problem have no meaning
/// here. F has a coefficient for every contact node. check(λ, u) → a relative error of multipliers
/// and their displacements, such as a certificate of Tresca's problem with the bounds F λ_ν. Throws
/// bad_input if F has not, or a coefficient is negative or not finite, or for options out of range.
template <class Dual, class Check>
[[nodiscard]] auto solve_coulomb(Dual& problem, typename Dual::vector_type const& F,
                                 solve_coulomb_options const& o, Check const& check)
    -> coulomb_result<typename Dual::vector_type> {
  using vector_type = typename Dual::vector_type;
  using S = scalar_t<vector_type>;
  o.validate();
  coulomb_result<vector_type> r{problem.zero()};
  coulomb_radii radii(problem, coefficients(F));
  // Every contact sticks still, so that the start keeps its tangential forces.
  auto start = unconstrained_start(radii.qp());
  r.work.setup_applications = start.applications;
  auto const judged = [&] { detail::judge(problem, F, check, r); };
  auto const approximate = [&](coulomb_result<vector_type>& into) {
    detail::settle(
        into, start.x, o.tolerance, o.outer_steps,
        [&](vector_type const& x, double tolerance, index steps) {
          return detail::approximate(radii, x, tolerance, steps);
        },
        [&](auto const& report) {
          detail::take_answer(into, report, "successive approximations", report.x());
        },
        [&] { detail::judge(problem, F, check, into); });
  };
  if (o.newton_steps == 0) {
    approximate(r);
    if (r.u.size() == 0) judged();
    return r;
  }
  coulomb_cones const cones(problem, F);
  auto const ρ = residual_step(cones);
  r.work.setup_applications += ρ.applications;
  auto const residual = coulomb_residual(cones, ρ.length);
  S newton_residual(0);
  detail::settle(
      r, cones.by_contacts(start.x), o.tolerance, o.newton_steps,
      [&](vector_type const& x, double tolerance, index steps) {
        return slant::solve(coulomb_newton(residual, tolerance), x,
                            residual_below(S(tolerance)) || at_most(steps));
      },
      [&](auto const& report) {
        detail::take_answer(r, report, "Newton", cones.by_directions(report.x()));
        newton_residual = report.state.residual_norm;
      },
      judged);
  if (r.converged()) return r;
  if (o.outer_steps > 0) {
    coulomb_result<vector_type> other{problem.zero()};
    other.work = r.work;
    approximate(other);
    bool better = other.converged();
    if (!better && r.u.size() > 0 && other.u.size() > 0) {
      better = other.error < r.error;
    } else if (!better) {
      S const size = norm(slant::evaluate(residual, cones.by_contacts(other.λ)));
      ++other.work.operator_applications;
      better = size < newton_residual || !slant::detail::is_finite(newton_residual);
    }
    r.work = other.work;
    if (better) r = std::move(other);
  }
  if (r.u.size() == 0) judged();
  return r;
}
/// The same with coulomb_check.
template <class Dual>
[[nodiscard]] auto solve_coulomb(Dual& problem, typename Dual::vector_type const& F,
                                 solve_coulomb_options const& o = {}) {
  using vector_type = typename Dual::vector_type;
  return solve_coulomb(problem, F, o, [&](vector_type const& λ, vector_type const& u) {
    return coulomb_check(problem, F)(λ, u).relative;
  });
}

}  // namespace slant::contact
