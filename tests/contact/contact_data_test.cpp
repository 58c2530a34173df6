// SPDX-License-Identifier: MIT
#include <slant/contact/contact_data.hpp>
#include <slant/contact/node_layout.hpp>

#include <support/testing.hpp>
#include "scenes.hpp"

namespace contact_data_test {

using slant::index;

slant::contact::data<double> good() {
  return test::contact_data(fem::make_steel_brick({.k = 1}));
}

/// What validate says of the data after a change.
template <class Change>
std::string complaint(Change change) {
  auto c = good();
  change(c);
  return SLANT_COMPLAINT(c.validate());
}

TEST_CASE("data of a scene are valid, and so are infinite gaps and slip bounds") {
  CHECK(complaint([](auto&) {}) == "nothing thrown");
  CHECK(complaint([](auto& c) { c.d(0) = infinity; }) == "nothing thrown");
  CHECK(complaint([](auto& c) { c.d(0) = -1; }) ==
        "nothing thrown");  // pressed in from the beginning
  CHECK(complaint([](auto& c) { c.g(0) = infinity; }) == "nothing thrown");
  CHECK(complaint([](auto& c) { c.g(0) = 0; }) == "nothing thrown");
  CHECK(good().nodes() == 6);
  CHECK(good().tangents() == 2);
  CHECK(test::frictionless_data(fem::make_steel_brick({.k = 1})).tangents() == 0);
}

TEST_CASE("each number that is none is named") {
  CHECK(complaint([](auto& c) { c.f(3) = std::nan(""); }) ==
        "f[3]: got nan, expected a finite number");
  CHECK(complaint([](auto& c) { c.d(1) = std::nan(""); }) ==
        "d[1]: got nan, expected a number or +inf");
  CHECK(complaint([](auto& c) { c.d(1) = -infinity; }) ==
        "d[1]: got -inf, expected a number or +inf");
  CHECK(complaint([](auto& c) { c.g(4) = -0.5; }) ==
        "g[4]: got -0.5, expected a number >= 0 or +inf");
  CHECK(complaint([](auto& c) { c.g(4) = std::nan(""); }) ==
        "g[4]: got nan, expected a number >= 0 or +inf");
  CHECK(complaint([](auto& c) { c.N.valuePtr()[0] = infinity; }).starts_with("N("));
  CHECK(complaint([](auto& c) { c.T.valuePtr()[0] = std::nan(""); }).starts_with("T("));
}

TEST_CASE("a row of N that moves nothing cannot open a gap") {
  auto const erase_row_2 = [](auto& c) {
    c.N.prune([](auto row, auto, double) { return row != 2; });
  };
  CHECK(complaint([&](auto& c) {
          erase_row_2(c);
          c.d(2) = -0.5;
        }) ==
        "d[2]: got -0.5, expected a number >= 0, since row 2 of N is zero: no displacement opens "
        "this gap");
  CHECK(complaint([&](auto& c) {
          for (int k = 0; k < c.N.nonZeros(); ++k) c.N.valuePtr()[k] = 0;  // stored zeros
          c.d(3) = -1;
        }).starts_with("d[3]: got -1"));
  CHECK(complaint([&](auto& c) {
          erase_row_2(c);
          c.d(2) = 0;
        }) == "nothing thrown");
}

TEST_CASE("each size that does not fit is named") {
  CHECK(complaint([](auto& c) { c.f.conservativeResize(5); }).starts_with("columns of N"));
  CHECK(complaint([](auto& c) { c.d.conservativeResize(5); }).starts_with("d: got 5"));
  CHECK(complaint([](auto& c) { c.g.conservativeResize(5); }).starts_with("g: got 5"));
  CHECK(complaint([](auto& c) { c.g.resize(0); }).starts_with("g: got 0"));
  CHECK(complaint([](auto& c) { c.N.resize(0, c.N.cols()); }).starts_with("N: got 0"));
  CHECK(complaint([](auto& c) { c.T.resize(7, c.N.cols()); }).starts_with("rows of T: got 7"));
  CHECK(complaint([](auto& c) { c.T.resize(12, 3); }).starts_with("columns of T"));
  CHECK(complaint([](auto& c) { c.T.resize(0, c.N.cols()); }).starts_with("g: got 6"));
}

TEST_CASE("the unknowns of N and T, each once, in order") {
  contact::data<double> c;
  c.N.resize(2, 6);
  c.N.insert(0, 4) = 1;
  c.N.insert(1, 1) = -1;
  c.N.insert(1, 5) = 0;  // an entry that is there and acts on nothing
  c.T.resize(2, 6);
  c.T.insert(0, 4) = 1;
  c.T.insert(1, 2) = 3;
  c.f.setZero(6);
  c.d.setZero(2);
  c.g.setOnes(2);
  CHECK(contact::contact_unknowns(c) == std::vector<index>{1, 2, 4});
  c.g[0] = -1;
  CHECK_THROWS_AS((void)contact::contact_unknowns(c), slant::bad_input);
}

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
    return SLANT_COMPLAINT(layout.validate(6));
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
  CHECK(SLANT_COMPLAINT(layout_of(x, Eigen::VectorXi{{0, 1, 3}})) ==
        "first[1]: got 1, expected unknowns of its own");
  // An unknown between those of two nodes that belongs to none.
  CHECK(SLANT_COMPLAINT(layout_of(x, Eigen::VectorXi{{0, -1, 3}})) ==
        "node[2]: got -1, expected a column of x");
}

}  // namespace contact_data_test
