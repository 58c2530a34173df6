// SPDX-License-Identifier: MIT
// expect: -B . S . adjoint.B.".*not positive_semidefinite: a minus stands before B . S . adjoint.B.".*A must have the laws
// expect-clang: "-B . S . adjoint.B.".*not positive_semidefinite: a mi.*nus stands before B.*A must have the laws
// max-lines-gcc: 12
// max-lines-clang: 20
//
// A maximum written as a minimum.
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/operators.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

auto method(Eigen::MatrixXd const& matrix, Eigen::MatrixXd const& stiffness,
            Eigen::VectorXd const& b) {
  auto const B = slant::op<"B">(matrix);
  auto const S = slant::op<"S", slant::self_adjoint, slant::positive_definite>(stiffness);
#ifdef SLANT_COMPLETE
  auto const A = B * S * adjoint(B);
#else
  auto const A = -(B * S * adjoint(B));
#endif
  return slant::symmetric_newton{slant::separable_qp{A, b, slant::half_lines(b.size())}};
}
