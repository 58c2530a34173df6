// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/slanting/inequalities.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace inequalities_test {

using slanting_support::dense_slant;
using slanting_support::random_vector;

/// Discs of pairs (i, i + 3), a free unknown, cones with two inequalities and a full Hessian,
/// bounds.
auto mixed_set() {
  return slant::cartesian(slant::discs<slant::planar>(VectorXd{{1.0, 2.0, 0.5}}),
                          slant::free_components(1),
                          slant::power(slant::second_order_cone<3>{}, VectorXd{{0.5, 0.3}}),
                          slant::half_lines(VectorXd{{-1.0, 0.5}}));
}

TEST_CASE("values in the order of the blocks") {
  auto const set = mixed_set();
  auto const f = slant::inequalities(set);
  CHECK(f.rows() == 3 + 4 + 2);
  CHECK(f.cols() == 6 + 1 + 6 + 2);
  VectorXd const x = random_vector(15, 1);
  VectorXd const v = slant::evaluate(f, x);
  for (int i = 0; i < 3; ++i) {
    double const g = i == 0 ? 1 : i == 1 ? 2 : 0.5;
    CHECK(v[i] == doctest::Approx(x[i] * x[i] + x[i + 3] * x[i + 3] - g * g));
  }
  CHECK(v[7] == -1 - x[13]);
  CHECK(v[8] == 0.5 - x[14]);
}

TEST_CASE("a factor is part of the entries") {
  auto const set = mixed_set();
  VectorXd const x = random_vector(15, 2);
  auto const f = slant::inequalities(set);
  auto const g = slant::inequalities(set, -4.0);
  CHECK(slant::evaluate(g, x) == -4 * slant::evaluate(f, x));
  CHECK(dense_slant(g, x) == -4 * dense_slant(f, x));
  CHECK_THROWS_AS(static_cast<void>(slant::inequalities(set, std::nan(""))), slant::bad_input);
}

TEST_CASE("both are slanting functions, their derivatives operators with adjoints") {
  auto const set = mixed_set();
  auto const f = slant::inequalities(set);
  auto const force = slant::inequality_forces(set);
  CHECK(force.rows() == 15);
  CHECK(force.cols() == 24);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    slant::testing::check_slanting_laws(f, random_vector(15, seed));
    slant::testing::check_slanting_laws(force, random_vector(24, seed));
    slant::testing::check_operator_laws(f.slant(random_vector(15, seed)));
    slant::testing::check_operator_laws(force.slant(random_vector(24, seed)));
  }
}

TEST_CASE("forces are Jᵀz, and their derivative (H, Jᵀ)") {
  auto const set = mixed_set();
  auto const force = slant::inequality_forces(set);
  VectorXd const y = random_vector(24, 5);
  MatrixXd const J = dense_slant(slant::inequalities(set), VectorXd(y.head(15)));
  CHECK((slant::evaluate(force, y) - J.transpose() * y.tail(9)).norm() <= 1e-15 * y.norm());
  MatrixXd const G = dense_slant(force, y);
  CHECK(G.rightCols(9) == J.transpose());
  CHECK(G.leftCols(15) == G.leftCols(15).transpose());
  MatrixXd H = MatrixXd::Zero(15, 15);
  force.slant(y).visit_hessian([&](auto i, auto j, double h) { H(i, j) += h; });
  CHECK(G.leftCols(15) == H);
}

TEST_CASE("a single block") {
  slant::ball<3> const ball(2.0);
  auto const f = slant::inequalities(ball);
  VectorXd const x{{1.0, 2.0, 2.0}};
  CHECK(slant::evaluate(f, x)[0] == 5);
  CHECK(dense_slant(f, x) == 2 * x.transpose());
}

}  // namespace inequalities_test
