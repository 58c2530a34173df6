// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction without factors of K: successive slip bounds [Haslinger, Dostál,
// Kučera 2002], each of whose problems of Tresca's is solved by Newton's method for the
// displacements (iterated_run.hpp) only as far as its bounds deserve, and from there Newton's
// method for the law itself (alart_curnier_steps.hpp):
//
//     start     without friction, to 5 %
//     bounds    g ← F λ_ν(u), from the gradient that is at hand: no product (with springs two)
//     steps     e₀ the energy error for the new bounds, estimated by the first step (one cycle);
//               further steps until it is e₀/10, or well below what is certified
//     Newton    for Coulomb's law, to what is certified; where that fails, again when there have
//               been twice as many bounds
//     certify   where e₀ is half of the tolerance: Coulomb's law contact by contact (coulomb_check),
//               and the energy error for the last bounds (energy_certificate)
//     go on     where that asks for more, with a goal that is smaller by as much
//
// With little friction the first bounds are near enough. Bounds alone take up to 1.6 times the
// cycles on bricks with F = 0.3, twice as many with F = 2 under the lift.
//
// Bodies that float are held by springs that move with the bounds (moving_springs). The state is
// kept from problem to problem, so that bounds cost some two steps. Where neither they nor Newton's
// steps get nearer the run ends: stalled after `patience` problems of which none was nearer than all
// before.
#pragma once

#include <slant/certificates/energy_certificate.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/coulomb/coulomb_certificate.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/parts/alart_curnier_steps.hpp>
#include <slant/contact/parts/iterated_run.hpp>
#include <slant/contact/solve_options.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace slant::contact::detail {

/// Of Newton's method at most, for each problem of Tresca's; and for so many after the first.
constexpr index steps_for_bounds = 40;
[[nodiscard]] constexpr index steps_for_problems(index problems) {
  return steps_for_bounds * (std::min(problems, std::numeric_limits<index>::max() / 64) + 1);
}

/// Steps and bounds until the certificate agrees, from where the run is and the bounds that it has,
/// and what has come of them but for the choice of a route; with tangential positions w, none: 0.
/// `newton` is made for the run and F where it is needed.
template <class Friction, class S, class Certificate>
[[nodiscard]] certified_coulomb_result<Eigen::VectorX<S>> run_coulomb_to_certified(
    Friction law, primal_run<S>& run, std::optional<alart_curnier_steps<S>>& newton,
    moving_springs<S>& springs, Certificate& frozen, data<S> const& c, Eigen::VectorX<S> const& w,
    Eigen::VectorX<S> const& F, certified_coulomb_options<S> const& o) {
  using vector_type = Eigen::VectorX<S>;
  constexpr index patience = 15, rounds = 12, newton_steps = 12;
  constexpr char const* no_more = "no more problems of Tresca's were allowed";
  certified_coulomb_result<vector_type> result{};
  result.factorization = run.levels().description();
  auto const tolerance = S(o.tolerance);
  index bounds = 0;
  auto how = status::converged;
  std::string why;
  index const before = frozen.applications();
  index const nodes = F.size();
  Eigen::SparseMatrix<S> const B = stacked_constraints(c);
  vector_type closed = vector_type::Zero(B.rows());  // B u where gaps are closed and nothing slides
  closed.head(nodes) = c.d;
  if (w.size() > 0) closed.tail(w.size()) = w;
  vector_type λ(nodes);

  auto const& state = run.state();
  for (index k = 0; k < steps_for_bounds && state.status == status::running; ++k) {
    run.step(S(0.05) * run.size());
  }
  index const newton_before = newton ? newton->steps() : 0;
  vector_type x;
  slant::work by_newton;
  index next_newton = 1;
  S share = tolerance / S(2), best = std::numeric_limits<S>::infinity(), nearest = best;
  index since = 0, round = 0, idle = 0;
  // As in run_floating.
  auto const size = [&] { return springs.size() > S(0) ? springs.size() : run.size(); };
  auto const goal = [&] { return S(share * size()); };
  auto const use_bounds_of_x = [&] {
    run.pressures(λ);
    run.set_slip_bounds(F.cwiseProduct(λ));
  };
  auto const judge = [&] {
    result.u = run.displacement();
    result.λ = run.problem().multipliers(state.x);
    vector_type const g = F.cwiseProduct(result.λ.head(nodes).cwiseMax(S(0)));
    slant::project(feasible_set(law, nodes, g), result.λ, result.λ);
    result.error.law =
        violation_of_coulomb<vector_type>(c.f, B, closed - B * result.u, F, result.λ, result.u);
    result.error.frozen = frozen(state.x);
    if (run.problem().offset().size() > 0) result.error.frozen.size = run.size();
    if (!springs.empty()) {
      springs.measure(result.u, goal());
      result.error.frozen = springs.error(result.error.frozen.bound);
    }
    return result.error.relative();
  };
  while (true) {
    if (!springs.empty()) {
      springs.measure(run.displacement(), goal());
      springs.move();
      run.set_load(springs.load(c.f));
    }
    use_bounds_of_x();
    ++bounds;
    run.step(goal());
    if (state.status == status::running) {
      S const first = state.energy_estimate;
      since = first < nearest ? 0 : since + 1;
      nearest = std::min<S>(nearest, first);
      for (index k = 1; k < steps_for_bounds && state.status == status::running; ++k) {
        run.step(std::max<S>(goal() / S(8), first / S(10)));
      }
      if (state.status == status::converged && bounds >= next_newton) {
        if (!newton) newton.emplace(run.problem(), run.qp(), run.levels(), F, state.step_length);
        x = state.x;
        bool const arrived =
            newton->run(x, state.r, state.unit, state.roughly, goal(), newton_steps, by_newton);
        if (!arrived) next_newton = 2 * bounds;
        if (x != state.x) run.go_to(x);
      }
      bool const ends =
          state.status == status::breakdown || since >= patience || bounds >= o.outer_steps;
      if (!ends) continue;
      how = state.status == status::breakdown ? status::breakdown
            : since >= patience               ? status::stalled
                                              : status::iteration_limit;
      why = state.status == status::breakdown ? run.reason()
            : since < patience                ? no_more
            : !springs.empty() && !(springs.contraction() < S(0.5))
                ? "contact hardly holds bodies without supports"
                : "neither successive slip bounds nor Newton's steps get nearer";
      use_bounds_of_x();
      if (judge() <= tolerance) how = status::converged;
      break;
    }
    // With the bounds of x itself x needs no step.
    S const error = judge();
    if (error <= tolerance) break;
    // The bound of a problem may be loose where that of the next is not, and none at all far away.
    bool const is_known = slant::detail::is_finite(error);
    idle = error < best / S(2) || !is_known ? 0 : idle + 1;
    bool const may_go_on = state.status == status::converged && idle < 2 &&
                           state.reduced_gradient_norm > S(0) && ++round < rounds;
    if (!may_go_on || bounds >= o.outer_steps) {
      how = may_go_on                           ? status::iteration_limit
            : state.status == status::converged ? status::stalled
                                                : state.status;
      why = may_go_on ? no_more : run.reason();
      break;
    }
    best = std::min<S>(best, error);
    if (!is_known && !springs.empty()) continue;
    // Below the estimate at x, or the next step would stay there, as where springs are at rest.
    if (state.energy_estimate > S(0)) share = std::min<S>(share, state.energy_estimate / size());
    share *= std::clamp<S>(tolerance / error / S(2), S(1e-3), S(0.3));
  }
  index const steps = newton ? newton->steps() - newton_before : 0;
  result.steps = bounds + steps;
  result.method = steps > 0 ? "slip bounds and Newton" : "successive slip bounds";
  conclude(result, how == status::converged, how, o.tolerance, "; " + why);
  result.work = state.work;
  result.work += by_newton;
  result.work.operator_applications += frozen.applications() + springs.products() - before;
  return result;
}

/// The run from nothing, of c with slip bounds of 0; `floating` bodies that contact holds. Throws
/// bad_input where K is found not to be definite or does not fit the nodes.
template <class Friction, class S>
[[nodiscard]] certified_coulomb_result<Eigen::VectorX<S>> iterated_coulomb(
    Friction law, Eigen::SparseMatrix<S> const& K, data<S> const& c, Eigen::VectorX<S> const& F,
    free_motions<S> const& floating, certified_coulomb_options<S> const& o,
    route_budget<S>& budget) {
  moving_springs<S> springs(K, floating, o.layout.dimension());
  primal_run<S> run(springs.held(), c, o.layout, o.multigrid, steps_for_problems(o.outer_steps));
  run.set_budget(budget);
  energy_certificate frozen(run.qp(), run.levels());
  std::optional<alart_curnier_steps<S>> newton;
  return run_coulomb_to_certified<Friction, S>(law, run, newton, springs, frozen, c, {}, F, o);
}

}  // namespace slant::contact::detail
