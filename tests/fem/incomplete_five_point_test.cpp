// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fem/incomplete_five_point.hpp>
#include <slant/testing/laws.hpp>

#include "support/allocation_guard.hpp"

namespace incomplete_five_point_test {

fem::five_point<> some_operator(int nx, int ny) {
  return {fem::rectangle_grid<>{nx, ny, 3, 2}, [](double x) { return 1 + x * x; }};
}

Eigen::MatrixXd dense(fem::incomplete_five_point<> const& m) {
  Eigen::MatrixXd M(m.rows(), m.cols());
  Eigen::MatrixXd const identity = Eigen::MatrixXd::Identity(m.rows(), m.cols());
  m.apply(identity, M);
  return M;
}

TEST_CASE("it keeps its word") {
  static_assert(slant::spd_operator<fem::incomplete_five_point<>, Eigen::VectorXd>);
  for (double τ : {0.0, 0.99, 1.0}) {
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(some_operator(6, 5), τ));
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(some_operator(1, 1), τ));
  }
}

TEST_CASE("along a line nothing is dropped: it is the inverse") {
  for (auto const& a : {some_operator(7, 1), some_operator(1, 7)}) {
    Eigen::MatrixXd const I = dense(fem::incomplete_five_point<>(a)) * a.matrix();
    CHECK(I.isIdentity(1e-12));
  }
}

TEST_CASE(
    "of A it keeps the entries and, for τ = 1, the sums of the rows; for τ = 0 the diagonal") {
  auto const a = some_operator(5, 4);
  Eigen::MatrixXd const A = a.matrix();
  for (double τ : {0.0, 1.0}) {
    Eigen::MatrixXd const B =
        dense(fem::incomplete_five_point<>(a, τ)).llt().solve(Eigen::MatrixXd::Identity(20, 20));
    for (Eigen::Index i = 0; i < 20; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        if (A(i, j) != 0) CHECK(B(i, j) == doctest::Approx(A(i, j)).epsilon(1e-11));
    Eigen::VectorXd const sums = (B - A).rowwise().sum();
    Eigen::VectorXd const diagonal = (B - A).diagonal();
    double const size = A.diagonal().maxCoeff();
    CHECK((τ == 1 ? sums : diagonal).cwiseAbs().maxCoeff() < 1e-12 * size);
    CHECK((τ == 1 ? diagonal : sums).cwiseAbs().maxCoeff() > 1e-3 * size);
  }
}

TEST_CASE("the condition grows like 1/h") {
  auto const condition = [](int n) {
    fem::five_point<> const a(fem::rectangle_grid<>{n, n, 1, 1}, [](double) { return 1.0; });
    // Of L Lᵀ A, in a symmetric form.
    Eigen::MatrixXd const L = dense(fem::incomplete_five_point<>(a, 1)).llt().matrixL();
    Eigen::MatrixXd const B = L.transpose() * (a.matrix() * L);
    Eigen::VectorXd const λ = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(B).eigenvalues();
    return λ.maxCoeff() / λ.minCoeff();
  };
  double const coarse = condition(7);
  double const fine = condition(15);
  CHECK(fine / coarse > 1.5);
  CHECK(fine / coarse < 2.3);  // that of A: 4
  CHECK(fine < 10);            // that of A: 103
}

TEST_CASE("an application does not allocate; what is no factor τ") {
  auto const a = some_operator(6, 5);
  fem::incomplete_five_point<> const m(a);
  Eigen::VectorXd const x = Eigen::VectorXd::Ones(30);
  Eigen::VectorXd y(30);
  CHECK(test::allocations_of([&] { m.apply(x, y); }) == 0);
  CHECK_THROWS_WITH_AS((void)fem::incomplete_five_point<>(a, 1.5),
                       "tau: got 1.5, expected a number in [0, 1]", std::invalid_argument);
}

}  // namespace incomplete_five_point_test
