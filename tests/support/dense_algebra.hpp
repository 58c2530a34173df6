// SPDX-License-Identifier: MIT
//
// Dense linear algebra of the tests as functions of MatrixXd and VectorXd, compiled once: a type of
// Eigen's expressions costs the compiler up to seconds.
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <concepts>
#include <type_traits>

namespace test {

/// Eigenvalues of a symmetric matrix, increasing.
[[nodiscard]] Eigen::VectorXd eigenvalues_of(Eigen::MatrixXd const& A);
/// Moduli of the eigenvalues of any square matrix.
[[nodiscard]] Eigen::VectorXd eigenvalue_moduli(Eigen::MatrixXd const& A);
/// Q of A = Q R.
[[nodiscard]] Eigen::MatrixXd orthonormal(Eigen::MatrixXd const& A);
/// A⁻¹ b by LU.
[[nodiscard]] Eigen::VectorXd solution_of(Eigen::MatrixXd const& A, Eigen::VectorXd const& b);
/// A⁻¹ B by LU.
[[nodiscard]] Eigen::MatrixXd solutions_of(Eigen::MatrixXd const& A, Eigen::MatrixXd const& B);
/// The shortest x of least ‖A x − b‖.
[[nodiscard]] Eigen::VectorXd least_squares(Eigen::MatrixXd const& A, Eigen::VectorXd const& b);
/// A⁺.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(Eigen::MatrixXd const& A);

/// A matrix for the operators below.
template <class A>
concept any_matrix =
    std::derived_from<A, Eigen::EigenBase<A>> && std::same_as<typename A::Scalar, double> &&
    A::RowsAtCompileTime != 1 && A::ColsAtCompileTime != 1;
template <class A>
concept dense_matrix = any_matrix<A> && std::derived_from<A, Eigen::MatrixBase<A>>;

[[nodiscard]] inline Eigen::MatrixXd const& in_full(Eigen::MatrixXd const& A) {
  return A;
}
template <any_matrix A>
[[nodiscard]] Eigen::MatrixXd in_full(A const& a) {
  return a;
}

[[nodiscard]] Eigen::MatrixXd product(Eigen::MatrixXd const& A, Eigen::MatrixXd const& B);
/// A + c B.
[[nodiscard]] Eigen::MatrixXd sum(Eigen::MatrixXd const& A, double c, Eigen::MatrixXd const& B);
[[nodiscard]] Eigen::MatrixXd multiple(double c, Eigen::MatrixXd const& A);

/// With `using namespace test::evaluated;` sums, products and multiples of matrices are
/// matrices, not expressions.
namespace evaluated {

template <any_matrix A, any_matrix B>
  requires(dense_matrix<A> || dense_matrix<B>)
[[nodiscard]] Eigen::MatrixXd operator*(A const& a, B const& b) {
  return product(in_full(a), in_full(b));
}
template <any_matrix A, any_matrix B>
  requires(dense_matrix<A> || dense_matrix<B>)
[[nodiscard]] Eigen::MatrixXd operator+(A const& a, B const& b) {
  return sum(in_full(a), 1, in_full(b));
}
template <any_matrix A, any_matrix B>
  requires(dense_matrix<A> || dense_matrix<B>)
[[nodiscard]] Eigen::MatrixXd operator-(A const& a, B const& b) {
  return sum(in_full(a), -1, in_full(b));
}
template <class Number, dense_matrix A>
  requires std::is_arithmetic_v<Number>
[[nodiscard]] Eigen::MatrixXd operator*(Number c, A const& a) {
  return multiple(double(c), in_full(a));
}

}  // namespace evaluated

}  // namespace test
