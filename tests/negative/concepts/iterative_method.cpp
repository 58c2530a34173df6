// SPDX-License-Identifier: MIT
// case WITHOUT_START: 'has_start['<]
// case WITHOUT_STEP: 'has_step['<]
// case WITHOUT_STATUS: 'has_status['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A method minus its start, its step, or a state that says how things stand.
#include <slant/concepts/iterative_method.hpp>

#include <Eigen/Core>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
#ifndef WITHOUT_STATUS
  slant::status status = slant::status::running;
#endif
};

struct halving {
#ifndef WITHOUT_START
  halving_state start(Eigen::VectorXd const& x0) const { return {x0}; }
#endif
#ifndef WITHOUT_STEP
  void step(halving_state& s) const {
    s.x /= 2;
    ++s.iteration;
  }
#endif
};

static_assert(slant::iterative_method<halving, Eigen::VectorXd>);
