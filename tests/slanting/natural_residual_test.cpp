// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace natural_residual_test {

using namespace test::evaluated;
using slanting_support::dense;
using slanting_support::dense_slant;

/// Two bounds x >= 0 and two discs.
auto contact_set() {
  return slant::cartesian(slant::power(slant::half_line<>{}, 2),
                          slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0}}));
}

auto definite(MatrixXd const& m) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
}

TEST_CASE("value and slanting operator, derived by hand") {
  MatrixXd const m = slanting_support::random_spd(6, 1);
  VectorXd const b = 20 * slanting_support::random_vector(6, 2);
  VectorXd const x = slanting_support::random_vector(6, 3);
  double const ρ = 0.125;
  auto const a = definite(m);
  auto const set = contact_set();
  auto const f = slant::natural_residual(a, b, set, ρ);

  VectorXd const z = x - ρ * (m * x - b);
  VectorXd projected = z;
  MatrixXd g = MatrixXd::Zero(6, 6);
  for (int i = 0; i < 2; ++i) {
    projected[i] = std::max(0.0, z[i]);
    g(i, i) = z[i] >= 0 ? 1 : 0;
  }
  for (int k = 0; k < 2; ++k) {
    double const radius = k == 0 ? 1 : 5;
    Vector2d const part = z.segment<2>(2 + 2 * k);
    double const size = part.norm();
    if (size <= radius) {
      g.block<2, 2>(2 + 2 * k, 2 + 2 * k).setIdentity();
    } else {
      Vector2d const t(-part[1] / size, part[0] / size);  // the tangent
      projected.segment<2>(2 + 2 * k) *= radius / size;
      g.block<2, 2>(2 + 2 * k, 2 + 2 * k) = radius / size * t * t.transpose();
    }
  }
  REQUIRE(z.segment<2>(2).norm() > 1);  // one disc slides, one sticks, one bound is active
  REQUIRE(z.segment<2>(4).norm() < 5);
  REQUIRE(z.head<2>().minCoeff() < 0);
  MatrixXd const id = MatrixXd::Identity(6, 6);
  CHECK((slant::evaluate(f, x) - (x - projected)).cwiseAbs().maxCoeff() <= 4e-16 * z.norm());
  MatrixXd const expected = id - g * (id - ρ * m);
  CHECK((dense_slant(f, x) - expected).cwiseAbs().maxCoeff() <= 4e-16);
  slant::testing::check_slanting_laws(f, x);
}

TEST_CASE("it is the composition that stands on paper") {
  MatrixXd const m = slanting_support::random_spd(6, 1);
  VectorXd const b = slanting_support::random_vector(6, 2);
  VectorXd const x = slanting_support::random_vector(6, 3);
  auto const a = definite(m);
  auto const set = contact_set();
  auto const f = slant::natural_residual(a, b, set, 0.1);
  auto const id = [] { return slant::identity_map(6); };
  auto const formula =
      id() - slant::projection(set) * (id() - slant::positive(0.1) * (a * id() - VectorXd(b)));
  static_assert(std::is_same_v<decltype(f), decltype(formula)>);
  CHECK(slant::evaluate(f, x) == slant::evaluate(formula, x));
}

TEST_CASE("one product by A for the value, none for the slant after it, the first one included") {
  MatrixXd const m = slanting_support::random_spd(6, 1);
  VectorXd const b = slanting_support::random_vector(6, 2);
  auto const a = slant::counted(definite(m));
  auto const f = slant::natural_residual(a, b, contact_set(), 0.1);
  VectorXd const x = slanting_support::random_vector(6, 3);
  slanting_support::check_products(f, a, x);
  VectorXd v(6);
  auto w = slant::workspace(f, x);
  slant::evaluate(f, x, v, w);
  a.reset_counts();
  auto const g = slant::slant_from_value(f, x, w);
  static_assert(std::is_same_v<decltype(g), decltype(f.slant(x)) const>);
  CHECK(a.applications() == 0);
  CHECK(dense(g, x) == dense_slant(f, x));
}

TEST_CASE("archetype operator and vector") {
  namespace archetype = slant::testing::archetype;
  MatrixXd const m = slanting_support::random_spd(6, 1);
  archetype::spd_operator const a(m);
  archetype::vector const b(slanting_support::random_vector(6, 2));
  auto const f = slant::natural_residual(a, b, contact_set(), 0.1);
  archetype::vector const x(slanting_support::random_vector(6, 3));
  auto const same = slant::natural_residual(m, b.local(), contact_set(), 0.1);
  CHECK((slant::evaluate(f, x).local() - slant::evaluate(same, x.local())).norm() <= 1e-15);
  slant::testing::check_slanting_laws(f, x);
}

TEST_CASE("bad input is named") {
  MatrixXd const m = slanting_support::random_spd(6, 1);
  VectorXd b = slanting_support::random_vector(6, 2);
  auto const set = contact_set();
  CHECK(SLANT_COMPLAINT(slant::natural_residual(m.topRows(5), b, set, 1.0)) ==
        "A: got 5 x 6, expected 6 x 6 (the dimension of the set)");
  CHECK(SLANT_COMPLAINT(slant::natural_residual(m, b.head(5), set, 1.0)) ==
        "b.size(): got 5, expected 6 (the number of values)");
  CHECK(SLANT_COMPLAINT(slant::natural_residual(m, b, set, 0.0)) ==
        "rho: got 0, expected a finite number > 0");
  CHECK_THROWS_AS(static_cast<void>(slant::natural_residual(m, b, set, std::nan(""))),
                  slant::bad_input);
  b[4] = std::nan("");
  CHECK(SLANT_COMPLAINT(slant::natural_residual(m, b, set, 1.0)) ==
        "b[4]: got nan, expected a finite number");
}

TEST_CASE("multiprecision") {
  using S = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                          boost::multiprecision::et_off>;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  matrix const m = slanting_support::random_spd(4, 1).cast<S>();
  vector const b = vector::Constant(4, S(10));
  auto const set = slant::power(slant::ball<2, S>{}, vector(vector::Ones(2)));
  auto const f = slant::natural_residual(m, b, set, S(1) / S(8));
  vector x = vector::Zero(4);
  for (int k = 0; k < 12; ++k)
    x -= slanting_support::solve(slanting_support::dense_slant(f, x), slant::evaluate(f, x));
  CHECK(slant::evaluate(f, x).norm() <= S(16) * std::numeric_limits<S>::epsilon());
}

}  // namespace natural_residual_test
