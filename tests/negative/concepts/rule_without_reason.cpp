// SPDX-License-Identifier: MIT
// expect: 'has_reason['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A stopping rule minus the sentence that says why it fired.
#include <slant/concepts/iterative_method.hpp>

#include <Eigen/Core>

struct state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

struct after_one_step {
  slant::status operator()(state const& s) const {
    return s.iteration > 0 ? slant::status::iteration_limit : slant::status::running;
  }
#ifdef SLANT_COMPLETE
  std::string reason(state const&) const { return "one step was enough"; }
#endif
};

static_assert(slant::stopping_rule<after_one_step, state>);
