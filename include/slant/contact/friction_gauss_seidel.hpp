// SPDX-License-Identifier: MIT
//
// Block Gauss–Seidel for Coulomb friction (friction_sweeps.hpp) with extrapolation.
//
// With redundant contacts W has a kernel, along which forces wander at a speed that is proportional
// to a velocity that is nearly 0 already: thousands of sweeps in nearly the same direction. After
// some sweeps r⁰ → r¹ the point P_K(r¹ + t (r¹ − r⁰)), made smooth by as many sweeps, is taken if
// its error is no larger than that of r¹, and t doubled; otherwise t is quartered.
#pragma once

#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/friction_blocks.hpp>
#include <slant/contact/friction_sweeps.hpp>

#include <algorithm>
#include <limits>

namespace slant::contact {

/// Options of friction_gauss_seidel.
template <class S>
struct gauss_seidel_options {
  index sweeps = 10;      ///< of one step, before and after the extrapolation
  index full_every = 10;  ///< every which sweep looks at all contacts
  S growth = S(2);        ///< of the extrapolation when it is accepted
  S shrink = S(0.25);     ///< when not
  S slack = S(1.02);      ///< accepted if the error is at most that multiple
  index patience = 3000;  ///< steps without a new smallest error that mean stalled

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using slant::detail::show;
    if (sweeps < 1) throw bad_input("sweeps", show(sweeps), "at least 1");
    if (full_every < 1) throw bad_input("full_every", show(full_every), "at least 1");
    if (!(growth >= S(1)) || !slant::detail::is_finite(growth)) {
      throw bad_input("growth", show(growth), "a finite number >= 1");
    }
    if (!(shrink > S(0) && shrink < S(1))) {
      throw bad_input("shrink", show(shrink), "a number in (0, 1)");
    }
    if (!(slack >= S(1)) || !slant::detail::is_finite(slack)) {
      throw bad_input("slack", show(slack), "a finite number >= 1");
    }
    if (patience < 1) throw bad_input("patience", show(patience), "at least 1");
  }
};

/// State of friction_gauss_seidel.
template <class S>
struct gauss_seidel_state {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  vector_type x{};            ///< forces, in the units of the blocks
  vector_type u{};            ///< W x + q
  friction_error<S> error{};  ///< of x
  vector_type best{};         ///< the x with the smallest error so far
  friction_error<S> best_error{};
  S length = S(1);           ///< t
  index iteration = 0;       ///< steps
  index sweeps = 0;          ///< passes over the contacts
  index block_products = 0;  ///< blocks of W multiplied in them
  index evaluations = 0;     ///< of the error: a product by W each
  index since_best = 0;
  slant::status status = slant::status::running;
  vector_type trial{}, trial_u{};
  friction_sweep_memory<S> memory{};
};

/// Block Gauss–Seidel with extrapolation; see the top of this file. No allocation in a step.
template <int N, scalar S = double>
class friction_gauss_seidel {
 public:
  using vector_type = typename friction_blocks<N, S>::vector_type;
  using state_type = gauss_seidel_state<S>;

  explicit friction_gauss_seidel(friction_blocks<N, S> const& blocks,
                                 gauss_seidel_options<S> options = {})
      : blocks_(&blocks), sweeps_(blocks), options_(options) {
    options_.validate();
  }

  [[nodiscard]] state_type start(vector_type const& x0) const {
    slant::detail::check_size("x0", index(x0.size()), blocks_->size());
    slant::detail::check_finite("x0", x0);
    state_type s;
    s.x = x0;
    s.u.resize(x0.size());
    s.trial.resize(x0.size());
    s.trial_u.resize(x0.size());
    s.error = measure(s, s.x, s.u);
    s.best = s.x;
    s.best_error = s.error;
    s.memory = sweeps_.memory();
    return s;
  }

  /// One step; of at most `most` sweeps if there is a limit.
  void step(state_type& s, index most = std::numeric_limits<index>::max()) const {
    if (s.status != slant::status::running) return;
    ++s.iteration;
    s.trial = s.x;
    pass(s, s.x, most);
    s.error = measure(s, s.x, s.u);
    if (most > options_.sweeps) extrapolate(s, most - options_.sweeps);
    judge(s);
  }

 private:
  void extrapolate(state_type& s, index most) const {
    for (index k = 0; k < s.x.size(); ++k) s.trial[k] = s.x[k] + s.length * (s.x[k] - s.trial[k]);
    for (index i = 0; i < blocks_->contacts(); ++i) {
      blocks_->put(blocks_->cone(i).project(blocks_->part_of(s.trial, i)), i, s.trial);
    }
    pass(s, s.trial, most);
    auto const extrapolated = measure(s, s.trial, s.trial_u);
    if (extrapolated.worst() <= options_.slack * s.error.worst()) {
      s.x.swap(s.trial);
      s.u.swap(s.trial_u);
      s.error = extrapolated;
      s.length = std::min(S(s.length * options_.growth), S(1) / std::numeric_limits<S>::epsilon());
    } else {
      s.length = std::max(S(1), S(s.length * options_.shrink));
    }
  }
  void judge(state_type& s) const {
    if (!slant::detail::is_finite(s.error.worst())) {
      s.status = slant::status::breakdown;
    } else if (s.error.worst() < s.best_error.worst()) {
      s.best = s.x;
      s.best_error = s.error;
      s.since_best = 0;
    } else if (++s.since_best >= options_.patience) {
      s.status = slant::status::stalled;
    }
  }
  friction_error<S> measure(state_type& s, vector_type const& x, vector_type& u) const {
    blocks_->velocity(x, u);
    ++s.evaluations;
    return blocks_->error(x, u);
  }
  void pass(state_type& s, vector_type& x, index most) const {
    for (index k = 0; k < std::min(options_.sweeps, most); ++k) {
      s.block_products += sweeps_.sweep(x, s.memory, s.sweeps % options_.full_every == 0);
      ++s.sweeps;
    }
  }

  friction_blocks<N, S> const* blocks_;
  friction_sweeps<N, S> sweeps_;
  gauss_seidel_options<S> options_;
};

}  // namespace slant::contact
