// SPDX-License-Identifier: MIT
//
// The function of one's own that docs/sets.md shows.
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/sets/sets.hpp>
#include <slant/testing/laws.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace own_penalty_test {

struct spring {  // φ(x) = ½ k min(0, x)²: a support that presses and does not pull
  static constexpr int dimension = 1;
  double k = 1;
  using point = Eigen::Matrix<double, 1, 1>;

  point prox(double ρ, auto const& z) const { return point(z[0] < 0 ? z[0] / (1 + ρ * k) : z[0]); }
  double value(auto const& x) const { return k / 2 * std::pow(std::min(0.0, x[0]), 2); }
  double conjugate(auto const& v) const {
    return v[0] > 0 ? std::numeric_limits<double>::infinity() : v[0] * v[0] / (2 * k);
  }
  point slant(double ρ, auto const& z) const { return point(z[0] < 0 ? 1 / (1 + ρ * k) : 1); }
  slant::block_state state(double, auto const& z) const {
    return z[0] < 0 ? slant::block_state::sliding : slant::block_state::free;
  }
};
static_assert(slant::proximable<spring, spring::point>);

TEST_CASE("my function keeps its word") {
  slant::testing::check_function_laws(spring{2.5});
}

TEST_CASE("two springs and a point with friction") {
  Eigen::Matrix3d const K{{4, -1, 0}, {-1, 4, -1}, {0, -1, 4}};
  Eigen::VectorXd const b = Eigen::Vector3d(-4, 2, -1), w = Eigen::VectorXd::Constant(1, 0.25);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  auto const φ =
      slant::separable_sum(slant::power(spring{3}, 2), slant::support(slant::intervals(w)));
  auto const program = slant::minimise(slant::quadratic(A, b) + φ);
  auto const run =
      slant::solve(slant::symmetric_newton{program}, Eigen::VectorXd(Eigen::VectorXd::Zero(3)),
                   slant::reduced_gradient_below(1e-12) || slant::at_most(50));
  REQUIRE(run.converged());
  Eigen::VectorXd const force = b - K * run.x();  // of φ: 3 min(0, x) twice, w sign(x)
  CHECK(force[0] == doctest::Approx(3 * std::min(0.0, run.x()[0])));
  CHECK(std::abs(force[1]) <= 1e-10);
  CHECK(force[2] == doctest::Approx(-w[0]));
  CHECK(run.x()[0] < 0);
  CHECK(run.x()[1] > 0);
  CHECK(run.x()[2] < 0);
}

}  // namespace own_penalty_test
