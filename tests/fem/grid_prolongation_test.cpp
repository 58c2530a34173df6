// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fem/grid_prolongation.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/testing/operator_laws.hpp>
#include <string>

namespace grid_prolongation_test {

using grid = fem::rectangle_grid<>;

TEST_CASE("as an operator it keeps its word, with the adjoint as restriction") {
  Eigen::SparseMatrix<double> const P = fem::grid_prolongation(grid{3, 2, 2, 5}, grid{8, 6, 2, 5});
  auto const prolongation = slant::matrix(P);
  static_assert(slant::has_adjoint<decltype(prolongation), Eigen::VectorXd>);
  slant::testing::check_operator_laws(prolongation);
}

TEST_CASE("the same grid: the identity") {
  grid const g{5, 3, 2, 1};
  CHECK(Eigen::MatrixXd(fem::grid_prolongation(g, g)).isIdentity(1e-15));
}

TEST_CASE("what is bilinear on the coarse cells stays as it is") {
  // A tent over a coarse node in each direction, seen from grids that share few nodes with it.
  grid const coarse{3, 4, 2, 10};
  auto const tent = [](double top, double end, double at) {
    return std::min(at / top, (end - at) / (end - top));
  };
  auto const f = [&](double x, double y) { return tent(1, 2, x) * tent(4, 10, y); };
  Eigen::VectorXd const from = fem::at_nodes(coarse, f);
  for (auto const& fine : {grid{4, 4, 2, 10}, {7, 9, 2, 10}, {2, 13, 2, 10}, {1, 1, 2, 10}}) {
    Eigen::VectorXd const to = fem::grid_prolongation(coarse, fine) * from;
    CHECK((to - fem::at_nodes(fine, f)).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("the same as the naive interpolation") {
  grid const coarse{4, 3, 3, 2};
  Eigen::VectorXd const v = Eigen::VectorXd::LinSpaced(12, -2, 5).array().sin();
  auto const value = [&](Eigen::Index i, Eigen::Index j) {
    bool const interior = i >= 0 && j >= 0 && i < 4 && j < 3;
    return interior ? v[coarse.unknown(i, j)] : 0.0;
  };
  grid const fine{11, 6, 3, 2};
  Eigen::VectorXd const to = fem::grid_prolongation(coarse, fine) * v;
  Eigen::VectorXd const naive = fem::at_nodes(fine, [&](double x, double y) {
    auto const i = static_cast<Eigen::Index>(std::floor(x / coarse.hx())) - 1;
    auto const j = static_cast<Eigen::Index>(std::floor(y / coarse.hy())) - 1;
    double const right = x / coarse.hx() - static_cast<double>(i + 1);
    double const up = y / coarse.hy() - static_cast<double>(j + 1);
    return (1 - up) * ((1 - right) * value(i, j) + right * value(i + 1, j)) +
           up * ((1 - right) * value(i, j + 1) + right * value(i + 1, j + 1));
  });
  CHECK((to - naive).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("what does not fit is refused") {
  auto const check = [](grid const& coarse, grid const& fine, char const* what) {
    CHECK_THROWS_WITH_AS((void)fem::grid_prolongation(coarse, fine), what, std::invalid_argument);
  };
  check({3, 3, 1, 1}, {3, 3, 2, 1}, "width: got 2, expected that of the coarse grid");
  check({3, 3, 1, 1}, {3, 3, 1, 3}, "height: got 3, expected that of the coarse grid");
  check({0, 3, 1, 1}, {3, 3, 1, 1}, "nx: got 0, expected between 1 and 2^15 nodes");
}

}  // namespace grid_prolongation_test
