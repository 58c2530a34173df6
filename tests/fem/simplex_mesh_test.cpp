// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/simplex_mesh.hpp>

namespace simplex_mesh_test {

TEST_CASE_TEMPLATE("gradients reproduce differences of the hat functions", dimension,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int D = dimension::value;
  Eigen::Matrix<double, D, D + 1> vertices = Eigen::Matrix<double, D, D + 1>::Zero();
  for (int a = 1; a <= D; ++a) vertices(a - 1, a) = a;
  vertices.row(0).array() += 0.25;
  vertices(D - 1, 1) = 0.5;
  auto const element = fem::make_p1_element<D>(vertices);
  // The hat function of vertex a is 1 there and 0 at the others.
  for (int a = 0; a <= D; ++a)
    for (int b = 0; b <= D; ++b)
      for (int c = 0; c <= D; ++c) {
        double const rise = element.gradients.col(a).dot(vertices.col(b) - vertices.col(c));
        CHECK(rise == doctest::Approx((a == b ? 1 : 0) - (a == c ? 1 : 0)));
      }
}

TEST_CASE("volumes are signed") {
  Eigen::Matrix<double, 3, 4> vertices;
  vertices << 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4;
  CHECK(fem::make_p1_element<3>(vertices).volume == doctest::Approx(4));
  vertices.col(1).swap(vertices.col(2));
  CHECK(fem::make_p1_element<3>(vertices).volume == doctest::Approx(-4));
  Eigen::Matrix<double, 2, 3> triangle;
  triangle << 0, 1, 0, 0, 0, 5;
  CHECK(fem::make_p1_element<2>(triangle).volume == doctest::Approx(2.5));
}

}  // namespace simplex_mesh_test
