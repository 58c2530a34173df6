// SPDX-License-Identifier: MIT
// expect: 'has_local['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A vector of its own kind minus the part of it on which Eigen works.
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

struct distributed {
  Eigen::VectorXd entries;
#ifdef SLANT_COMPLETE
  Eigen::VectorXd& local() { return entries; }
  Eigen::VectorXd const& local() const { return entries; }
#endif
  double inner_product(distributed const& y) const { return entries.dot(y.entries); }
  distributed like(slant::index n) const { return {Eigen::VectorXd(n)}; }
};

static_assert(slant::vector<distributed>);
