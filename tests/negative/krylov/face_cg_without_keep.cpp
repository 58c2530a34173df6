// SPDX-License-Identifier: MIT
// expect: the face must.*has_keep
// expect-clang: the face must.*'has_keep['<]
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A face minus keep: nothing keeps the directions on it.
#include <slant/krylov/face_cg.hpp>
#include <slant/operators/identity.hpp>

#include <Eigen/Core>

struct first_entry {
#ifdef SLANT_COMPLETE
  void keep(auto const& x, auto& y) const {
    y = x;
    y[1] = 0;
  }
#endif
};

auto method(Eigen::VectorXd const& b) {
  return slant::face_cg{slant::identity_operator(2), b, first_entry{}};
}
