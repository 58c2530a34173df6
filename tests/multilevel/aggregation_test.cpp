// SPDX-License-Identifier: MIT
#include "grids.hpp"

#include <slant/multilevel/aggregation.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace aggregation_test {

using test::laplacian;

std::vector<int> sizes_of(slant::aggregation const& a) {
  std::vector<int> sizes(static_cast<std::size_t>(a.count), 0);
  for (int const i : a.of) ++sizes[static_cast<std::size_t>(i)];
  return sizes;
}

TEST_CASE("every node is in one aggregate, and none is empty") {
  auto const a = slant::aggregate(laplacian(9, 7), slant::node_blocks(63, 1), 0.1);
  REQUIRE(a.of.size() == 63);
  auto const sizes = sizes_of(a);
  CHECK(std::ranges::all_of(a.of, [&](int i) { return i >= 0 && i < a.count; }));
  CHECK(*std::ranges::min_element(sizes) >= 2);
  CHECK(a.count <= 63 / 3);
}

TEST_CASE("weak couplings do not join: aggregates lie along the strong direction") {
  // Across columns of the grid the coupling is 1e-4 of that along them.
  auto const a = slant::aggregate(laplacian(8, 6, 1e-4), slant::node_blocks(48, 1), 0.1);
  for (int column = 0; column < 6; ++column) {
    for (int other = 0; other < column; ++other) {
      for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) {
          CHECK(a.of[static_cast<std::size_t>(8 * column + i)] !=
                a.of[static_cast<std::size_t>(8 * other + j)]);
        }
      }
    }
  }
}

TEST_CASE("unknowns of a node stay together; nodes without neighbours stay alone") {
  Eigen::SparseMatrix<double> I(12, 12);
  I.setIdentity();
  auto const alone = slant::aggregate(I, slant::node_blocks(12, 3), 0.1);
  CHECK(alone.count == 4);
  CHECK(alone.of == std::vector<int>{0, 1, 2, 3});
  CHECK(slant::aggregate(Eigen::SparseMatrix<double>(0, 0), slant::node_blocks(0, 1), 0.1).count ==
        0);
}

}  // namespace aggregation_test
