// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace min_test {

using slanting_support::dense_slant;

TEST_CASE("min(F, G): the row of G at a tie") {
  MatrixXd const a = 2 * MatrixXd::Identity(3, 3);
  auto const f = slant::min(slant::linear(a), slant::identity_map(3));
  VectorXd const y{{1.0, -2.0, 0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{1.0, -4.0, 0.0}});
  MatrixXd const expected = Vector3d(1, 2, 1).asDiagonal();
  CHECK(dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y, test::zeros(3));
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

TEST_CASE("NaN in, NaN out") {
  double const nan = std::nan("");
  using kernel = slant::detail::min_kernel;
  CHECK(std::isnan(kernel::value(nan, 1.0)));
  CHECK(std::isnan(kernel::value(1.0, nan)));
  CHECK(std::isnan(kernel::slopes(nan, 1.0).first));
  CHECK(kernel::value(-HUGE_VAL, 1.0) == -HUGE_VAL);
  CHECK(kernel::value(1.0, HUGE_VAL) == 1.0);
}

}  // namespace min_test
