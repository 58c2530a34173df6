// SPDX-License-Identifier: MIT
// expect: solve: the method must have start.x0., step.state..*'has_step['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A method minus its step.
#include <slant/iteration/solve.hpp>

#include <Eigen/Core>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

struct halving {
  halving_state start(Eigen::VectorXd const& x0) const { return {x0}; }
#ifdef SLANT_COMPLETE
  void step(halving_state& s) const {
    s.x /= 2;
    ++s.iteration;
  }
#endif
};

auto solution(Eigen::VectorXd const& x0) {
  return slant::solve(halving{}, x0, slant::at_most(10));
}
