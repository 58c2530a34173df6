// SPDX-License-Identifier: MIT
#include "slanting_support.hpp"

#include <slant/slanting/pairs.hpp>
#include <slant/slanting/selection.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <vector>

namespace selection_test {

using Eigen::VectorXd;

TEST_CASE("some coordinates, in the order asked for") {
  auto const f = slant::selection(4, {2, 0});
  VectorXd const y{{1.0, -2.0, 3.0, 4.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{3.0, 1.0}});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2, 4);
  expected(0, 2) = expected(1, 0) = 1;
  CHECK(slanting_support::dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y, slant::testing::archetype::vector(y));
}

TEST_CASE("some rows of a function") {
  std::vector<int> const rows{1, 2};
  auto const f = slant::select(slant::positive_part(3), rows);
  VectorXd const y{{1.0, -2.0, 3.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{0.0, 3.0}});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2, 3);
  expected(1, 2) = 1;
  CHECK(slanting_support::dense_slant(f, y) == expected);
  CHECK(slant::evaluate(slant::select(slant::positive_part(3), {2}), y) ==
        VectorXd::Constant(1, 3));
}

TEST_CASE("bad input") {
  CHECK_THROWS_AS(static_cast<void>(slant::selection(3, {0, 3})), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::selection(3, {1, 1})), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::select(slant::positive_part(3), {-1})),
                  slant::bad_input);
}

}  // namespace selection_test
