// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/tail.hpp>

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <cmath>
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

TEST_CASE("rounded to floats, definite matrices that are well-conditioned but for units stay so") {
  // S⁻¹ with ones on the diagonal and c beside it, in the unit scale^i: 1/(1 − c) is its condition.
  auto const verdict = [](double c, double scale) {
    slant::detail::packed_symmetric<double> inverse(6);
    std::vector<double> stiffness;
    for (int j = 0; j < 6; ++j) {
      double const unit = std::pow(scale, j);
      stiffness.push_back(1 / ((1 - c) * unit * unit));  // (S)_ii is less
      for (int i = j; i < 6; ++i) {
        inverse.set(i, j, (i == j ? 1 : c) * unit * std::pow(scale, i));
      }
    }
    return slant::detail::stays_definite<float>(inverse, stiffness);
  };
  for (double const scale : {1.0, 1e-3, 1e3}) {
    CHECK(verdict(0, scale));
    CHECK(verdict(0.9, scale));
    CHECK(verdict(1 - 1e-5, scale));
    CHECK(!verdict(1 - 1e-8, scale));
    CHECK(!verdict(1 - 1e-12, scale));
  }
  CHECK(!verdict(0, 1e6));  // up to 1e60, which floats do not hold
}

}  // namespace tail_inverse_test
