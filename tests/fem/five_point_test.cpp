// SPDX-License-Identifier: MIT
#include <slant/concepts/capabilities.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <fem/five_point.hpp>
#include <fem/incomplete_five_point.hpp>
#include <oracle/naive_membrane.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>

namespace five_point_test {

using namespace test::evaluated;
using test::dense_of;
constexpr double ε = std::numeric_limits<double>::epsilon();

template <class S>
S weight(S const& x) {
  using std::cos;
  S const gap = S(1) + S(0.5) * cos(x);
  return S(gap * gap * gap);
}

fem::five_point<> some_operator(int nx, int ny) {
  return {fem::rectangle_grid<>{nx, ny, 6.2, 3}, weight<double>};
}

TEST_CASE("it keeps its word") {
  static_assert(slant::spd_operator<fem::five_point<>, VectorXd>);
  static_assert(slant::has_diagonal<fem::five_point<>, VectorXd>);
  static_assert(!slant::linear_operator<fem::five_point<float>, VectorXd>);
  slant::testing::check_operator_laws(some_operator(7, 5));
  slant::testing::check_operator_laws(some_operator(4, 3),
                                      slant::testing::archetype::vector(VectorXd()));
}

TEST_CASE("without a matrix the same as with one, and as the sum over the triangles") {
  for (auto const& [nx, ny] : {std::pair{6, 4}, {1, 5}, {5, 1}, {1, 1}}) {
    auto const a = some_operator(nx, ny);
    Eigen::SparseMatrix<double> const A = a.matrix();
    MatrixXd const naive =
        oracle::naive_stiffness(nx, ny, 6.2L, 3, weight<long double>).cast<double>();
    CHECK((MatrixXd(A) - naive).cwiseAbs().maxCoeff() <= 8 * ε * naive.maxCoeff());
    CHECK((MatrixXd(A) - MatrixXd(A).transpose()).isZero(0));

    VectorXd const x = VectorXd::LinSpaced(nx * ny, -1, 3).array().sin();
    VectorXd y(nx * ny), d(nx * ny);
    a.apply(x, y);
    a.diagonal(d);
    VectorXd const terms = A.cwiseAbs() * x.cwiseAbs();
    CHECK(((y - A * x).cwiseAbs() - 8 * ε * terms).maxCoeff() <= 0);
    CHECK((d - VectorXd(A.diagonal())).isZero(0));
  }
}

TEST_CASE("the bound of the spectrum holds where the weight varies, and is not far off") {
  auto const a = some_operator(8, 9);
  double const bound = a.largest_eigenvalue_bound();
  MatrixXd const A = a.matrix();
  CHECK((bound * MatrixXd::Identity(72, 72) - A).llt().info() == Eigen::Success);
  VectorXd zigzag(72);  // where the weight is large
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 9; ++j) zigzag[i + 8 * j] = i < 2 ? ((i + j) % 2 == 0 ? 1 : -1) : 0;
  CHECK(zigzag.dot(A * zigzag) > bound / 2 * zigzag.squaredNorm());
}

TEST_CASE("an application does not allocate") {
  auto const a = some_operator(6, 5);
  VectorXd const x = VectorXd::Ones(30);
  VectorXd y(30);
  CHECK(test::allocations_of([&] { a.apply(x, y); }) == 0);
}

TEST_CASE("what is no grid and what is no weight") {
  auto const one = [](double) { return 1.0; };
  using grid = fem::rectangle_grid<>;
  CHECK_THROWS_WITH_AS((void)fem::five_point<>(grid{0, 3, 1, 1}, one),
                       "nx: got 0, expected between 1 and 2^15 nodes", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::five_point<>(grid{3, -1, 1, 1}, one),
                       "ny: got -1, expected between 1 and 2^15 nodes", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::five_point<>(grid{3, 3, 1, 1}, [](double x) { return 0.5 - x; }),
                       "w: got 0, expected a positive finite weight", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::five_point<>(grid{3, 3, 0, 1}, one),
                       "width: got 0, expected a positive number", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::five_point<>(grid{3, 3, 1, INFINITY}, one),
                       "height: got inf, expected a positive number", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::five_point<>(grid{3, 3, 1, 1}, [](double) { return NAN; }),
                  std::invalid_argument);
}

fem::five_point<> other_operator(int nx, int ny) {
  return {fem::rectangle_grid<>{nx, ny, 3, 2}, [](double x) { return 1 + x * x; }};
}

TEST_CASE("the incomplete factor keeps its word") {
  static_assert(slant::spd_operator<fem::incomplete_five_point<>, VectorXd>);
  for (double τ : {0.0, 0.99, 1.0}) {
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(other_operator(6, 5), τ));
    slant::testing::check_operator_laws(fem::incomplete_five_point<>(other_operator(1, 1), τ));
  }
}

TEST_CASE("along a line nothing is dropped: it is the inverse") {
  for (auto const& a : {other_operator(7, 1), other_operator(1, 7)}) {
    MatrixXd const I = dense_of(fem::incomplete_five_point<>(a)) * a.matrix();
    CHECK(I.isIdentity(1e-12));
  }
}

TEST_CASE(
    "of A it keeps the entries and, for τ = 1, the sums of the rows; for τ = 0 the diagonal") {
  auto const a = other_operator(5, 4);
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
  auto const a = other_operator(6, 5);
  fem::incomplete_five_point<> const m(a);
  VectorXd const x = VectorXd::Ones(30);
  VectorXd y(30);
  CHECK(test::allocations_of([&] { m.apply(x, y); }) == 0);
  CHECK_THROWS_WITH_AS((void)fem::incomplete_five_point<>(a, 1.5),
                       "tau: got 1.5, expected a number in [0, 1]", std::invalid_argument);
}

}  // namespace five_point_test
