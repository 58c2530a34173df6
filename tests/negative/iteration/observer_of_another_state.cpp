// SPDX-License-Identifier: MIT
// expect: solve: an observer must take states of this method.*observer<.*progress_bar
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A progress bar for a method whose state has no measure of accuracy.
#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>

#include <Eigen/Core>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
#ifdef SLANT_COMPLETE
  double residual_norm = 1, residual_scale = 1;
#endif
};

struct halving {
  halving_state start(Eigen::VectorXd const& x0) const { return {x0}; }
  void step(halving_state& s) const {
    s.x /= 2;
    ++s.iteration;
  }
};

auto solution(Eigen::VectorXd const& x0) {
  slant::progress_bar bar("halving", 1e-8);
  return slant::solve(halving{}, x0, slant::at_most(10), bar);
}
