// SPDX-License-Identifier: MIT
#include <fem/wall_nodes.hpp>
#include <numbers>
#include <support/testing.hpp>

namespace wall_nodes_test {

/// A ring around the circle of radius r, one layer of triangles thick; part 0 is inside.
fem::planar_domain ring(int n, double r) {
  fem::planar_domain domain;
  domain.mesh.nodes.resize(2, 2 * n);
  domain.mesh.cells.resize(3, 2 * n);
  for (int i = 0; i < n; ++i) {
    double const angle = 2 * std::numbers::pi * i / n;
    domain.mesh.nodes.col(i) = r * Vector2d(std::cos(angle), std::sin(angle));
    domain.mesh.nodes.col(n + i) = 2 * domain.mesh.nodes.col(i);
    int const next = (i + 1) % n;
    domain.mesh.cells.col(2 * i) = Eigen::Vector3i(i, n + i, n + next);
    domain.mesh.cells.col(2 * i + 1) = Eigen::Vector3i(i, n + next, next);
  }
  domain.boundary = fem::boundary_of(domain.mesh);
  domain.parts = {"inside", "outside"};
  for (auto& edge : domain.boundary) edge.part = edge.from < n ? 0 : 1;
  return domain;
}

TEST_CASE("nodes of a circle have its normals, tangents around it and equal weights") {
  int const n = 24;
  auto const domain = ring(n, 0.05);
  CHECK(domain.boundary.size() == 2 * n);
  auto const wall = fem::wall_nodes(domain, domain.part("inside"), [](int) { return true; });
  REQUIRE(wall.size() == n);
  double const edge = 2 * 0.05 * std::sin(std::numbers::pi / n);
  for (auto const& at : wall) {
    Vector2d const x = domain.mesh.nodes.col(at.node) / 0.05;
    CHECK((at.normal + x).norm() < 1e-14);  // out of the ring: towards the centre
    CHECK((at.tangent - Vector2d(x[1], -x[0])).norm() < 1e-14);
    CHECK(at.weight == doctest::Approx(edge).epsilon(1e-13));
  }
  auto const outside = fem::wall_nodes(domain, 1, [&](int node) { return node != n; });
  CHECK(outside.size() == n - 1);
  for (auto const& at : outside)
    CHECK((at.normal - domain.mesh.nodes.col(at.node) / 0.1).norm() < 1e-14);
}

TEST_CASE("sliding along all tangents, nothing flows through an uneven wall") {
  auto domain = fem::make_rectangle({7, 2}, {1, 1});
  for (Eigen::Index i = 0; i < domain.mesh.node_count(); ++i) {
    double const x = domain.mesh.nodes(0, i);
    domain.mesh.nodes(0, i) = x * (0.5 + 0.5 * x);  // edges of different lengths
    domain.mesh.nodes(1, i) -= 0.3 * std::sin(3 * x);
  }
  auto const wall = fem::wall_nodes(domain, domain.part("bottom"), [](int) { return true; });
  REQUIRE(wall.size() == 8);
  double flow = 0;
  double weights = 0;
  double length = 0;
  Eigen::Matrix2Xd u = Eigen::Matrix2Xd::Zero(2, domain.mesh.node_count());
  for (std::size_t i = 0; i < wall.size(); ++i) {
    u.col(wall[i].node) = std::cos(static_cast<double>(i)) * wall[i].tangent;
    weights += wall[i].weight;
  }
  for (auto const& edge : domain.boundary) {
    if (edge.part != domain.part("bottom")) continue;
    flow += domain.outward(edge).dot(u.col(edge.from) + u.col(edge.to)) / 2;
    length += domain.along(edge).norm();
    CHECK(domain.outward(edge)[1] < 0);
  }
  CHECK(std::abs(flow) < 1e-15);
  CHECK(weights == doctest::Approx(length).epsilon(1e-14));
}

TEST_CASE("parts of a rectangle, and of nothing else") {
  auto const domain = fem::make_rectangle({3, 2}, {3, 1});
  CHECK(domain.boundary.size() == 10);
  double length = 0;
  for (auto const& edge : domain.boundary) {
    length += domain.along(edge).norm();
    Vector2d const n = domain.outward(edge).normalized();
    Vector2d const expected =
        std::array<Vector2d, 4>{Vector2d(-1, 0), Vector2d(1, 0), Vector2d(0, -1),
                                Vector2d(0, 1)}[static_cast<std::size_t>(edge.part)];
    CHECK((n - expected).norm() < 1e-15);
  }
  CHECK(length == doctest::Approx(8));
  CHECK_THROWS_WITH_AS(static_cast<void>(domain.part("inside")),
                       "part of the boundary: got inside, expected a name that the mesh has",
                       std::invalid_argument);
}

TEST_CASE("triangles that do not fit together are refused") {
  auto domain = fem::make_rectangle({1, 1}, {1, 1});
  domain.mesh.cells.col(1) = domain.mesh.cells.col(0);
  CHECK_THROWS_AS(static_cast<void>(fem::boundary_of(domain.mesh)), std::invalid_argument);
}

}  // namespace wall_nodes_test
