// SPDX-License-Identifier: MIT
// expect: b must be a slant::vector.*'owns_its_entries['<]
// max-lines-gcc: 20
// max-lines-clang: 25
//
// A linear term that is an expression: nothing is said of A and the set.
#include <slant/operators/identity.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>

struct twice {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const { y = 2 * x; }
};

auto problem(Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  return slant::separable_qp{twice{}, Eigen::VectorXd(2 * b), slant::half_lines(2)};
#else
  return slant::separable_qp{twice{}, 2 * b, slant::half_lines(2)};
#endif
}
