// SPDX-License-Identifier: MIT
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/counted.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace max_test {

using slanting_support::dense_slant;

TEST_CASE("max(0, y): slope 1 at the kink, a projector") {
  auto const f = slant::positive_part(4);
  VectorXd const y{{1.0, -2.0, 0.0, -0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{1.0, 0.0, 0.0, 0.0}});
  MatrixXd const expected = Eigen::Vector4d(1, 0, 1, 1).asDiagonal();
  CHECK(dense_slant(f, y) == expected);
  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, VectorXd>;
  static_assert(slant::declares_self_adjoint<slope>);
  static_assert(slant::declares_projector<slope>);
  static_assert(slant::declares_firmly_nonexpansive<slope>);
  static_assert(!slant::declares_positive_definite<slope>);
  slant::testing::check_slanting_laws(f, y, slant::testing::archetype::vector(y));
}

TEST_CASE("at a tie: the row of F for max(F, G), that of G for min(F, G)") {
  MatrixXd const a = 2 * MatrixXd::Identity(3, 3);
  VectorXd const y{{1.0, -2.0, 0.0}};
  auto const check = [&](auto const& f, Vector3d const& value, Vector3d const& slopes) {
    CHECK(slant::evaluate(f, y) == value);
    CHECK(dense_slant(f, y) == MatrixXd(slopes.asDiagonal()));
    slant::testing::check_slanting_laws(f, y, test::zeros(3));
  };
  check(slant::max(slant::linear(a), slant::identity_map(3)), {2, -2, 0}, {2, 1, 2});
  check(slant::min(slant::linear(a), slant::identity_map(3)), {1, -4, 0}, {1, 2, 1});
}

TEST_CASE("Newton's method begins with one value of F") {
  auto const A = slant::counted(MatrixXd(2 * MatrixXd::Identity(3, 3)));
  auto const f = slant::stack(slant::min(slant::identity_map(3), slant::linear(A)));
  static_cast<void>(slant::semismooth_newton{f}.start(test::zeros(3)));
  CHECK(A.applications() == 1);
}

TEST_CASE("NaN in, NaN out") {
  auto const f = slant::max(slant::identity_map(2), slant::positive_part(2));
  VectorXd const y{{quiet_nan, 1.0}};
  CHECK(std::isnan(slant::evaluate(f, y)[0]));
  CHECK(slant::evaluate(f, y)[1] == 1);
  CHECK(std::isnan(slant::evaluate(slant::positive_part(2), y)[0]));
  CHECK(std::isnan(dense_slant(f, y)(0, 0)));
  CHECK(std::isnan(dense_slant(slant::positive_part(2), y)(0, 0)));
  using kernel = slant::detail::max_kernel;
  CHECK(std::isnan(kernel::value(1.0, quiet_nan)));
  CHECK(kernel::value(HUGE_VAL, 1.0) == HUGE_VAL);
  CHECK(kernel::value(-HUGE_VAL, 1.0) == 1.0);
}

TEST_CASE("value and renewal allocate nothing") {
  slanting_support::check_renewal(slant::max(slant::positive_part(20), slant::identity_map(20)),
                                  slanting_support::random_vector(20, 1));
}

TEST_CASE("parts of which nothing is known but the concept") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const g = slant::max(f, slant::identity_map(2));
  slant::testing::check_slanting_laws(g, archetype::vector(VectorXd{{1.0, -2.0}}),
                                      archetype::vector(VectorXd::Zero(2)));
}

TEST_CASE("bad input") {
  CHECK(SLANT_COMPLAINT(slant::positive_part(-1)) == "n: got -1, expected a size >= 0");
  CHECK(SLANT_COMPLAINT(slant::max(slant::positive_part(3), slant::positive_part(2))) ==
        "g.rows(): got 2, expected 3 (f.rows())");
}

TEST_CASE("min(x, rho r(x)) is the natural residual of x >= 0, at kinks too") {
  // Small integers: everything is exact. r(x) = (8, −1, 0), so there are ties in the components 0
  // and 2 at ρ = 1/4.
  MatrixXd const m{{4.0, 1.0, 0.0}, {1.0, 4.0, 1.0}, {0.0, 1.0, 4.0}};
  VectorXd const x{{2.0, 0.5, 0.0}};
  VectorXd const b{{0.5, 5.0, 0.5}};
  auto const a = slant::matrix(m);
  double const ρ = 0.25;
  auto const f = slant::min(slant::identity_map(3), ρ * slant::affine(a, -b));
  auto const g = slant::natural_residual(a, b, slant::power(slant::half_line<>{}, 3), ρ);
  CHECK(slant::evaluate(f, x) == VectorXd{{2.0, -0.25, 0.0}});
  CHECK(slant::evaluate(g, x) == VectorXd{{2.0, -0.25, 0.0}});
  CHECK(dense_slant(f, x) == ρ * m);
  CHECK(dense_slant(g, x) == ρ * m);
  VectorXd const elsewhere{{1.0, 0.5, -1.0}};
  CHECK(slant::evaluate(f, elsewhere) == slant::evaluate(g, elsewhere));
  CHECK(dense_slant(f, elsewhere) == dense_slant(g, elsewhere));
}

TEST_CASE("NaN in, NaN out, for the smaller of two") {
  using kernel = slant::detail::min_kernel;
  CHECK(std::isnan(kernel::value(quiet_nan, 1.0)));
  CHECK(std::isnan(kernel::value(1.0, quiet_nan)));
  CHECK(std::isnan(kernel::slopes(quiet_nan, 1.0).first));
  CHECK(kernel::value(-HUGE_VAL, 1.0) == -HUGE_VAL);
  CHECK(kernel::value(1.0, HUGE_VAL) == 1.0);
}

}  // namespace max_test
