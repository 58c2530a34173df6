// SPDX-License-Identifier: MIT
#include <slant/testing/laws.hpp>

#include <fem/incomplete_five_point.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace incomplete_five_point_test {

using namespace test::evaluated;
fem::five_point<> some_operator(int nx, int ny) {
  return {fem::rectangle_grid<>{nx, ny, 3, 2}, [](double x) { return 1 + x * x; }};
}

using test::dense_of;

TEST_CASE("it keeps its word") {
  static_assert(slant::spd_operator<fem::incomplete_five_point<>, VectorXd>);
  for (double τ : {0.0, 0.99, 1.0}) {
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(some_operator(6, 5), τ));
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(some_operator(1, 1), τ));
  }
}

TEST_CASE("along a line nothing is dropped: it is the inverse") {
  for (auto const& a : {some_operator(7, 1), some_operator(1, 7)}) {
    MatrixXd const I = dense_of(fem::incomplete_five_point<>(a)) * a.matrix();
    CHECK(I.isIdentity(1e-12));
  }
}

TEST_CASE(
    "of A it keeps the entries and, for τ = 1, the sums of the rows; for τ = 0 the diagonal") {
  auto const a = some_operator(5, 4);
  MatrixXd const A = a.matrix();
  for (double τ : {0.0, 1.0}) {
    MatrixXd const B =
        dense_of(fem::incomplete_five_point<>(a, τ)).llt().solve(MatrixXd::Identity(20, 20));
    for (Eigen::Index i = 0; i < 20; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        if (A(i, j) != 0) CHECK(B(i, j) == doctest::Approx(A(i, j)).epsilon(1e-11));
    VectorXd const sums = (B - A).rowwise().sum();
    VectorXd const diagonal = (B - A).diagonal();
    double const size = A.diagonal().maxCoeff();
    CHECK((τ == 1 ? sums : diagonal).cwiseAbs().maxCoeff() < 1e-12 * size);
    CHECK((τ == 1 ? diagonal : sums).cwiseAbs().maxCoeff() > 1e-3 * size);
  }
}

TEST_CASE("an application does not allocate; what is no factor τ") {
  auto const a = some_operator(6, 5);
  fem::incomplete_five_point<> const m(a);
  VectorXd const x = VectorXd::Ones(30);
  VectorXd y(30);
  CHECK(test::allocations_of([&] { m.apply(x, y); }) == 0);
  CHECK_THROWS_WITH_AS((void)fem::incomplete_five_point<>(a, 1.5),
                       "tau: got 1.5, expected a number in [0, 1]", std::invalid_argument);
}

}  // namespace incomplete_five_point_test
