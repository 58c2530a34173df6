// SPDX-License-Identifier: MIT
#include <slant/factorizations/fill_estimate.hpp>

#include <fem/steel_brick.hpp>
#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace fill_estimate_test {

using sparse = Eigen::SparseMatrix<double>;

TEST_CASE("a full matrix fills completely: n(n + 1)/2 entries, n³/3 operations") {
  sparse const full = MatrixXd::Ones(24, 24).sparseView();
  auto const e = slant::estimate_fill(full);
  CHECK(e.entries == 24 * 25 / 2);
  CHECK(e.operations == doctest::Approx(24. * 24 * 24 / 3).epsilon(0.1));
  CHECK(e.complete);
}

TEST_CASE("the entries are those of Eigen's factor with the same kind of ordering") {
  sparse const K = fem::make_steel_brick({.k = 3}).K;
  Eigen::SimplicialLLT<sparse> const factor(K);
  auto const entries = double(sparse(factor.matrixL()).nonZeros());
  auto const e = slant::estimate_fill(K);
  // Nodes are ordered instead of unknowns: not the same, but as good.
  CHECK(e.entries >= 0.8 * entries);
  CHECK(e.entries <= 1.2 * entries);
}

TEST_CASE("counting stops where enough is known; nothing to factor, nothing to count") {
  sparse const K = fem::make_steel_brick({.k = 3}).K;
  double const all = slant::estimate_fill(K).operations;
  auto const e = slant::estimate_fill(K, all / 10);
  CHECK(!e.complete);
  CHECK(e.operations > all / 10);
  CHECK(e.operations < all);
  CHECK(slant::estimate_fill(sparse(0, 0)).operations == 0);
  CHECK_THROWS_WITH_AS((void)slant::estimate_fill(sparse(2, 3)),
                       "columns of K: got 3, expected rows of K, 2", slant::bad_input);
}

TEST_CASE("nodes of three unknowns become one vertex; the graph is that of the nodes") {
  sparse const nodes = test::grid_laplacian(3, 0.1);
  slant::detail::quotient_graph const quotient(test::blown_up(nodes, MatrixXd::Ones(3, 3)));
  REQUIRE(quotient.size() == 27);
  MatrixXd const expected = MatrixXd(nodes).unaryExpr([](double v) { return v != 0 ? 1.0 : 0.0; });
  CHECK(MatrixXd(quotient.graph()) == expected);

  std::vector<char> marked(81, 0);
  marked[7] = marked[80] = 1;
  auto const groups = quotient.groups(marked);
  for (std::size_t v = 0; v < 27; ++v) CHECK(int(groups[v]) == (v == 2 || v == 26 ? 1 : 0));

  std::vector<int> order(27);
  for (int v = 0; v < 27; ++v) order[std::size_t(v)] = 26 - v;
  auto const all = quotient.expanded(order);
  REQUIRE(all.size() == 81);
  for (std::size_t i = 0; i < 81; ++i) CHECK(all[i] == int(3 * (26 - i / 3) + i % 3));
}

TEST_CASE("unknowns that differ stay apart; room to insert does not matter; nothing at all") {
  sparse k = test::grid_laplacian(3, 0.1);
  CHECK(slant::detail::quotient_graph(k).size() == 27);
  k.reserve(Eigen::VectorXi::Constant(27, 20));
  CHECK_FALSE(k.isCompressed());
  CHECK(slant::detail::quotient_graph(k).size() == 27);
  CHECK(slant::detail::quotient_graph(sparse(0, 0)).size() == 0);
}

}  // namespace fill_estimate_test
