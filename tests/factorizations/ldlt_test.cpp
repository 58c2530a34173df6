// SPDX-License-Identifier: MIT
#include <slant/factorizations/ldlt.hpp>
#include <slant/testing/archetypes.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <fem/brick_mesh.hpp>
#include <fem/elasticity.hpp>
#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace ldlt_test {

using multiprecision = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                                     boost::multiprecision::et_off>;

auto const factor = [](auto const& k) { return slant::ldlt(k); };

static_assert(slant::factorization<slant::ldlt<>, VectorXd>);
static_assert(slant::factorization<slant::ldlt<>, MatrixXd>);
static_assert(slant::factorization<slant::ldlt<>, slant::testing::archetype::vector>);
static_assert(!slant::factorization<slant::ldlt<>, Eigen::VectorXf>);
static_assert(slant::declares_positive_definite<slant::ldlt<>>);

TEST_CASE("solutions have small residuals, also for several right-hand sides") {
  sparse const k = test::grid_laplacian(6, 0.1);
  slant::ldlt const factors(k);
  CHECK(factors.rows() == k.rows());
  CHECK(factors.name() == "ldlt");
  CHECK(test::residual(factors, k) < 1e-14);
  MatrixXd b(k.rows(), 3);
  b << test::load(k.rows()), VectorXd::Ones(k.rows()), VectorXd::Unit(k.rows(), 7);
  MatrixXd x(k.rows(), 3);
  auto w = factors.workspace(b);
  factors.solve(b, x, w);
  CHECK((k * x - b).norm() < 1e-13 * b.norm());
}

TEST_CASE("right-hand sides stored by rows") {
  using by_rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  sparse const k = test::grid_laplacian(4, 0.1);
  slant::ldlt const factors(k);
  by_rows b(k.rows(), 3);
  b << test::load(k.rows()), VectorXd::Ones(k.rows()), VectorXd::Unit(k.rows(), 7);
  by_rows x(k.rows(), 3);
  auto w = factors.workspace(b);
  CHECK(test::allocations_of([&] { factors.solve(b, x, w); }) == 0);
  CHECK((k * x - b).norm() < 1e-13 * b.norm());
}

TEST_CASE_TEMPLATE("other scalars", S, float, multiprecision) {
  Eigen::SparseMatrix<S> const k = test::grid_laplacian<S>(3, 0.1);
  S const allowed = S(100) * std::numeric_limits<S>::epsilon();
  CHECK(test::residual(slant::ldlt(k), k) < allowed);
}

TEST_CASE("expressions and row-major matrices") {
  sparse const k = test::grid_laplacian(3, 0.1);
  CHECK(test::residual(slant::ldlt(k + k), sparse(2 * k)) < 1e-14);
  Eigen::SparseMatrix<double, Eigen::RowMajor> const by_rows(k);
  CHECK(test::residual(slant::ldlt(by_rows), k) < 1e-14);
}

TEST_CASE("sizes of a solve") {
  test::check_sizes_of_solve(slant::ldlt(test::grid_laplacian(3, 0.1)));
}

TEST_CASE("units do not matter") {
  test::check_units(factor, test::grid_laplacian(3, 0.1));
}

TEST_CASE("complaints name the entry or the pivot") {
  test::check_complaints(factor, test::grid_laplacian(4, 0.1), test::grid_laplacian(4, 0));
  sparse small(2, 2);
  small.insert(0, 0) = small.insert(1, 1) = 1;
  small.insert(0, 1) = small.insert(1, 0) = 3;
  CHECK(test::complaint(factor, small) ==
        "K: got pivot 1 (row 1) = -8, expected a symmetric positive definite matrix");
}

TEST_CASE("a soft body beside a stiff one is not singular") {
  sparse k(4, 4);
  k.insert(0, 0) = k.insert(1, 1) = 2e12;
  k.insert(0, 1) = k.insert(1, 0) = -1e12;
  k.insert(2, 2) = k.insert(3, 3) = 2e-12;
  k.insert(2, 3) = k.insert(3, 2) = -1e-12;
  CHECK(test::complaint(factor, k) == "nothing thrown");
}

TEST_CASE("a floating elastic body is refused") {
  for (int const k : {1, 2, 3, 4}) {
    auto const mesh = fem::make_brick_mesh(k);
    auto const all_free = fem::number_unknowns(mesh, [](auto) { return false; });
    sparse const stiffness = fem::stiffness(mesh, all_free, fem::lame(2.119e5, 0.277));
    CHECK(test::contains(test::complaint(factor, stiffness), "zero up to rounding"));
  }
}

TEST_CASE("asymmetry by rounding is accepted") {
  sparse k = test::grid_laplacian(3, 0.1);
  k.coeffRef(0, 1) *= 1 + 8 * std::numeric_limits<double>::epsilon();
  CHECK(test::complaint(factor, k) == "nothing thrown");
}

TEST_CASE("the empty matrix") {
  slant::ldlt const factors(sparse(0, 0));
  VectorXd x(0);
  slant::apply(slant::inverse(factors), VectorXd(0), x);
  CHECK(factors.rows() == 0);
}

TEST_CASE("copies share factors that outlive the original; a solve allocates nothing") {
  sparse const k = test::grid_laplacian(4, 0.1);
  auto const a = [&] {
    slant::ldlt original(k);
    auto copy = original;
    return slant::inverse(std::move(copy));
  }();
  VectorXd const b = test::load(k.rows());
  VectorXd x(k.rows());
  auto w = slant::workspace(a, b);
  CHECK(test::allocations_of([&] { slant::apply(a, b, x, w); }) == 0);
  CHECK((k * x - b).norm() < 1e-14 * b.norm());
}

}  // namespace ldlt_test
