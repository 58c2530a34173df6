// SPDX-License-Identifier: MIT
#include <slant/factorizations/detail/tail_inverse.hpp>

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <algorithm>
#include <numeric>
#include <vector>

#include "factorizations/tail_factor.hpp"

namespace tail_inverse_test {

using Eigen::MatrixXd;
using slant::index;

TEST_CASE("rows and columns of the dense inverse, whichever unknowns are asked for") {
  test::tail_factor const f;
  MatrixXd const inverse = f.solved(MatrixXd::Identity(44, 44));
  std::vector<int> all(44);
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> const choices{all, {0}, {43}, {5, 6, 7, 20}, {0, 9, 13, 31, 32, 43},
                                              {}};
  for (auto const& unknowns : choices) {
    auto const part = slant::detail::tail_inverse(f.columns(), unknowns);
    REQUIRE(part->size() == index(unknowns.size()));
    for (index j = 0; j < part->size(); ++j) {
      for (index i = j; i < part->size(); ++i) {
        double const exact = inverse(unknowns[std::size_t(i)], unknowns[std::size_t(j)]);
        CHECK((*part)(i, j) == doctest::Approx(exact).epsilon(1e-13).scale(inverse.norm()));
      }
    }
  }
}

}  // namespace tail_inverse_test
