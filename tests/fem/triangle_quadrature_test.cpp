// SPDX-License-Identifier: MIT
#include <fem/triangle_quadrature.hpp>
#include <support/testing.hpp>

namespace triangle_quadrature_test {

/// x^i y^j over the triangle (0,0), (1,0), (0,1): i! j! / (i + j + 2)!.
TEST_CASE("triangle rule: exact to degree 5 and not beyond") {
  auto const error = [](int i, int j) {
    double sum = 0;
    for (auto const& q : fem::triangle_points())
      sum += q.weight / 2 * std::pow(q.at[1], i) * std::pow(q.at[2], j);
    return std::abs(sum - std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3));
  };
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j) CHECK(error(i, j) < 1e-16);
  CHECK(error(6, 0) > 1e-6);
}

TEST_CASE("edge rule: exact to degree 5 and not beyond") {
  auto const error = [](int i) {
    double sum = 0;
    for (auto const& q : fem::edge_points()) sum += q.weight * std::pow(q.at, i);
    return std::abs(sum - 1.0 / (i + 1));
  };
  for (int i = 0; i <= 5; ++i) CHECK(error(i) < 1e-15);
  CHECK(error(6) > 1e-4);
}

}  // namespace triangle_quadrature_test
