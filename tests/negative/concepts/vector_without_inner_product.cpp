// SPDX-License-Identifier: MIT
// expect: 'has_inner_product['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A vector of its own kind minus its inner product.
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

struct distributed {
  Eigen::VectorXd entries;
  Eigen::VectorXd& local() { return entries; }
  Eigen::VectorXd const& local() const { return entries; }
#ifdef SLANT_COMPLETE
  double inner_product(distributed const& y) const { return entries.dot(y.entries); }
#endif
  distributed like(slant::index n) const { return {Eigen::VectorXd(n)}; }
};

static_assert(slant::vector<distributed>);
