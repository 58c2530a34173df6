// SPDX-License-Identifier: MIT
#include <slant/base/partitions.hpp>

#include <support/testing.hpp>

namespace partitions_test {

using sparse = Eigen::SparseMatrix<double>;

/// A chain of nodes of b unknowns each; all blocks of neighbours are full.
sparse chain(int nodes, int b) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes; ++i) {
    for (int j = std::max(0, i - 1); j < std::min(nodes, i + 2); ++j) {
      for (int a = 0; a < b; ++a) {
        for (int c = 0; c < b; ++c) entries.emplace_back(b * i + a, b * j + c, 1.0);
      }
    }
  }
  sparse m(b * nodes, b * nodes);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

TEST_CASE("blocks are told by the pattern, in either storage order") {
  for (int const b : {1, 2, 3}) {
    sparse const m = chain(6, b);
    CHECK(slant::detected_block_size(m) == b);
    CHECK(slant::detected_block_size(Eigen::SparseMatrix<double, Eigen::RowMajor>(m)) == b);
  }
}

TEST_CASE("one entry less is no block, and an empty matrix has none") {
  sparse m = chain(6, 3);
  m.prune([](int row, int col, double) { return !(row == 4 && col == 1); });
  CHECK(slant::detected_block_size(m) == 1);
  CHECK(slant::detected_block_size(sparse(0, 0)) == 1);
}

TEST_CASE("every unknown has a node") {
  slant::node_blocks const nodes(6, 3);
  CHECK(nodes.count() == 2);
  CHECK(nodes.first == std::vector<int>{0, 3, 6});
  CHECK(slant::node_blocks(0, 3).count() == 0);
}

}  // namespace partitions_test
