// SPDX-License-Identifier: MIT
#include <fem/brick_mesh.hpp>
#include <fem/simplex_mesh.hpp>
#include <map>
#include <set>
#include <support/testing.hpp>

namespace box_mesh_test {

template <int D>
double volume_of(fem::simplex_mesh<D> const& mesh) {
  double volume = 0;
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell)
    volume += fem::element_of<D>(mesh, cell).volume;
  return volume;
}

// How many cells have each facet, a facet being the set of its nodes.
template <int D>
std::map<std::set<int>, int> facets_of(fem::simplex_mesh<D> const& mesh) {
  std::map<std::set<int>, int> facets;
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell)
    for (int opposite = 0; opposite <= D; ++opposite) {
      std::set<int> facet;
      for (int a = 0; a <= D; ++a)
        if (a != opposite) facet.insert(mesh.cells(a, cell));
      ++facets[facet];
    }
  return facets;
}

TEST_CASE("a brick of 3k x k x k cells has the published numbers of nodes and tetrahedra") {
  for (int const k : {1, 2, 4}) {
    auto const mesh = fem::make_brick_mesh(k);
    CHECK(mesh.node_count() == (3 * k + 1) * (k + 1) * (k + 1));
    CHECK(mesh.cell_count() == 6 * 3 * k * k * k);
    CHECK(mesh.nodes_on(fem::brick_side::bottom).size() == (3 * k + 1) * (k + 1));
    CHECK(mesh.nodes_on(fem::brick_side::left).size() == (k + 1) * (k + 1));
  }
}

TEST_CASE("all cells are positively oriented and fill the box") {
  auto const brick = fem::make_brick_mesh(2, {2.5, 0.75, 1.25});
  for (Eigen::Index cell = 0; cell < brick.cell_count(); ++cell)
    CHECK(fem::element_of<3>(brick, cell).volume > 0);
  CHECK(volume_of<3>(brick) == doctest::Approx(2.5 * 0.75 * 1.25).epsilon(1e-14));
  auto const plate = fem::make_box_mesh<2>({5, 3}, {2, 1}, {-1, 4});
  for (Eigen::Index cell = 0; cell < plate.cell_count(); ++cell)
    CHECK(fem::element_of<2>(plate, cell).volume > 0);
  CHECK(volume_of<2>(plate) == doctest::Approx(2).epsilon(1e-14));
  CHECK(plate.nodes.rowwise().minCoeff() == Vector2d(-1, 4));
  CHECK(plate.nodes.rowwise().maxCoeff() == Vector2d(1, 5));
}

TEST_CASE("neighbours fit: inner facets belong to two cells, those of the sides to one") {
  auto const brick = fem::make_brick_mesh(2);
  int on_sides = 0;
  for (auto const& [facet, cells] : facets_of<3>(brick)) {
    bool on_a_side = false;
    for (fem::box_side const side :
         {fem::brick_side::left, fem::brick_side::right, fem::brick_side::front,
          fem::brick_side::back, fem::brick_side::bottom, fem::brick_side::top}) {
      bool all = true;
      for (int const node : facet) all = all && brick.on(side, node);
      on_a_side = on_a_side || all;
    }
    CHECK(cells == (on_a_side ? 1 : 2));
    on_sides += on_a_side ? 1 : 0;
  }
  CHECK(on_sides == 2 * 2 * (6 * 2 + 6 * 2 + 2 * 2));  // two triangles per square of the sides
  for (auto const& [facet, cells] : facets_of<2>(fem::make_box_mesh<2>({3, 2}, {1, 1})))
    CHECK(cells <= 2);
}

TEST_CASE("impossible boxes are refused by name") {
  CHECK_THROWS_WITH_AS((void)fem::make_box_mesh<2>({3, 0}, {1, 1}),
                       "cells_along: got 0, expected at least one cell", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)fem::make_box_mesh<2>({3, 1}, {1, -2}),
                       "size: got -2, expected a positive finite length", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_box_mesh<2>({3, 1}, {1, std::nan("")}), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_box_mesh<2>({1, 1}, {1, 1}, {INFINITY, 0}),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_box_mesh<3>({100000, 100000, 10}, {1, 1, 1}),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_brick_mesh(0), std::invalid_argument);
}

}  // namespace box_mesh_test
