// SPDX-License-Identifier: MIT
#include <fem/triangle_quadrature.hpp>
#include <support/testing.hpp>

namespace triangle_quadrature_test {

/// x^i y^j over the triangle (0,0), (1,0), (0,1): i! j! / (i + j + 2)!.
TEST_CASE("rules of triangles and edges: exact to degree 5") {
  auto const error = [](int i, int j) {
    double sum = 0;
    for (auto const& q : fem::triangle_points())
      sum += q.weight / 2 * std::pow(q.at[1], i) * std::pow(q.at[2], j);
    return std::abs(sum - std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3));
  };
  for (int i = 0; i <= 5; ++i) {
    for (int j = 0; i + j <= 5; ++j) CHECK(error(i, j) < 1e-16);
    double sum = 0;
    for (auto const& q : fem::edge_points()) sum += q.weight * std::pow(q.at, i);
    CHECK(std::abs(sum - 1.0 / (i + 1)) < 1e-15);
  }
}

}  // namespace triangle_quadrature_test
