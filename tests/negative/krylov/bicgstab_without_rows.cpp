// SPDX-License-Identifier: MIT
// expect: A must.*'has_rows['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// An operator minus the number of its rows.
#include <slant/krylov/bicgstab.hpp>

#include <Eigen/Core>

struct twice {
#ifdef SLANT_COMPLETE
  Eigen::Index rows() const { return 2; }
#endif
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

auto method(Eigen::VectorXd const& b) {
  return slant::bicgstab{twice{}, b};
}
