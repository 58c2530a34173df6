// SPDX-License-Identifier: MIT
// expect: 'has_like['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A vector of its own kind minus the way to make another one.
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

struct distributed {
  Eigen::VectorXd entries;
  Eigen::VectorXd& local() { return entries; }
  Eigen::VectorXd const& local() const { return entries; }
  double inner_product(distributed const& y) const { return entries.dot(y.entries); }
#ifdef SLANT_COMPLETE
  distributed like(slant::index n) const { return {Eigen::VectorXd(n)}; }
#endif
};

static_assert(slant::vector<distributed>);
