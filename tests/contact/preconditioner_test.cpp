// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/testing/operator_laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <support/dense_of.hpp>
#include <support/effort.hpp>

namespace preconditioner_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("D B K B' D, with its laws, and a better condition than A alone") {
  auto const scene =
      fem::make_steel_brick({.k = test::effort(3, 2), .load = fem::brick_load::press});
  auto const data = test::contact_data(scene);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  // Two bodies have rows of length √2: scale some.
  Eigen::SparseMatrix<double> B = dual.constraints();
  VectorXd scale = VectorXd::Ones(B.rows());
  scale.head(5).setConstant(3.0);
  B = scale.asDiagonal() * B;
  auto const M = slant::contact::lumped_preconditioner(scene.K, B);
  MatrixXd const D = MatrixXd(B * B.transpose()).diagonal().cwiseInverse().asDiagonal();
  MatrixXd const expected = D * MatrixXd(B) * MatrixXd(scene.K) * MatrixXd(B).transpose() * D;
  CHECK((test::dense_of(M) - expected).norm() <= 1e-14 * expected.norm());
  slant::testing::check_operator_laws(M);

  auto const plain = slant::contact::lumped_preconditioner(scene.K, dual.constraints());
  MatrixXd const A = test::dense_of(dual.a());
  auto const condition = [](MatrixXd const& m) {
    VectorXd const e = m.eigenvalues().cwiseAbs();
    return e.maxCoeff() / e.minCoeff();
  };
  CHECK(condition(test::dense_of(plain) * A) < condition(A) / 3);
}

TEST_CASE("rows on which nothing acts, and sizes that do not fit") {
  Eigen::SparseMatrix<double> K(3, 3), B(2, 3);
  K.setIdentity();
  B.insert(1, 2) = 2.0;
  auto const M = slant::contact::lumped_preconditioner(K, B);
  CHECK(test::dense_of(M) == MatrixXd(VectorXd{{0.0, 0.25}}.asDiagonal()));
  CHECK_THROWS_WITH(static_cast<void>(slant::contact::lumped_preconditioner(
                        K, Eigen::SparseMatrix<double>(2, 4))),
                    "columns of B: got 4, expected the size of K, 3");
  CHECK_THROWS_AS(static_cast<void>(
                      slant::contact::lumped_preconditioner(Eigen::SparseMatrix<double>(3, 2), B)),
                  slant::bad_input);
}

}  // namespace preconditioner_test
