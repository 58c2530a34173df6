// SPDX-License-Identifier: MIT
// expect: semismooth_newton: a globalisation has first_length, accepts and next_length
// max-lines-gcc: 30
// max-lines-clang: 30
//
// A client's globalisation minus what it does after a refusal.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/affine.hpp>

struct monotone {
  int first_length() const { return 1; }
  bool accepts(auto const& p) const { return p.residual < p.residual_before; }
#ifdef SLANT_COMPLETE
  double next_length(auto const&) const { return 0; }
#endif
};

auto run(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
  auto const F = slant::affine(A, -b);
  slant::semismooth_newton const method{F, slant::by_laws{}, monotone{}};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
