// SPDX-License-Identifier: MIT
#include <slant/contact/node_layout.hpp>
#include <support/testing.hpp>

namespace node_layout_test {

using slant::contact::interleaved_layout;
using slant::contact::layout_of;
using slant::contact::node_layout;

MatrixXd const x{{0, 1, 2}, {0, 0, 5}};

TEST_CASE("places of unknowns: none known, all nodes free, some held") {
  CHECK_FALSE(node_layout<>{}.is_known());
  CHECK(node_layout<>{}.dimension() == 0);
  node_layout<>{}.validate(7);
  auto const all = interleaved_layout(x);
  all.validate(6);
  CHECK(all.dimension() == 2);
  CHECK(all.node == std::vector<slant::index>{0, 0, 1, 1, 2, 2});
  CHECK(all.axis == std::vector<int>{0, 1, 0, 1, 0, 1});
  auto const some = layout_of(x, Eigen::VectorXi{{2, -1, 0}});
  some.validate(4);
  CHECK(some.node == std::vector<slant::index>{2, 2, 0, 0});
  CHECK(some.axis == std::vector<int>{0, 1, 0, 1});
}

TEST_CASE("layouts that do not fit") {
  auto const refused = [](auto change) {
    auto layout = interleaved_layout(x);
    change(layout);
    return test::complaint([&] { layout.validate(6); });
  };
  CHECK(refused([](auto& l) { l.axis[3] = 2; }) == "axis[3]: got 2, expected a row of x");
  CHECK(refused([](auto& l) { l.node[1] = 3; }) == "node[1]: got 3, expected a column of x");
  CHECK(refused([](auto& l) { l.node.pop_back(); }) ==
        "node: got 5, expected one entry per unknown, 6");
  CHECK(refused([](auto& l) { l.x.conservativeResize(1, 3); }) ==
        "rows of x: got 1, expected 2 or 3 coordinates");
  CHECK(refused([](auto& l) { l.x(0, 1) = std::numeric_limits<double>::infinity(); }) ==
        "x(0, 1): got inf, expected a finite number");
  CHECK(SLANT_COMPLAINT(layout_of(x, Eigen::VectorXi{{0, 2}})) ==
        "first: got 2, expected the number of nodes, 3");
  // An unknown between those of two nodes that belongs to none.
  CHECK(SLANT_COMPLAINT(layout_of(x, Eigen::VectorXi{{0, -1, 3}})) ==
        "node[2]: got -1, expected a column of x");
}

}  // namespace node_layout_test
