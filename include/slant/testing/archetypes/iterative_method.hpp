// SPDX-License-Identifier: MIT
//
// The least that is an iterative method, a stopping rule and an observer. The driver, the range of
// iterates and the algebra of rules compile with these, so they ask for nothing more.
#pragma once

#include <slant/concepts/iterative_method.hpp>
#include <slant/iteration/stopping.hpp>

#include <string>

namespace slant::testing::archetype {

/// Counts down from its start to 0 and rests there. Its iterate is no vector; its state can be
/// moved but not copied.
class iterative_method {
 public:
  class state {
   public:
    explicit state(int from) : x(from) {}
    state(state&&) = default;
    state& operator=(state&&) = default;

    int x;
    index iteration = 0;
    slant::status status = slant::status::running;
  };

  [[nodiscard]] state start(int const& x0) const { return state(x0); }
  void step(state& s) const {
    if (s.x == 0) {
      s.status = slant::status::converged;
    } else {
      --s.x;
      ++s.iteration;
    }
  }
};

/// Stops when the iterate is below a bound.
class stopping_rule : public rule {
 public:
  explicit stopping_rule(int bound) : bound_(bound) {}
  [[nodiscard]] status operator()(iterative_method::state const& s) const {
    return s.x < bound_ ? status::interrupted : status::running;
  }
  [[nodiscard]] std::string reason(iterative_method::state const&) const { return "below"; }

 private:
  int bound_;
};

/// Counts the states it is shown.
class observer {
 public:
  observer() = default;
  observer(observer const&) = delete;
  observer& operator=(observer const&) = delete;
  void operator()(iterative_method::state const&) { ++seen_; }
  [[nodiscard]] int seen() const { return seen_; }

 private:
  int seen_ = 0;
};

static_assert(slant::iterative_method<iterative_method, int>);
static_assert(slant::stopping_rule<stopping_rule, iterative_method::state>);
static_assert(slant::observer<observer, iterative_method::state>);
static_assert(!std::copyable<iterative_method::state>);

}  // namespace slant::testing::archetype
