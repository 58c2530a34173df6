// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/contact_ordering.hpp>

#include <support/testing.hpp>

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

}  // namespace contact_ordering_test
