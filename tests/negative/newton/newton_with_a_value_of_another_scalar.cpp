// SPDX-License-Identifier: MIT
// expect: semismooth_newton: F must be a slanting function of vectors like x0
// max-lines-gcc: 30
// max-lines-clang: 40
//
// A function of vectors of float, started from one of double.
#include <slant/slant.hpp>

struct squares {
#ifdef SLANT_COMPLETE
  using vector = Eigen::VectorXd;
#else
  using vector = Eigen::VectorXf;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void value(vector const& y, vector& f) const { f = y.cwiseAbs2(); }
  auto slant(vector const& y) const {
    return slant::matrix(Eigen::MatrixXd(2 * y.cast<double>().asDiagonal()));
  }
};

auto run(Eigen::VectorXd const& x0) {
  return slant::solve(slant::semismooth_newton{squares{}}, x0, slant::residual_below(1e-10)).status;
}
