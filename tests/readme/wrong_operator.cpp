// SPDX-License-Identifier: MIT
//
// Does not compile; README.md quotes what g++ says about it, and readme.cmake compares.
#include <slant/methods/kprgp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>

struct laplacian {  // promises nothing
  Eigen::Index n;
  Eigen::Index rows() const { return n; }
  Eigen::Index cols() const { return n; }
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = 2 * x; }
};

void minimise(Eigen::VectorXd const& b) {
  slant::kprgp method{slant::separable_qp{laplacian{b.size()}, b, slant::half_lines(b.size())}};
}
