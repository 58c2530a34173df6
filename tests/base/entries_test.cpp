// SPDX-License-Identifier: MIT
#include <slant/base/entries.hpp>
#include <slant/base/partitions.hpp>

#include <support/testing.hpp>

namespace entries_test {

namespace entries = slant::detail;

template <class M>
M some(double first) {
  M m;
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = first + double(i * i % 7);
  return m;
}

TEST_CASE_TEMPLATE("entries: what Eigen's expressions say", M, Eigen::Matrix<double, 1, 1>,
                   Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Matrix<double, 3, 2>,
                   Eigen::Matrix<double, 5, 4>) {
  constexpr int R = M::RowsAtCompileTime, C = M::ColsAtCompileTime;
  using column = Eigen::Matrix<double, R, 1>;
  using row = Eigen::Matrix<double, C, 1>;
  M const a = some<M>(-3), b = some<M>(2);
  column const x = some<column>(-1);
  row const y = some<row>(-2);
  auto const c = some<Eigen::Matrix<double, C, 3>>(-4);
  // small integers: every sum is exact
  CHECK(entries::from_entries<M>([&](int i, int j) { return a(i, j) + 1; }) == M(a.array() + 1));
  CHECK(entries::from_entries<column>([&](int i) { return 2 * x(i); }) == column(2 * x));
  CHECK(entries::sum_of<R>([&](int i) { return x(i); }) == x.sum());
  CHECK(entries::multiple_of(-2, a) == M(-2 * a));
  CHECK(entries::combination(2.0, a, -3.0, b) == M(2 * a - 3 * b));
  CHECK(entries::dot_of(x, column(b.col(0))) == x.dot(b.col(0)));
  CHECK(entries::largest_of(a) == a.cwiseAbs().maxCoeff());
  CHECK(entries::product_of(a, c) == Eigen::Matrix<double, R, 3>(a * c));
  CHECK(entries::product_of(a, y) == column(a * y));
  CHECK(entries::transposed_product(a, x) == row(a.transpose() * x));
  column sum = x;
  entries::add_product(a, y.data(), sum);
  CHECK(sum == column(x + a * y));
}

TEST_CASE("entries: parts of a long vector") {
  VectorXd x = VectorXd::LinSpaced(9, 1, 9);
  CHECK(entries::entries_at<3>(x.data() + 3) == Vector3d(4, 5, 6));
  entries::put_entries(Vector2d(-1, -2), x.data() + 7);
  CHECK(x.tail(3) == Vector3d(7, -1, -2));
  CHECK(entries::tail_of(Vector3d(1, 2, 3)) == Vector2d(2, 3));
  CHECK(entries::largest_of(x) == 7.0);
}

TEST_CASE("entries: zeros, infinities and NaN, in vectors of fixed and other size") {
  auto const check = [&](auto const& v, bool zero, bool finite, bool has_nan) {
    CHECK(entries::all_zero(v) == zero);
    CHECK(entries::all_finite(v) == finite);
    CHECK(entries::has_nan(v) == has_nan);
    VectorXd const dynamic = v;
    CHECK(entries::all_zero(dynamic) == zero);
    CHECK(entries::all_finite(dynamic) == finite);
    CHECK(entries::has_nan(dynamic) == has_nan);
  };
  check(Vector3d(0, -0.0, 0), true, true, false);
  check(Vector3d(0, 5e-324, 0), false, true, false);
  check(Vector2d(1, -infinity), false, false, false);
  check(Vector2d(quiet_nan, 0), false, false, true);
  check(Eigen::Matrix<double, 0, 1>(), true, true, false);
}

/// A chain of nodes of b unknowns each; all blocks of neighbours are full.
sparse chain(int nodes, int b) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes; ++i) {
    for (int j = std::max(0, i - 1); j < std::min(nodes, i + 2); ++j) {
      for (int a = 0; a < b; ++a)
        for (int c = 0; c < b; ++c) entries.emplace_back(b * i + a, b * j + c, 1.0);
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

}  // namespace entries_test
