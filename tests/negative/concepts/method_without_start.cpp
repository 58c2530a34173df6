// SPDX-License-Identifier: MIT
// expect: 'has_start['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A method minus its start.
#include <slant/concepts/iterative_method.hpp>

#include <Eigen/Core>

struct halving_state {
  Eigen::VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

struct halving {
#ifdef SLANT_COMPLETE
  halving_state start(Eigen::VectorXd const& x0) const { return {x0}; }
#endif
  void step(halving_state& s) const {
    s.x /= 2;
    ++s.iteration;
  }
};

static_assert(slant::iterative_method<halving, Eigen::VectorXd>);
