// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fem/wire_prolongation.hpp>
#include <oracle/wire_reference.hpp>

namespace wire_prolongation_test {

TEST_CASE("between two points of a line, and beyond them") {
  auto const at = fem::interpolate<double>({0, 1, 3}, {-1, 0, 0.25, 1, 2, 3, 5});
  double const value[] = {10, 20, 60};
  double const expected[] = {0, 10, 12.5, 20, 40, 60, 100};
  for (std::size_t i = 0; i < at.size(); ++i)
    CHECK((1 - at[i].weight) * value[at[i].left] + at[i].weight * value[at[i].right] ==
          expected[i]);
  auto const constant = fem::interpolate<double>({2}, {1, 2, 3});
  for (auto const& place : constant) CHECK((place.left == 0 && place.weight == 0));
  CHECK_THROWS_WITH_AS((void)fem::interpolate<double>({0, 1, 1}, {0}),
                       "from: got 1, expected increasing points", std::invalid_argument);
  CHECK_THROWS_AS((void)fem::interpolate<double>({}, {0}), std::invalid_argument);
}

TEST_CASE("the wire: what is linear up to the ends of one element stays as it is") {
  // A tent over the node t of the coarse mesh, seen from any mesh: linear on both sides of it.
  for (Eigen::Index const m : {3, 4, 8}) {
    auto const coarse = fem::make_wire(2);
    auto const fine = fem::make_wire(m);
    double const top = coarse.t(1);
    auto const tent = [&](fem::wire<> const& w) {
      Eigen::VectorXd x(4 * w.m);
      for (Eigen::Index node = 0; node < 2 * w.m; ++node) {
        double const height = std::fmin(w.t(node) / top, (1 - w.t(node)) / (1 - top));
        x[w.unknown(node, 0)] = height;
        x[w.unknown(node, 1)] = -3 * height;
      }
      return x;
    };
    Eigen::VectorXd const x = fem::wire_prolongation(coarse, fine) * tent(coarse);
    CHECK((x - tent(fine)).cwiseAbs().maxCoeff() < 1e-15 * 16);
  }
}

TEST_CASE("the wire: the same as the naive interpolation") {
  auto const coarse = fem::make_wire<oracle::real>(8);
  oracle::real_vector x = oracle::real_vector::LinSpaced(32, -1, 2).array().square();
  for (Eigen::Index const m : {5, 16, 33}) {
    auto const fine = fem::make_wire<oracle::real>(m);
    oracle::real_vector const y = fem::wire_prolongation(coarse, fine) * x;
    CHECK((y - oracle::interpolate(coarse, x, fine)).cwiseAbs().maxCoeff() < 1e-17L);
  }
}

}  // namespace wire_prolongation_test
