// SPDX-License-Identifier: MIT
#include "support/eigen_instances.hpp"

#include "support/dense_algebra.hpp"

#include <Eigen/Eigenvalues>

namespace test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd eigenvalues_of(MatrixXd const& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}
VectorXd eigenvalue_moduli(MatrixXd const& A) {
  return A.eigenvalues().cwiseAbs();
}
MatrixXd orthonormal(MatrixXd const& A) {
  return Eigen::HouseholderQR<MatrixXd>(A).householderQ();
}
VectorXd solution_of(MatrixXd const& A, VectorXd const& b) {
  return A.partialPivLu().solve(b);
}
MatrixXd solutions_of(MatrixXd const& A, MatrixXd const& B) {
  return A.partialPivLu().solve(B);
}
VectorXd least_squares(MatrixXd const& A, VectorXd const& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}
MatrixXd pseudo_inverse(MatrixXd const& A) {
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

MatrixXd product(MatrixXd const& A, MatrixXd const& B) {
  return A * B;
}
MatrixXd sum(MatrixXd const& A, double c, MatrixXd const& B) {
  return A + c * B;
}
MatrixXd multiple(double c, MatrixXd const& A) {
  return c * A;
}

}  // namespace test
