// SPDX-License-Identifier: MIT
// expect: 'declares_positive_definite['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A Newton operator I − G (I − ρ A) whose A has not promised to be definite.
#include <slant/slant.hpp>

auto newton(Eigen::MatrixXd const& matrix, Eigen::VectorXd const& b) {
#ifdef SLANT_COMPLETE
  auto const A = slant::declare<slant::self_adjoint, slant::positive_definite>(matrix);
#else
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(matrix);
#endif
  auto const F = slant::natural_residual(A, b, slant::half_lines(b.size()), 0.5);
  auto const M = F.slant(b);
  return slant::symmetrized(M).rows();
}
