// SPDX-License-Identifier: MIT
// expect: 'has_status['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A method whose state does not say how things stand.
#include <slant/concepts/iterative_method.hpp>

#include <Eigen/Core>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
#ifdef SLANT_COMPLETE
  slant::status status = slant::status::running;
#endif
};

struct halving {
  halving_state start(Eigen::VectorXd const& x0) const { return {x0}; }
  void step(halving_state& s) const {
    s.x /= 2;
    ++s.iteration;
  }
};

static_assert(slant::iterative_method<halving, Eigen::VectorXd>);
