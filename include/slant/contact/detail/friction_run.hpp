// SPDX-License-Identifier: MIT
//
// One run of solve_friction: the methods, their turns and their limits.
#pragma once

#include <slant/contact/friction_newton.hpp>
#include <slant/contact/friction_options.hpp>
#include <slant/contact/friction_sweeps.hpp>
#include <slant/methods/proximal_point.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace slant::contact::detail {

/// The inner problems of the proximal point method: Newton, with sweeps where it fails.
template <int N, class S>
class friction_proximal_step {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;

  friction_proximal_step(friction_blocks<N, S> const& blocks, friction_newton<N, S>& newton,
                         friction_options<S> const& options, friction_work& work)
      : blocks_(&blocks),
        newton_(&newton),
        sweeps_(blocks),
        options_(&options),
        work_(&work),
        u_(blocks.size()) {}

  proximal_inner_report operator()(vector_type const& center, S const& α, vector_type& x) {
    proximal_inner_report report;
    newton_->set_proximal(α, center);
    S first(-1);
    for (index rescue = 0; rescue <= options_->rescues; ++rescue) {
      for (index k = 0; k < 20 * rescue * rescue; ++k) {
        work_->block_products += sweeps_.sweep(x, k == 0, α, newton_->weight(), center);
        ++work_->sweeps;
      }
      S now = newton_->begin(x);
      if (first < S(0)) first = now;
      for (index k = 0;; ++k) {
        S const moved = α / (S(1) + α) * (x - center).norm();
        S const rounding = S(16) * std::numeric_limits<S>::epsilon() * x.norm();
        if (now <= std::max(rounding, S(S(0.01) * std::min(first, moved)))) {
          report.solved = true;
          return report;
        }
        if (k == options_->inner_steps) break;
        ++report.steps;
        if (!newton_->advance(x, S(0), options_->halvings)) break;
        now = newton_->residual_norm();
      }
    }
    report.accept = error_at(x) < error_at(center);
    return report;
  }

 private:
  S error_at(vector_type const& x) {
    blocks_->velocity(x, u_);
    ++work_->products;
    return blocks_->error(x, u_).worst();
  }

  friction_blocks<N, S> const* blocks_;
  friction_newton<N, S>* newton_;
  friction_sweeps<N, S> sweeps_;
  friction_options<S> const* options_;
  friction_work* work_;
  vector_type u_;
};

/// See the top of this file. Used once.
template <int N, class S>
class friction_run {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;

  friction_run(friction_problem<S> const& problem, friction_options<S> const& options)
      : options_(options),
        blocks_(problem),
        sweeps_(blocks_, options.gauss_seidel),
        newton_(blocks_, options.equations),
        best_u_(blocks_.size()),
        u_(blocks_.size()) {}

  [[nodiscard]] friction_result<S> result(vector_type const& start) {
    best_ = start.size() == 0 ? vector_type::Zero(blocks_.size()) : blocks_.from_force(start);
    best_error_.scaled = std::numeric_limits<S>::infinity();
    if (blocks_.q_norm() == S(0)) {  // W r ∈ … without load: r = 0
      best_.setZero();
      best_u_.setZero();
      best_error_ = {};
      status_ = status::converged;
      return finished();
    }
    consider(vector_type::Zero(blocks_.size()), friction_method::automatic);
    if (start.size() != 0) consider(blocks_.from_force(start), friction_method::automatic);
    if (!solved()) run();
    return finished();
  }

 private:
  [[nodiscard]] bool solved() const { return best_error_.at_most(options_.tolerance); }

  /// Keeps x if it is the best so far; true if it solves the problem.
  bool consider(vector_type const& x, friction_method by) {
    blocks_.velocity(x, u_);
    ++work_.products;
    auto const e = blocks_.error(x, u_);
    if (e.worst() < best_error_.worst()) {
      best_ = x;
      best_u_ = u_;
      best_error_ = e;
      solved_by_ = by;
    }
    return solved();
  }

  void run() {
    using method = friction_method;
    auto sweeping = sweeps_.start(best_);
    bool const single = options_.method != method::automatic;
    if (options_.method == method::gauss_seidel) {
      if (!sweep(sweeping, options_.sweeps)) finish_single(sweeping.status, "Gauss–Seidel");
      return;
    }
    if (sweep(sweeping, options_.first_sweeps)) return;
    friction_proximal_step<N, S> inner(blocks_, newton_, options_, work_);
    using proximal_type = proximal_point<friction_proximal_step<N, S>&, S>;
    proximal_type proximal(inner, options_.proximal);
    if (single) {
      if (options_.method == method::newton) {
        if (!attempt_newton(options_.newton_steps)) finish_single(status::stalled, "Newton");
      } else {
        auto s = proximal.start(best_);
        if (!follow(proximal, s, options_.newton_steps)) finish_single(s.status, "proximal point");
      }
      return;
    }
    index budget = options_.attempt;
    S const before = best_error_.worst();
    static_cast<void>(before);
    for (index round = 0; !out_of_work(); ++round) {
      if (attempt_newton(options_.attempt)) return;
      auto path = proximal.start(best_);
      if (follow(proximal, path, budget)) return;
      index const more = std::max(S(4) * S(options_.first_sweeps), S(0)) > S(0)
                             ? 4 * options_.first_sweeps << std::min<index>(2 * round, 12)
                             : index(400);
      // What Newton's method has found is a better start, unless the sweeps are about as far: their
      // way is not to be lost.
      if (best_error_.worst() < S(0.1) * sweeping.best_error.worst()) restart(sweeping);
      if (sweep(sweeping, more)) return;
      budget *= 2;
    }
    status_ = status::iteration_limit;
  }

  [[nodiscard]] bool out_of_work() const {
    return work_.sweeps >= options_.sweeps && newton_.work().steps >= options_.newton_steps;
  }
  void finish_single(status how, char const* what) {
    status_ = how == status::running ? status::iteration_limit : how;
    name_ = what;
  }
  void restart(gauss_seidel_state<S>& s) {
    index const sweeps = s.sweeps, products = s.block_products, evaluations = s.evaluations;
    s = sweeps_.start(best_);
    s.sweeps = sweeps;
    s.block_products = products;
    s.evaluations += evaluations;
  }

  bool sweep(gauss_seidel_state<S>& s, index count) {
    index const end = std::min(work_.sweeps + count, options_.sweeps);
    while (work_.sweeps < end && s.status == status::running) {
      index const sweeps = s.sweeps, products = s.block_products, evaluations = s.evaluations;
      sweeps_.step(s);
      work_.sweeps += s.sweeps - sweeps;
      work_.block_products += s.block_products - products;
      work_.products += s.evaluations - evaluations;
      if (s.since_best == 0 && s.best_error.worst() < best_error_.worst()) {
        if (s.best_error.at_most(options_.tolerance)) {
          return consider(s.best, friction_method::gauss_seidel);
        }
      }
    }
    return consider(s.best, friction_method::gauss_seidel);
  }

  bool attempt_newton(index steps) {
    vector_type x = best_;
    newton_.set_proximal(S(0), x);
    S const first = newton_.begin(x);
    static_cast<void>(first);
    S δ = options_.damping;
    index failures = 0;
    for (index k = 0; k < steps && newton_.work().steps < options_.newton_steps; ++k) {
      if (newton_.advance(x, δ, options_.halvings)) {
        if (newton_.length() == S(1)) δ *= S(0.1);
        if (newton_.length() < S(0.1)) δ *= S(10);
        if (consider(x, friction_method::newton)) return true;
      } else {
        if (++failures > 3) break;
        δ = std::max(S(δ * S(100)), S(1e-12));
      }
      δ = std::max(δ, S(16) * std::numeric_limits<S>::epsilon());
    }
    return false;
  }

  template <class Proximal, class State>
  bool follow(Proximal& proximal, State& s, index steps) {
    index const end = std::min(newton_.work().steps + steps, options_.newton_steps);
    while (newton_.work().steps < end && s.status == status::running) {
      index const before = newton_.work().steps;
      proximal.step(s);
      ++work_.proximal_steps;
      if (consider(s.x, friction_method::proximal_newton)) return true;
      if (newton_.work().steps == before && s.step_norm == S(0)) break;
    }
    return false;
  }

  [[nodiscard]] friction_result<S> finished() {
    auto const& n = newton_.work();
    work_.products += n.evaluations;
    work_.newton_steps = n.steps;
    work_.factorizations = n.factorizations;
    work_.factored_rows = n.unknowns;
    work_.sparse_factorizations = n.sparse;
    if (solved()) status_ = status::converged;
    friction_result<S> out;
    out.r = blocks_.force(best_);
    out.u = blocks_.speed(best_u_);
    out.status = status_;
    out.error = best_error_;
    out.solved_by = solved_by_;
    out.work = work_;
    using slant::detail::show;
    std::string const figures = "natural map " + show(best_error_.plain) + " relative to q";
    out.reason = status_ == status::converged
                     ? figures + ", at most " + show(options_.tolerance)
                     : std::string(name_) + ": " + std::string(to_string(status_)) + ", " + figures;
    return out;
  }

  friction_options<S> options_;
  friction_blocks<N, S> blocks_;
  friction_gauss_seidel<N, S> sweeps_;
  friction_newton<N, S> newton_;
  vector_type best_, best_u_, u_;
  friction_error<S> best_error_{};
  friction_method solved_by_ = friction_method::automatic;
  friction_work work_;
  status status_ = status::running;
  char const* name_ = "all methods in turn";
};

}  // namespace slant::contact::detail
