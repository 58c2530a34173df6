// SPDX-License-Identifier: MIT
// expect: has_inner_product.*does not satisfy return-type-requirement
// expect-clang: 'has_inner_product['<].*'std::convertible_to<std::basic_string
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A vector of its own kind whose inner product is no number.
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <string>

struct distributed {
  Eigen::VectorXd entries;
  Eigen::VectorXd& local() { return entries; }
  Eigen::VectorXd const& local() const { return entries; }
#ifdef SLANT_COMPLETE
  double inner_product(distributed const& y) const { return entries.dot(y.entries); }
#else
  std::string inner_product(distributed const&) const { return "large"; }
#endif
  distributed like(slant::index n) const { return {Eigen::VectorXd(n)}; }
};

static_assert(slant::vector<distributed>);
