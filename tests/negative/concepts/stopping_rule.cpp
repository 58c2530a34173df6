// SPDX-License-Identifier: MIT
// case WITHOUT_REASON: 'has_reason['<]
// case WITHOUT_VERDICT: 'has_verdict['<]
// case WITHOUT_BASE: an own stopping rule must derive from slant::rule.*'slant::rule' is not a base of 'after_one_step'
// case WITHOUT_BASE, clang: an own stopping rule must derive from slant::rule.*'combinable_rule['<]
// case WITHOUT_BASE, max-lines-gcc: 20
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A stopping rule minus the sentence that says why it fired, or one that answers yes or no, from
// which nobody learns whether that is success; or not derived from slant::rule, so that it has no part
// in || and &&.
#include <slant/slant.hpp>

struct state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

#ifdef WITHOUT_BASE
struct after_one_step {
#else
struct after_one_step : slant::rule {
#endif
#ifdef WITHOUT_VERDICT
  bool operator()(state const& s) const { return s.iteration > 0; }
#else
  slant::status operator()(state const& s) const {
    return s.iteration > 0 ? slant::status::iteration_limit : slant::status::running;
  }
#endif
#ifndef WITHOUT_REASON
  std::string reason(state const&) const { return "one step was enough"; }
#endif
};

static_assert(slant::stopping_rule<after_one_step, state>);
auto const rule = after_one_step{} || slant::at_most(10);
