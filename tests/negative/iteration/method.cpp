// SPDX-License-Identifier: MIT
// case USE=solved WITHOUT_STEP: solve: the method must have start.x0., step.state..*'has_step['<]
// case USE=solved A_NUMBER: solve: the rule must judge states of this method
// case USE=iterated WITHOUT_START: 'has_start['<]
// case USE=iterated WITHOUT_START, max-lines-gcc: 25
// case USE=observed WITHOUT_RESIDUAL: solve: an observer must take states of this method.*observer<.*progress_bar
// case USE=asserted WITHOUT_START: 'has_start['<]
// case USE=asserted WITHOUT_START, max-lines-gcc: 25
// case USE=asserted WITHOUT_STEP: 'has_step['<]
// case USE=asserted WITHOUT_STEP, max-lines-gcc: 25
// case USE=asserted WITHOUT_STATUS: 'has_status['<]
// case USE=asserted WITHOUT_STATUS, max-lines-gcc: 25
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A method minus its step or its start, a state minus what says how things stand, or, for a progress
// bar, minus a measure of accuracy. A tolerance in the place of the rule.
#include <slant/iteration/iterates.hpp>
#include <slant/slant.hpp>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
#ifndef WITHOUT_STATUS
  slant::status status = slant::status::running;
#endif
#ifndef WITHOUT_RESIDUAL
  double residual_norm = 1, residual_scale = 1;
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

template <class Method>
void asserted(Method const&, Eigen::VectorXd const&) {
  static_assert(slant::iterative_method<Method, Eigen::VectorXd>);
}
auto solved(auto const& method, Eigen::VectorXd const& x0) {
#ifdef A_NUMBER
  return slant::solve(method, x0, 1e-8);
#else
  return slant::solve(method, x0, slant::at_most(10));
#endif
}
auto iterated(auto const& method, Eigen::VectorXd const& x0) {
  return slant::iterates(method, x0);
}
auto observed(auto const& method, Eigen::VectorXd const& x0) {
  slant::progress_bar bar("halving", 1e-8);
  return slant::solve(method, x0, slant::at_most(10), bar);
}

auto solution(Eigen::VectorXd const& x0) {
  return USE(halving{}, x0);
}
