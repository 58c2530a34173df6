// SPDX-License-Identifier: MIT
#include <slant/contact/dual.hpp>

#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/testing/laws.hpp>

#include <fem/two_plates.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace preconditioners_test {

using namespace test::evaluated;
using Eigen::SparseMatrix;

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
    VectorXd const e = test::eigenvalue_moduli(m);
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

TEST_CASE("one body: M is the inverse of A") {
  auto const scene = fem::make_steel_brick({.k = test::effort(3, 2)});
  auto const data = test::contact_data(scene);
  slant::contact::dual const dual(slant::contact::friction_disc{}, slant::factorize(scene.K), data);
  auto const M = slant::contact::dirichlet_preconditioner(scene.K, dual.constraints());
  MatrixXd const product = test::dense_of(M) * test::dense_of(dual.a());
  CHECK((product - MatrixXd::Identity(product.rows(), product.cols())).norm() <= 1e-10);
  slant::testing::check_operator_laws(M);
}

TEST_CASE("two bodies, rows of any length: as computed by hand from dense blocks") {
  auto const scene = fem::make_two_plates(2);
  SparseMatrix<double> B(scene.N.rows() + scene.T.rows(), scene.K.cols());
  MatrixXd stacked(B.rows(), B.cols());
  stacked << MatrixXd(scene.N), 3 * MatrixXd(scene.T);
  B = stacked.sparseView();
  auto const M = slant::contact::dirichlet_preconditioner(scene.K, B);

  std::vector<Eigen::Index> c, i;
  for (Eigen::Index j = 0; j < stacked.cols(); ++j) (stacked.col(j).isZero(0) ? i : c).push_back(j);
  MatrixXd const K(scene.K);
  MatrixXd const S = K(c, c) - K(c, i) * test::solutions_of(K(i, i), K(i, c));
  VectorXd const D = stacked.rowwise().squaredNorm().cwiseInverse();
  MatrixXd const expected = D.asDiagonal() * stacked(Eigen::all, c) * S *
                            stacked(Eigen::all, c).transpose() * D.asDiagonal();
  CHECK((test::dense_of(M) - expected).norm() <= 1e-12 * expected.norm());
}

TEST_CASE("nothing but contact unknowns, rows on which nothing acts, sizes that do not fit") {
  SparseMatrix<double> K(2, 2), B(3, 2);
  K.insert(0, 0) = 2.0;
  K.insert(1, 1) = 4.0;
  B.insert(0, 1) = 1.0;
  B.insert(2, 0) = 2.0;
  auto const M = slant::contact::dirichlet_preconditioner(K, B);
  CHECK(test::dense_of(M) == MatrixXd(VectorXd{{4.0, 0.0, 0.5}}.asDiagonal()));
  CHECK_THROWS_AS(
      static_cast<void>(slant::contact::dirichlet_preconditioner(K, SparseMatrix<double>(3, 5))),
      slant::bad_input);
}

}  // namespace preconditioners_test
