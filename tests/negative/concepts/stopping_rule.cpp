// SPDX-License-Identifier: MIT
// case WITHOUT_REASON: 'has_reason['<]
// case WITHOUT_VERDICT: 'has_verdict['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A stopping rule minus the sentence that says why it fired, or one that answers yes or no, from
// which nobody learns whether that is success.
#include <slant/slant.hpp>

struct state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

struct after_one_step {
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
