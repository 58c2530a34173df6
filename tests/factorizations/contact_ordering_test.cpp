// SPDX-License-Identifier: MIT
#include <slant/factorizations/fill_estimate.hpp>
#include <slant/factorizations/parts/contact_ordering.hpp>

#include <fem/steel_brick.hpp>
#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"

namespace contact_ordering_test {

using ranges = std::vector<std::pair<int, int>>;
using slant::detail::separator_tree;

// Two chains of four, a separator of three above them:  0-1-2-3 ┐
//                                                       4-5-6-7 ┴ 8-9-10
std::vector<int> const halves{1, 2, 3, 8, 5, 6, 7, 8, 9, 10, -1};

TEST_CASE("subtrees below the topmost separators") {
  separator_tree const tree(halves);
  CHECK(tree.subtrees(0) == ranges{{0, 10}});
  CHECK(tree.subtrees(1) == ranges{{0, 3}, {4, 7}});
  CHECK(tree.subtrees(2).empty());
  CHECK(tree.subtrees(1000).empty());
}

TEST_CASE("columns that hang on a separator are no half of the body") {
  // 0 … 19 is a chain, 20 a leaf on its own, 21 their parent.
  std::vector<int> parent;
  for (int j = 0; j < 19; ++j) parent.push_back(j + 1);
  parent.insert(parent.end(), {21, 21, -1});
  separator_tree const tree(parent);
  CHECK(tree.subtrees(1).empty());  // it never really branches
}

TEST_CASE("forests: every tree is a part") {
  separator_tree const tree({1, -1, 3, -1});
  CHECK(tree.subtrees(0) == ranges{{0, 1}, {2, 3}});
  CHECK(separator_tree({}).subtrees(0).empty());
}

TEST_CASE("marked unknowns go behind the others of their subtree, and nothing else moves") {
  std::vector<int> const order{10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  std::vector<char> marked(11, 0);
  marked[9] = marked[6] = marked[1] = 1;
  separator_tree const tree(halves);
  CHECK(slant::detail::postponed(order, marked, tree.subtrees(1)) ==
        std::vector<int>{10, 8, 7, 9, 5, 4, 3, 6, 2, 1, 0});
  CHECK(slant::detail::postponed(order, marked, tree.subtrees(0)) ==
        std::vector<int>{10, 8, 7, 5, 4, 3, 2, 0, 9, 6, 1});
  CHECK(slant::detail::postponed(order, marked, {}) == order);
}

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

}  // namespace contact_ordering_test
