// SPDX-License-Identifier: MIT
// expect: B . inverse.K. . B . c . I".*not self_adjoint: in the term B . inverse.K. . B, B at the end is not adjoint.B.".*A must have the laws
// expect-clang: B . inverse.K. . B . c . I".*not self_adjoint: in the term B".*is not adjoint.B.".*A must have the laws
// max-lines-gcc: 12
// max-lines-clang: 20
//
// B K⁻¹ B where B K⁻¹ Bᵀ is meant: the first line shows the formula and the place.
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/operators.hpp>

auto method(Eigen::MatrixXd const& matrix, Eigen::MatrixXd const& stiffness,
            Eigen::VectorXd const& b) {
  auto const B = slant::op<"B">(matrix);
  auto const Kinv = inverse(slant::op<"K">(slant::dense_ldlt(stiffness)));
#ifdef SLANT_COMPLETE
  auto const A = B * Kinv * adjoint(B) + 1e-3 * slant::identity(matrix.rows());
#else
  auto const A = B * Kinv * B + 1e-3 * slant::identity(matrix.rows());
#endif
  return slant::cg{A, b};
}
