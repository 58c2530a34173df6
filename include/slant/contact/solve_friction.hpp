// SPDX-License-Identifier: MIT
//
// Coulomb friction in one call:
//
//     auto s = slant::contact::solve_friction(problem);
//     if (s.converged()) use(s.r, s.u);
//
// Block Gauss–Seidel with exact contacts comes first, and is all that most problems need. Where it
// crawls, as it does where forces are redundant or the contacts far apart, semismooth Newton on the
// natural map starts from where it is; where that finds no descent, an interior-point method comes
// once from inside of the cones. If it does not solve the problem either, the sweeps go on from
// where they were, ever longer, with Newton's method in between. So each problem is solved by the
// method that suits it, without settings, and a problem without solution ends when turns no longer
// lessen the error, or at the limits of the options.
#pragma once

#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/contact/friction/friction_gauss_seidel.hpp>
#include <slant/contact/friction/friction_interior_point.hpp>
#include <slant/contact/friction/friction_newton.hpp>
#include <slant/contact/friction/friction_problem.hpp>
#include <slant/contact/friction/verify.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace slant::contact {

// --- options and result --------------------------------------------------------------------------

/// Which method solve_friction uses.
enum class friction_method : unsigned char {
  automatic,      ///< the others in turn, until one of them has solved the problem
  gauss_seidel,   ///< friction_gauss_seidel
  newton,         ///< friction_newton with damping, after a few sweeps
  interior_point  ///< friction_interior_point
};

/// The method in words.
[[nodiscard]] constexpr std::string_view to_string(friction_method m) {
  constexpr std::string_view names[] = {"automatic", "gauss_seidel", "newton", "interior_point"};
  auto const k = std::size_t(m);
  return k < std::size(names) ? names[k] : "unknown";
}

/// Options of solve_friction.
template <scalar S = double>
struct friction_options {
  friction_method method = friction_method::automatic;
  /// Of the unit-free natural map and penetration of verify.hpp. Where the natural map of the
  /// literature, with ρ = 1, is larger and not by rounding, the run goes on for a while to make
  /// that smaller too; its verdict does not depend on it.
  S tolerance = S(1e-8);
  asymmetric_data asymmetry = asymmetric_data::used_as_given;
  index first_sweeps = 100;    ///< before the first Newton step
  index sweeps = 300000;       ///< of Gauss–Seidel at most, in all
  index newton_steps = 3000;   ///< at most, in all, those of the interior-point method included
  index interior_steps = 300;  ///< of that method at most
  index attempt = 40;          ///< Newton steps in one attempt of `newton`

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using slant::detail::check_option;
    slant::detail::check_fraction("tolerance", tolerance);
    check_option("first_sweeps", first_sweeps, first_sweeps >= 0, "a number >= 0");
    check_option("sweeps", sweeps, sweeps >= 0, "a number >= 0");
    check_option("newton_steps", newton_steps, newton_steps >= 0, "a number >= 0");
    check_option("interior_steps", interior_steps, interior_steps >= 0, "a number >= 0");
    check_option("attempt", attempt, attempt >= 1, "at least 1");
  }
};

/// Work of solve_friction.
struct friction_work {
  index sweeps = 0;          ///< passes of Gauss–Seidel over the contacts
  index block_products = 0;  ///< N × N blocks of W multiplied in them
  index products = 0;        ///< products by W besides
  index newton_steps = 0;    ///< directions of Newton's method, those of interior_steps included
  index interior_steps = 0;  ///< steps of the interior-point method
  index factorizations = 0;  ///< matrices factored
  index factored_rows = 0;   ///< rows of all of them together
  index sparse_factorizations = 0;  ///< how many of them were sparse

  friend bool operator==(friction_work const&, friction_work const&) = default;
};

/// Result of solve_friction.
template <class S>
struct friction_result {
  using vector_type = Eigen::VectorX<S>;
  vector_type r{};  ///< forces: the best that were found
  vector_type u{};  ///< W r + q
  slant::status status = slant::status::running;
  std::string reason{};       ///< the same as a sentence
  friction_error<S> error{};  ///< of r, as verify finds it
  violation<S> worst{};       ///< the contact with the largest unit-free natural map
  /// What had the last word; `automatic` if there was nothing to do.
  friction_method solved_by = friction_method::automatic;
  friction_work work{};

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

}  // namespace slant::contact

namespace slant::contact::detail {

// --- friction run --------------------------------------------------------------------------------

/// One run of solve_friction: the methods, their turns and their limits.
template <int N, class S>
class friction_run {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;
  using method = friction_method;

  friction_run(friction_problem<S> const& problem, friction_options<S> const& options)
      : options_(options),
        problem_(&problem),
        target_(options.tolerance),
        blocks_(problem),
        gauss_seidel_(blocks_),
        newton_(blocks_),
        best_(vector_type::Zero(blocks_.size())),
        best_u_(blocks_.q()),
        u_(blocks_.size()) {}
  friction_run(friction_run const&) = delete;
  friction_run& operator=(friction_run const&) = delete;

  [[nodiscard]] friction_result<S> result(vector_type const& start) {
    if (blocks_.q_norm() > S(0)) {
      best_error_.scaled = std::numeric_limits<S>::infinity();
      consider(best_, method::automatic);
      if (start.size() != 0) consider(blocks_.from_force(start), method::automatic);
      if (!done()) run();
    }  // else r = 0 is a solution, and no error can be relative to q
    return finished();
  }

 private:
  /// Whether there is nothing left to do. Where the problem is solved but the natural map of the
  /// literature is still larger than the tolerance, the target is made smaller, and no more work
  /// allowed than as much again.
  bool done() {
    if (!best_error_.at_most(target_)) return false;
    S const most = std::max(options_.tolerance, best_error_.floor);
    if (best_error_.plain <= most) return true;
    target_ = best_error_.worst() *
              std::max(std::numeric_limits<S>::epsilon(), S(S(0.5) * most / best_error_.plain));
    if (target_ < S(4) * std::numeric_limits<S>::epsilon()) return true;
    if (!pursuing_) {
      pursuing_ = true;
      options_.sweeps = std::min(options_.sweeps, 2 * work_.sweeps + 200);
      options_.newton_steps = std::min(options_.newton_steps, 2 * steps_done() + 40);
    }
    return false;
  }

  /// Keeps x if it is the best so far; true if the problem is solved.
  bool consider(vector_type const& x, method by) {
    blocks_.velocity(x, u_);
    ++work_.products;
    auto const e = blocks_.error(x, u_);
    if (e.worst() < best_error_.worst()) {
      best_ = x;
      best_u_ = u_;
      best_error_ = e;
      solved_by_ = by;
    }
    return done();
  }

  void run() {
    auto sweeping = gauss_seidel_.start(best_);
    if (options_.method == method::gauss_seidel) {
      if (!sweep(sweeping, options_.sweeps)) end_with(sweeping.status, no_sweeps_left());
      return;
    }
    if (options_.method == method::interior_point) {
      if (!attempt_interior_point()) end_with(interior_status_, no_steps_left());
      return;
    }
    if (sweep(sweeping, options_.first_sweeps)) return;
    if (options_.method == method::newton) {
      if (!attempt_newton(options_.newton_steps)) end_with(status::stalled, no_steps_left());
    } else {
      take_turns(sweeping);
    }
  }

  void take_turns(gauss_seidel_state<S>& sweeping) {
    constexpr index patience = 3;  // turns that hardly lessen the error
    index sweeps = 400, idle = 0;
    bool first = true;  // from wherever it begins, the interior-point method takes the same steps
    while (!out_of_work() && idle < patience) {
      index const before = work_.sweeps + steps_done();
      S const error_before = best_error_.worst();
      if (attempt_newton(options_.attempt)) return;
      if (first && attempt_interior_point()) return;
      first = false;
      // What Newton's method has found is a better start, unless the sweeps are about as far: where
      // forces wander the error does not tell how far they have come.
      bool const lost = sweeping.status != status::running;
      if (lost || best_error_.worst() < S(0.1) * sweeping.best_error.worst()) restart(sweeping);
      if (sweep(sweeping, sweeps)) return;
      if (work_.sweeps + steps_done() == before) break;
      idle = best_error_.worst() <= S(0.9) * error_before ? 0 : idle + 1;
      sweeps = sweeps < options_.sweeps / 4 ? 4 * sweeps : options_.sweeps;
    }
    // Newton's method alone ends soon, so that turns without sweeps say nothing of the problem.
    end_with(status::stalled, no_sweeps_left());
  }

  [[nodiscard]] bool no_sweeps_left() const { return work_.sweeps >= options_.sweeps; }
  [[nodiscard]] index steps_done() const { return newton_.steps() + work_.interior_steps; }
  [[nodiscard]] bool no_steps_left() const { return steps_done() >= options_.newton_steps; }
  [[nodiscard]] bool out_of_work() const { return no_sweeps_left() && no_steps_left(); }
  /// Without a solution: at a limit, or because a method has nothing left to do.
  void end_with(status how, bool limit) {
    if (how == status::running) how = status::stalled;
    status_ = limit && how != status::breakdown ? status::iteration_limit : how;
  }
  void restart(gauss_seidel_state<S>& s) {
    auto memory = std::move(s.memory);
    s = gauss_seidel_.start(best_);
    s.memory = std::move(memory);
    work_.products += s.evaluations;
  }

  /// Gauss–Seidel until the problem is solved, `count` sweeps more are made, or it stops.
  bool sweep(gauss_seidel_state<S>& s, index count) {
    index const end = work_.sweeps + std::min(count, options_.sweeps - work_.sweeps);
    while (work_.sweeps < end && s.status == status::running) {
      if (s.best_error.at_most(target_) && consider(s.best, method::gauss_seidel)) return true;
      index const sweeps = s.sweeps, products = s.block_products, evaluations = s.evaluations;
      gauss_seidel_.step(s, end - work_.sweeps);
      work_.sweeps += s.sweeps - sweeps;
      work_.block_products += s.block_products - products;
      work_.products += s.evaluations - evaluations;
    }
    return consider(s.best, method::gauss_seidel);
  }

  /// Newton's method from the best forces, with a damping that follows its success.
  bool attempt_newton(index steps) {
    constexpr index failures_allowed = 3;
    S const least = S(16) * std::numeric_limits<S>::epsilon();
    vector_type x = best_;
    newton_.begin(x);
    S δ(1e-6);
    index failures = 0;
    for (index k = 0; k < steps && !no_steps_left(); ++k) {
      if (newton_.advance(x, δ)) {
        if (newton_.length() == S(1)) δ = std::max(least, S(δ * S(0.1)));
        if (newton_.length() < S(0.1)) δ *= S(10);
        if (consider(x, method::newton)) return true;
      } else {
        if (++failures > failures_allowed) break;
        δ *= S(100);
      }
    }
    return false;
  }

  /// The interior-point method until the problem is solved or it gets no further.
  bool attempt_interior_point() {
    S const small = std::max(S(S(0.01) * options_.tolerance), std::numeric_limits<S>::min());
    friction_interior_point<N, S> const interior(blocks_, {.small = std::min(S(1e-10), small)});
    auto s = interior.start(best_);
    while (s.status == status::running && s.iteration < options_.interior_steps &&
           !no_steps_left()) {
      if (s.best_error.at_most(target_) && consider(s.best, method::interior_point)) break;
      interior.step(s);
      ++work_.interior_steps;
    }
    work_.products += s.evaluations;
    note(s.lu.work());
    interior_status_ = s.iteration < options_.interior_steps ? s.status : status::iteration_limit;
    return consider(s.best, method::interior_point);
  }

  void note(block_lu_work const& done) {
    work_.factorizations += done.factorizations;
    work_.factored_rows += done.rows;
    work_.sparse_factorizations += done.sparse;
  }

  /// Whether the forces in the units of the data are still those that were found.
  [[nodiscard]] bool keeps(vector_type const& force) const {
    if (blocks_.size() == 0) return true;
    vector_type const back = blocks_.from_force(force);
    return (back - best_).cwiseAbs().maxCoeff() <= options_.tolerance * blocks_.q_norm();
  }

  [[nodiscard]] friction_result<S> finished() {
    using slant::detail::brief;
    using slant::detail::show;
    work_.products += newton_.evaluations();
    work_.newton_steps = steps_done();
    note(newton_.factored());
    vector_type force = blocks_.force(best_), speed = blocks_.speed(best_u_);
    bool const lost = !keeps(force) || !slant::detail::is_finite(S(speed.cwiseAbs().sum()));
    auto const check = verify(*problem_, force);
    ++work_.products;
    friction_error<S> const error{.scaled = check.unit_free_map,
                                  .plain = check.relative_natural_map,
                                  .floor = check.relative_rounding,
                                  .penetration = check.unit_free_penetration};
    bool const holds =
        error.at_most(options_.tolerance) && check.unit_free_rounding <= options_.tolerance;
    bool const solved = best_error_.at_most(options_.tolerance);
    if (solved) status_ = lost ? status::breakdown : holds ? status::converged : status::stalled;
    std::string reason = "unit-free natural map " + brief(error.scaled);
    if (error.penetration > error.scaled) reason += " and penetration " + brief(error.penetration);
    if (status_ == status::converged) {
      reason += " at most " + show(options_.tolerance);
    } else {
      reason = "method " + std::string(to_string(options_.method)) + ": " +
               std::string(to_string(status_)) + " at " + reason;
      if (check.worst.contact >= 0) {
        reason += ", largest at contact " + show(check.worst.contact);
      }
      if (!(check.unit_free_rounding <= options_.tolerance)) {
        reason += ", of which rounding may make " + brief(check.unit_free_rounding);
      }
      if (lost) reason += ", forces or velocities leave the range of numbers in these units";
    }
    bool const agree = (error.plain <= options_.tolerance) == (status_ == status::converged);
    if (!agree) {
      reason += "; with rho = 1 in the units given " + brief(error.plain) +
                ", of which rounding may make " + brief(error.floor);
    }
    return {.r = std::move(force),
            .u = std::move(speed),
            .status = status_,
            .reason = std::move(reason),
            .error = error,
            .worst = check.worst,
            .solved_by = solved_by_,
            .work = work_};
  }

  friction_options<S> options_;
  friction_problem<S> const* problem_;
  S target_;  // of the unit-free measures
  bool pursuing_ = false;
  friction_work work_{};
  friction_blocks<N, S> blocks_;
  friction_gauss_seidel<N, S> gauss_seidel_;
  friction_newton<N, S> newton_;
  vector_type best_, best_u_, u_;
  friction_error<S> best_error_{};
  method solved_by_ = method::automatic;
  status status_ = status::running, interior_status_ = status::running;
};

}  // namespace slant::contact::detail

namespace slant::contact {

// --- solve friction ------------------------------------------------------------------------------

/// Solves the problem of friction/friction_problem.hpp. `start`: forces from before, in the units
/// of the problem; empty for none. Throws bad_input if the problem, the options or the start are
/// not valid, or W is not symmetric and the option says refused; whatever goes wrong later is the
/// status: iteration_limit, stalled (no method gets further) or breakdown, also where forces or
/// velocities are out of the range of numbers in the units of the problem.
template <scalar S>
[[nodiscard]] friction_result<S> solve_friction(
    friction_problem<S> const& problem, friction_options<S> const& options = {},
    typename friction_problem<S>::vector_type const& start = {}) {
  problem.validate();
  options.validate();
  if (start.size() != 0) {
    slant::detail::check_size("start", index(start.size()), index(problem.q.size()));
    slant::detail::check_finite("start", start);
  }
  if (options.asymmetry == asymmetric_data::refused) require_symmetric("W", problem.W);
  return problem.dimension() == 2 ? detail::friction_run<2, S>(problem, options).result(start)
                                  : detail::friction_run<3, S>(problem, options).result(start);
}

#if SLANT_USES_COMPILED
extern template friction_result<double> solve_friction<double>(friction_problem<double> const&,
                                                               friction_options<double> const&,
                                                               Eigen::VectorXd const&);
#endif

}  // namespace slant::contact
