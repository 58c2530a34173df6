// SPDX-License-Identifier: MIT
// expect: b must be a slant::vector.*'has_like['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A vector of its own kind minus the way to make another one; nothing is said of the operator.
#include <slant/krylov/cg.hpp>

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

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(distributed const& x, distributed& y) const { y.entries = 2 * x.entries; }
};

auto method(distributed const& b) {
  return slant::cg{twice{}, b};
}
