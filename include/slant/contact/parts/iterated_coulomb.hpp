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
#include <slant/contact/node_layout.hpp>
#include <slant/contact/parts/alart_curnier_steps.hpp>
#include <slant/contact/parts/iterated_run.hpp>
#include <slant/multilevel/multigrid.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace slant::contact::detail {

/// What coulomb_check asks of a dual problem, from the data: contacts of the body as they lie.
template <class S>
class checked_rows {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// With tangential positions w; none: 0.
  checked_rows(data<S> const& c, vector_type const& w)
      : f_(c.f), B_(stacked_constraints(c)), b_(vector_type::Zero(B_.rows())) {
    b_.head(c.nodes()) = c.d;
    if (w.size() > 0) b_.tail(w.size()) = w;
  }
  [[nodiscard]] vector_type const& b() const { return b_; }
  [[nodiscard]] vector_type const& load() const { return f_; }
  [[nodiscard]] sparse_type const& constraints() const { return B_; }
  /// −(N u − d), −(T u − w)
  [[nodiscard]] vector_type openings(vector_type const& u) const { return b_ - B_ * u; }

 private:
  vector_type f_;
  sparse_type B_;
  vector_type b_;
};

/// Of Newton's method at most, for each problem of Tresca's; and for so many after the first.
constexpr index steps_for_bounds = 40;
[[nodiscard]] constexpr index steps_for_problems(index problems) {
  return steps_for_bounds * (std::min(problems, std::numeric_limits<index>::max() / 64) + 1);
}

/// What a run of iterated_coulomb found.
template <class S>
struct iterated_coulomb_result {
  using vector_type = Eigen::VectorX<S>;

  vector_type u, λ;
  coulomb_error<S> error{};
  slant::status status = status::running;
  std::string reason;      ///< of an end other than converged
  index bounds = 0;        ///< problems of Tresca's
  index newton_steps = 0;  ///< for Coulomb's law
  slant::work work{};
  std::string levels;
};

/// Steps and bounds until the certificate agrees, from where the run is and the bounds that it has;
/// `most` problems of Tresca's. `newton` is made for the run and F where it is needed.
template <class Friction, class S, class Certificate>
[[nodiscard]] iterated_coulomb_result<S> run_coulomb_to_certified(
    Friction law, primal_run<S>& run, std::optional<alart_curnier_steps<S>>& newton,
    moving_springs<S>& springs, Certificate& frozen, checked_rows<S> const& rows,
    Eigen::VectorX<S> const& F, S const& tolerance, index most) {
  using vector_type = Eigen::VectorX<S>;
  constexpr index patience = 15, rounds = 12, newton_steps = 12;
  constexpr char const* no_more = "no more problems of Tresca's were allowed";
  iterated_coulomb_result<S> result;
  result.levels = run.levels().description();
  index const before = frozen.applications();
  coulomb_check const check(rows, F);
  index const nodes = F.size();
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
  // As in run_floating_to_certified.
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
    result.error = {check(result.λ, result.u), frozen(state.x)};
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
      run.set_load(springs.load(rows.load()));
    }
    use_bounds_of_x();
    ++result.bounds;
    run.step(goal());
    if (state.status == status::running) {
      S const first = state.energy_estimate;
      since = first < nearest ? 0 : since + 1;
      nearest = std::min<S>(nearest, first);
      for (index k = 1; k < steps_for_bounds && state.status == status::running; ++k) {
        run.step(std::max<S>(goal() / S(8), first / S(10)));
      }
      if (state.status == status::converged && result.bounds >= next_newton) {
        if (!newton) newton.emplace(run.problem(), run.qp(), run.levels(), F, state.step_length);
        x = state.x;
        bool const arrived =
            newton->run(x, state.r, state.unit, state.roughly, goal(), newton_steps, by_newton);
        if (!arrived) next_newton = 2 * result.bounds;
        if (x != state.x) run.go_to(x);
      }
      bool const ends =
          state.status == status::breakdown || since >= patience || result.bounds >= most;
      if (!ends) continue;
      result.status = state.status == status::breakdown ? status::breakdown
                      : since >= patience               ? status::stalled
                                                        : status::iteration_limit;
      result.reason = state.status == status::breakdown ? state.reason()
                      : since < patience                ? no_more
                      : !springs.empty() && !(springs.contraction() < S(0.5))
                          ? "contact hardly holds bodies without supports"
                          : "neither successive slip bounds nor Newton's steps get nearer";
      use_bounds_of_x();
      if (judge() <= tolerance) result.status = status::converged;
      break;
    }
    // With the bounds of x itself x needs no step.
    S const error = judge();
    if (error <= tolerance) {
      result.status = status::converged;
      break;
    }
    // The bound of a problem may be loose where that of the next is not, and none at all far away.
    bool const is_known = slant::detail::is_finite(error);
    idle = error < best / S(2) || !is_known ? 0 : idle + 1;
    bool const may_go_on = state.status == status::converged && idle < 2 &&
                           state.reduced_gradient_norm > S(0) && ++round < rounds;
    if (!may_go_on || result.bounds >= most) {
      result.status = may_go_on                           ? status::iteration_limit
                      : state.status == status::converged ? status::stalled
                                                          : state.status;
      result.reason = may_go_on ? no_more : state.reason();
      break;
    }
    best = std::min<S>(best, error);
    if (!is_known && !springs.empty()) continue;
    // Below the estimate at x, or the next step would stay there; springs move it anyway.
    bool const stays = springs.empty() && state.energy_estimate > S(0);
    if (stays) share = std::min<S>(share, state.energy_estimate / size());
    share *= std::clamp<S>(tolerance / error / S(2), S(1e-3), S(0.3));
  }
  if (newton) result.newton_steps = newton->steps() - newton_before;
  result.work = state.work;
  result.work += by_newton;
  result.work.operator_applications += frozen.applications() + springs.products() - before;
  return result;
}

/// The run from nothing, of c without its slip bounds; `floating` bodies that contact holds. Throws
/// bad_input where K is found not to be definite or does not fit the nodes.
template <class Friction, class S>
[[nodiscard]] iterated_coulomb_result<S> iterated_coulomb(
    Friction law, Eigen::SparseMatrix<S> const& K, data<S> c, Eigen::VectorX<S> const& F,
    node_layout<S> const& layout, free_motions<S> const& floating, multigrid_options const& levels,
    S const& tolerance, index most) {
  c.g = Eigen::VectorX<S>::Zero(c.nodes());
  moving_springs<S> springs(K, floating, layout.dimension());
  primal_run<S> run(springs.held(), c, layout, levels, steps_for_problems(most));
  energy_certificate frozen(run.qp(), run.levels());
  std::optional<alart_curnier_steps<S>> newton;
  return run_coulomb_to_certified(law, run, newton, springs, frozen, checked_rows<S>(c, {}), F,
                                  tolerance, most);
}

}  // namespace slant::contact::detail
