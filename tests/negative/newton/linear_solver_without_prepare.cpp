// SPDX-License-Identifier: MIT
// expect: semismooth_newton: the linear solver must have prepare and solve.*has_prepare
// max-lines-gcc: 30
// max-lines-clang: 30
//
// A client's solver minus the state that it works in.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>

struct picard {
#ifdef SLANT_COMPLETE
  int prepare(auto const&, auto const&) const { return 0; }
#endif
  template <class V>
  slant::direction_report<double> solve(auto const&, V const& f,
                                        slant::direction_request<double> const& r, V& dy,
                                        int&) const {
    dy = -f;
    return {slant::status::converged, r.residual_norm / 2, 1, 0, 0};
  }
};

auto run(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  auto const F = slant::affine(A, -b);
  return slant::solve(slant::semismooth_newton{F, picard{}}, b, slant::residual_below(1e-10))
      .status;
}
