// SPDX-License-Identifier: MIT
// expect: semismooth_newton: a forcing rule takes a forcing_history to a tolerance
// max-lines-gcc: 30
// max-lines-clang: 30
//
// A tolerance in the place of a rule.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>

auto run(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  auto const F = slant::affine(A, -b);
#ifdef SLANT_COMPLETE
  auto const rule = slant::fixed_forcing{.tolerance = 1e-3};
#else
  double const rule = 1e-3;
#endif
  slant::semismooth_newton const method{F, slant::by_laws{}, slant::full_step{}, rule};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
