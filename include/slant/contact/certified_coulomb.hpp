// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction from matrices to displacements, with a verdict that no method gives
// itself:
//
//     choose      by the cost model of contact/route.hpp: without factors, where the layout is known
//                 and the body is large, or where factors get nowhere
//                                                            contact/parts/iterated_coulomb; else
//     factor      K                                                     factorizations/factorize
//     scale       contacts so that each is about equally stiff: one power of two for the rows of N
//                 and T of a contact, which keeps its cone; not at all where they are alike already
//     solve       Newton's method, radii where that fails, then solve_friction
//                                                                             solve_by_all_methods
//     certify     Coulomb's law at (λ, u) contact by contact, and in the energy norm the problem
//                 of Tresca with the slip bounds F λ_ν     contact/coulomb/coulomb_certificate
//
// `converged` only if both are at most the tolerance. Where the certificate contradicts the method
// it goes on to a smaller residual; where that is of no use the run ends `stalled`, and the reason
// says what the certificate finds, at which contact, and how ill-conditioned K is.
//
//     auto const r = contact::certified_coulomb(contact::friction_disc{}, K, data, F);
//     if (r.converged()) use(r.u, r.λ);
//
// It is for those who do not want to choose. With a dual problem and a family at hand each method
// can be had alone: contact/coulomb/coulomb.hpp.
#pragma once

#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/coulomb/coulomb_certificate.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/parts/iterated_coulomb.hpp>
#include <slant/contact/route.hpp>
#include <slant/contact/solve_friction.hpp>
#include <slant/contact/solve_options.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <slant/operators/identity.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace slant::contact {

namespace detail {

/// Slip bounds of 0 in the place of those of the data, which have no meaning for Coulomb's law: it
/// has F times the pressures. Throws bad_input without T.
template <class S>
void clear_slip_bounds(data<S>& c) {
  index const m = c.nodes();
  if (m > 0 && c.T.rows() == 0) {
    using slant::detail::show;
    throw bad_input("rows of T", "0", show(m) + " (2D) or " + show(2 * m) + " (3D)");
  }
  c.g = Eigen::VectorX<S>::Zero(m);
}

// --- coulomb run ---------------------------------------------------------------------------------
//
// The methods for a dual problem under the control of a check. Newton's method for the residual of
// Alart and Curnier costs no more than a problem of Tresca's; where it ends without a solution
// (much friction, a bad start) successive approximations over Tresca's problems follow, each of
// which is convex, and where these do as well, and forces are not too many for a dense matrix,
// solve_friction. The answer is the one that has converged; if none has, that with the smaller
// error, or, if one was not even checked, the smaller residual ‖λ − P(λ − ρ (A λ − b))‖. The work
// is that of all.
//
// Relative to the residuals at λ = 0 any forces of bodies that nearly move rigidly are a solution,
// so what has converged is judged by the check, of (λ, u).

/// How far a run goes.
struct coulomb_limits {
  /// Of the residuals, relative to those at λ = 0; and a hundredth of what the check may find. (On
  /// well-posed problems it finds 0.01 to 20 times the tolerance.)
  double tolerance = 1e-10;
  index newton_steps = 60;  ///< of Newton's method at most; 0: none, if the others are some
  index outer_steps = 300;  ///< of successive approximations at most; 0: none, if the others are
  index forces = 1500;      ///< up to which solve_friction may follow, where both methods may run
};

/// What a run by these methods found.
template <class V>
struct coulomb_result {
  V λ;                                     ///< (λ_ν, λ_t), as the dual problem orders them
  V u{};                                   ///< displacement(λ) of the dual problem
  coulomb_violation<scalar_t<V>> law{};    ///< of (λ, u), and where it is largest
  scalar_t<V> error{};                     ///< of (λ, u), by the check
  slant::status status = status::running;  ///< converged, or how the last method ended
  std::string reason{};                    ///< the same as a sentence
  std::string_view method{};               ///< its name
  index steps = 0;                         ///< of that method
  slant::work work{};                      ///< of all

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

/// Runs of `settle` by successive approximations over a family.
template <class Family>
[[nodiscard]] auto approximations(Family& family) {
  using S = typename Family::scalar;
  return [&family, I = identity_operator(family.b().size())](typename Family::vector_type const& x,
                                                             double goal, index steps) {
    return slant::solve(coulomb(family, I, {.goal = goal}), x,
                        reduced_gradient_below(S(goal)) || at_most(steps));
  };
}

/// Judges r.λ: one solve with K.
template <class Dual, class V, class Check>
void judge(Dual const& problem, V const& F, Check const& check, coulomb_result<V>& r) {
  r.u = problem.displacement(r.λ);
  ++r.work.operator_applications;
  r.law = coulomb_check(problem, F)(r.λ, r.u);
  r.error = check(r.λ, r.u);
}

/// The answer of run(x, tolerance, steps) → report, whose x is `to_λ` of λ, again from where it
/// ended with a smaller tolerance while the check contradicts that it has converged.
template <class V, class Judge, class Run, class Map>
void settle(coulomb_result<V>& r, std::string_view method, V x, double tolerance, index steps,
            Judge const& judged, Run const& run, Map const& to_λ) {
  using S = scalar_t<V>;
  using slant::detail::brief;
  using slant::detail::show;
  constexpr index rounds = 8;  // the tolerance falls by orders of magnitude in each
  S const allowed = S(100) * S(tolerance);
  S before = std::numeric_limits<S>::infinity();
  index done = 0;
  coulomb_result<V> last{};
  for (index round = 0;; ++round) {
    auto report = run(x, tolerance, steps - done);
    done += report.iterations();
    r.work += report.state.work;
    r.λ = to_λ(report.x());
    r.status = report.status;
    r.reason = report.reason;
    r.method = method;
    r.steps = done;
    if (round == 0 && !r.converged()) return;
    judged(r);
    if (r.error <= allowed) {  // also where the smaller tolerance of this round was out of reach
      r.status = slant::status::converged;
      r.reason += "; the check finds " + brief(r.error);
      return;
    }
    bool const helps = round == 0 || r.error <= S(0.5) * before;
    if (!r.converged() || !helps || round == rounds || done >= steps) {
      if (r.converged()) r.status = slant::status::stalled;
      if (before < r.error || (round > 0 && r.error != r.error)) {  // the one before was nearer
        r.λ.swap(last.λ);
        r.u.swap(last.u);
        r.law = last.law;
        r.error = last.error;
      }
      std::string found = brief(r.error);
      if (found == brief(allowed)) found = show(r.error);
      r.reason = "the check finds " + found + ", more than " + brief(allowed) +
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

/// By solve_friction, whose methods take A as a matrix: a product by A for each column.
template <class Dual, class V, class Check>
[[nodiscard]] coulomb_result<V> solve_by_matrix(Dual& problem, V const& F, double tolerance,
                                                Check const& check) {
  using S = scalar_t<V>;
  coulomb_result<V> r{problem.zero()};
  coulomb_cones const cones(problem, F);
  auto const& A = cones.qp().a();
  index const n = A.rows();
  Eigen::MatrixX<S> W(n, n);
  V column(n);
  auto w = workspace(A, column);
  for (index j = 0; j < n; ++j) {
    slant::apply(A, V(V::Unit(n, j)), column, w);
    W.col(j) = column;
  }
  r.work.setup_applications = n;
  friction_problem<S> const condensed{
      .W = Eigen::MatrixX<S>((W + W.transpose()) / S(2)).sparseView(), .q = cones.q(), .mu = F};
  S const floor = S(64) * std::numeric_limits<S>::epsilon();
  auto found = solve_friction(condensed, {.tolerance = std::max<S>(S(tolerance), floor)});
  r.λ = cones.by_directions(found.r);
  r.method = "solve_friction";
  r.steps = found.work.sweeps + found.work.newton_steps;
  judge(problem, F, check, r);
  bool const is_enough = r.error <= S(100) * S(tolerance);
  r.status = is_enough ? slant::status::converged : slant::status::stalled;
  r.reason = std::move(found.reason) + "; the check finds " + slant::detail::brief(r.error);
  return r;
}

/// By Newton's method, by radii where that fails, by solve_friction where both do and forces are
/// few; the slip bounds of the dual problem have no meaning here. F has a coefficient for every
/// contact node; check(λ, u) → a relative error.
template <class Dual, class Check>
[[nodiscard]] auto solve_by_all_methods(Dual& problem, typename Dual::vector_type const& F,
                                        coulomb_limits const& o, Check const& check)
    -> coulomb_result<typename Dual::vector_type> {
  using vector_type = typename Dual::vector_type;
  using S = scalar_t<vector_type>;
  coulomb_result<vector_type> r{problem.zero()};
  coulomb_radii radii(problem, coefficients(F));
  // Every contact sticks still, so that the start keeps its tangential forces.
  auto start = unconstrained_start(radii.qp());
  r.work.setup_applications = start.applications;
  auto const judged = [&](auto& of) { detail::judge(problem, F, check, of); };
  auto const approximate = [&](coulomb_result<vector_type>& into) {
    detail::settle(into, "successive approximations", start.x, o.tolerance, o.outer_steps, judged,
                   detail::approximations(radii), std::identity{});
  };
  if (o.newton_steps == 0) {
    approximate(r);
    if (r.u.size() == 0) judged(r);
    return r;
  }
  coulomb_cones const cones(problem, F);
  auto const ρ = residual_step(cones);
  r.work.setup_applications += ρ.applications;
  auto const residual = coulomb_residual(cones, ρ.length);
  S newton_residual(0);
  detail::settle(
      r, "Newton", cones.by_contacts(start.x), o.tolerance, o.newton_steps, judged,
      [&](vector_type const& x, double tolerance, index steps) {
        auto report = slant::solve(contact::coulomb_newton(residual, tolerance), x,
                                   residual_below(S(tolerance)) || at_most(steps));
        newton_residual = report.state.residual_norm;
        return report;
      },
      [&](vector_type const& x) { return cones.by_directions(x); });
  if (r.converged()) return r;
  bool stuck = false;
  if (o.outer_steps > 0) {
    coulomb_result<vector_type> other{problem.zero()};
    other.work = r.work;
    approximate(other);
    stuck = other.status != status::iteration_limit || other.steps >= 100;
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
  if (r.u.size() == 0) judged(r);
  // Near, it is a matter of digits; at a limit of few steps nobody wants more.
  using std::sqrt;
  bool const is_near = r.error <= sqrt(std::numeric_limits<S>::epsilon());
  bool const is_open = !r.converged() && !is_near && stuck && r.λ.size() <= o.forces;
  if (!is_open) return r;
  try {
    auto last = solve_by_matrix(problem, F, o.tolerance, check);
    last.work += r.work;
    bool const is_nearer = last.error < r.error || r.error != r.error;
    if (last.converged() || is_nearer) return last;
    r.work = last.work;
  } catch (bad_input const&) {  // numbers of the matrix are out of range
  }
  return r;
}

/// By cones, under the control of check(λ, u).
template <class Dual, class V, class Check>
[[nodiscard]] coulomb_result<V> solve_by_cones(Dual& problem, V const& F, double tolerance,
                                               index steps, Check const& check) {
  coulomb_result<V> r{problem.zero()};
  coulomb_cones cones(problem, F);
  auto const start = unconstrained_start(cones.qp());
  r.work.setup_applications = start.applications;
  auto const judged = [&](auto& of) { detail::judge(problem, F, check, of); };
  detail::settle(r, "cones", start.x, tolerance, steps, judged, detail::approximations(cones),
                 [&](V const& x) { return cones.by_directions(x); });
  if (r.u.size() == 0) judged(r);
  return r;
}

// --- with factors --------------------------------------------------------------------------------

/// From valid data without slip bounds, and factors of K.
template <class Friction, class S, class Factor>
[[nodiscard]] certified_coulomb_result<Eigen::VectorX<S>> factored_coulomb(
    Friction friction, Eigen::SparseMatrix<S> const& K, Factor const& factor, data<S> c,
    Eigen::VectorX<S> const& F, certified_coulomb_options<S> const& o) {
  using vector_type = Eigen::VectorX<S>;
  using dual_type = decltype(dual(friction, factor, c));
  dual_type given(friction, factor, c);
  coulomb_certificate certificate(given, factor, K, c, F, S(o.tolerance));
  certified_coulomb_result<vector_type> result{given.zero()};
  result.factorization = std::string(factor.name());

  vector_type const d =
      o.scale ? row_factors(certificate.stiffness(), c.nodes(), c.tangents(), true) : vector_type();
  result.scaled = d.size() > 0;
  std::optional<dual_type> scaled;
  if (result.scaled) {
    c = with_units(std::move(c), d);
    scaled.emplace(friction, factor, c);
  }
  dual_type& problem = result.scaled ? *scaled : given;

  // The point with the smallest error is the one that the run ends with: it is kept on its face.
  S least = std::numeric_limits<S>::infinity();
  auto const check = [&](vector_type const& λ, vector_type const& u) {
    auto const e = certificate(result.scaled ? vector_type(d.cwiseProduct(λ)) : λ, u);
    S const error = e.relative();
    if (error < least || result.u.size() == 0) {
      least = error < least ? error : least;
      result.error = e;
      result.λ = certificate.multipliers();
      result.u = certificate.displacement();
    }
    return error;
  };
  // The check may find a hundred times what the methods are asked for.
  double const asked = std::max(o.tolerance / 100, std::numeric_limits<double>::min());
  bool const by_newton =
      o.method == coulomb_method::automatic || o.method == coulomb_method::newton;
  auto r = o.method == coulomb_method::cones
               ? detail::solve_by_cones(problem, F, asked, o.outer_steps, check)
               : detail::solve_by_all_methods(
                     problem, F,
                     {.tolerance = asked,
                      .newton_steps = by_newton ? o.newton_steps : 0,
                      .outer_steps = o.method == coulomb_method::newton ? 0 : o.outer_steps},
                     check);
  result.method = r.method;
  result.steps = r.steps;
  result.work = r.work;
  result.work.operator_applications += certificate.applications();
  ++result.work.factorizations;
  result.condition = certificate.condition();
  conclude(result, result.error.relative() <= S(o.tolerance), r.status, o.tolerance,
           " (condition of K about " + slant::detail::brief(result.condition) + "); " + r.reason);
  return result;
}

}  // namespace detail

/// Solves the problem at the top of this file; the slip bounds of the data have no meaning here. F
/// has a coefficient for every contact node. Throws bad_input if K is not symmetric positive
/// definite or data do not fit, if a coefficient is negative or not finite, or for options out of
/// range.
template <class Friction, class S>
[[nodiscard]] auto certified_coulomb(Friction friction, Eigen::SparseMatrix<S> const& K, data<S> c,
                                     Eigen::VectorX<S> const& F,
                                     certified_coulomb_options<S> const& o = {})
    -> certified_coulomb_result<Eigen::VectorX<S>> {
  o.validate();
  detail::clear_slip_bounds(c);
  detail::validated(friction, c, K.rows());
  detail::check_coefficients("F", detail::one_per_contact(Eigen::VectorX<S>(F), c.nodes()));
  if (auto const U = detail::row_units(c); U.size() > 0) {
    Eigen::VectorX<S> own = F;
    for (index i = 0; i < own.size(); ++i) {
      S const n = U[i], t = U[c.nodes() + i * c.tangents()];
      own[i] = n < S(1) ? S(F[i] / t * n) : S(F[i] * n / t);  // n/t may be no number
      own[i] = std::min<S>(own[i], std::numeric_limits<S>::max());
    }
    auto run = certified_coulomb(friction, K, detail::with_units(std::move(c), U), own, o);
    run.λ = run.λ.cwiseProduct(U);
    run.scaled = true;
    return run;
  }
  auto const outlook = o.method == coulomb_method::automatic
                           ? detail::outlook_of_iteration(K, c, o)
                           : detail::iteration_outlook<S>{"the method works on forces"};
  // The methods with factors need supports.
  bool const automatic = o.route == solution_route::automatic;
  bool const needs_none = automatic && !outlook.floating.free.empty();
  route_choice choice =
      choose_route(K, outlook.refusal, needs_none ? solution_route::iterate : o.route, o.costs);
  if (needs_none) choice.reason = "iterated: factors need supports of every body";
  detail::route_budget<S> budget(K, choice, o.costs);
  auto const iterate = [&] {
    return detail::iterated_coulomb(friction, K, c, F, outlook.floating, o, budget);
  };
  bool const can_follow = automatic && outlook.is_possible && o.tolerance > 0;
  // Multigrid takes K for definite where neither coordinates nor factors have told.
  bool may_iterate = can_follow && o.layout.is_known();
  auto const factor = [&] {
    auto const factors = factorize_stiffness(K, o.layout);
    may_iterate = can_follow;
    return detail::factored_coulomb(friction, K, factors, c, F, o);
  };
  // What seems to float may be only slender.
  auto const factor_after = [&] {
    return needs_none ? detail::unless_refused(factor)
                      : detail::factored_after(choice, budget, factor, iterate);
  };
  auto found = choice.route == solution_route::iterate
                   ? detail::by_routes(choice, automatic, iterate, factor_after)
                   : detail::by_routes(choice, may_iterate, factor,
                                       [&] { return detail::unless_refused(iterate); });
  found.choice = std::move(choice);
  return found;
}

#if SLANT_USES_COMPILED
extern template certified_coulomb_result<Eigen::VectorXd> certified_coulomb<friction_line, double>(
    friction_line, Eigen::SparseMatrix<double> const&, data<double>, Eigen::VectorXd const&,
    certified_coulomb_options<double> const&);
extern template certified_coulomb_result<Eigen::VectorXd> certified_coulomb<friction_disc, double>(
    friction_disc, Eigen::SparseMatrix<double> const&, data<double>, Eigen::VectorXd const&,
    certified_coulomb_options<double> const&);
#endif

}  // namespace slant::contact
