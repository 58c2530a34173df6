// SPDX-License-Identifier: MIT
#include <fem/string_1d.hpp>
#include <numbers>
#include <set>
#include <support/testing.hpp>

namespace string_1d_test {

constexpr double π = std::numbers::pi;

VectorXd solve(fem::wire<double> const& wire) {
  return MatrixXd(wire.A).llt().solve(wire.b);
}

TEST_CASE("the order of the unknowns: bounds, consecutive pairs, free ones") {
  auto const wire = fem::make_wire(5);
  std::set<Eigen::Index> all;
  for (Eigen::Index node = 0; node < 10; ++node)
    for (int component = 0; component < 2; ++component) all.insert(wire.unknown(node, component));
  CHECK(all.size() == 20);
  CHECK(*all.begin() == 0);
  CHECK(*all.rbegin() == 19);
  for (Eigen::Index node = 0; node < 5; ++node) {
    CHECK(wire.unknown(node, 1) == node);
    CHECK(wire.unknown(node, 0) == 15 + node);
    CHECK(wire.unknown(5 + node, 0) == 5 + 2 * node);
    CHECK(wire.unknown(5 + node, 1) == 6 + 2 * node);
  }
  CHECK(wire.t(4) < 0.5);
  CHECK(wire.t(5) > 0.5);
}

// sin(jπt) on the nodes is an eigenvector of tridiag(−1, 2, −1) to the eigenvalue 4 sin²(jπh/2), so
// without constraints the discrete solution is known in closed form.
TEST_CASE("the free wire has the closed form of its difference equation") {
  for (Eigen::Index const m : {1, 2, 7, 20}) {
    auto const wire = fem::make_wire(m);
    auto const y = wire.shape(solve(wire));
    double const h = wire.h();
    auto const amplitude = [&](int j) {
      return std::pow(j * π * h / (2 * std::sin(j * π * h / 2)), 2);
    };
    for (Eigen::Index node = 0; node < 2 * m; ++node) {
      CHECK(std::abs(y(node, 0) - amplitude(6) * std::sin(6 * π * wire.t(node))) <
            1e-12 * amplitude(6));
      CHECK(std::abs(y(node, 1) + amplitude(2) * std::sin(2 * π * wire.t(node))) <
            1e-12 * amplitude(2));
    }
  }
}

TEST_CASE("the energy is that of the piecewise linear wire") {
  auto const wire = fem::make_wire(4);
  VectorXd const x = VectorXd::LinSpaced(16, -1, 2).array().sin();
  MatrixXd y = MatrixXd::Zero(10, 2);  // with the fixed ends
  y.middleRows(1, 8) = wire.shape(x);
  double const energy = (y.bottomRows(9) - y.topRows(9)).squaredNorm() / wire.h();
  CHECK(x.dot(wire.A * x) == doctest::Approx(energy).epsilon(1e-13));
  CHECK((MatrixXd(wire.A) - MatrixXd(wire.A).transpose()).isZero(0));
}

TEST_CASE("a wire without nodes is refused") {
  CHECK_THROWS_AS((void)fem::make_wire(0), std::invalid_argument);
  CHECK_THROWS_AS((void)fem::make_wire(-3), std::invalid_argument);
}

}  // namespace string_1d_test
