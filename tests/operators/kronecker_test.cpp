// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "operators/dense_oracle.hpp"

namespace kronecker_test {

/// By its definition.
MatrixXd kronecker(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd k(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      k.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
    }
  }
  return k;
}

TEST_CASE("A ⊗ B is what its definition says, and so is its adjoint") {
  MatrixXd const a = test::random_dense(2, 3, 1), b = test::random_dense(4, 5, 2);
  auto const k = slant::kronecker(a, b);
  CHECK(k.rows() == 8);
  CHECK(k.cols() == 15);
  CHECK(test::matches(k, kronecker(a, b)));
  slant::testing::check_operator_laws(k);
  VectorXd const x = test::random_column(15, 3);
  VectorXd y(8);
  auto w = slant::workspace(k, x);
  CHECK(test::allocations_of([&] { slant::apply(k, x, y, w); }) == 0);
}

TEST_CASE("laws of self-adjoint factors, diagonal, inverse") {
  using namespace slant;
  MatrixXd const m = test::random_spd(3, 1), n = test::random_spd(2, 2);
  auto const a = matrix<self_adjoint, positive_definite>(m);
  auto const b = matrix<self_adjoint, positive_definite>(n);
  auto const k = kronecker(a, b);
  static_assert(spd_operator<decltype(k), VectorXd>);
  CHECK(test::matches(k, kronecker_test::kronecker(m, n)));
  testing::check_operator_laws(k);
  // Definite, not self-adjoint: (A ⊗ A) of a rotation by 90° is not definite.
  static_assert(
      laws_of<decltype(kronecker(matrix<positive_definite>(m), matrix<positive_definite>(n)))> ==
      law_set{});
  auto const d = kronecker(identity(2), diagonal<positive_definite>(VectorXd{{1.0, 4.0}}));
  static_assert(has_inverse<decltype(d), VectorXd>);
  CHECK(test::matches(d.inverse(), MatrixXd(VectorXd{{1.0, 0.25, 1.0, 0.25}}.asDiagonal())));
  testing::check_operator_laws(d);
}

}  // namespace kronecker_test
