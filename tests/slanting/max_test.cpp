// SPDX-License-Identifier: MIT
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
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

TEST_CASE("max(0, F)") {
  MatrixXd const a{{1.0, 2.0}, {3.0, -1.0}};
  auto const f = slant::positive_part(slant::linear(a));
  VectorXd const y{{1.0, 4.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{9.0, 0.0}});
  CHECK(dense_slant(f, y) == MatrixXd{{1.0, 2.0}, {0.0, 0.0}});
  slant::testing::check_slanting_laws(f, y, test::zeros(2));
}

TEST_CASE("max(F, G): the row of F at a tie") {
  MatrixXd const a{{2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 2.0}};
  auto const f = slant::max(slant::linear(a), slant::identity_map(3));
  VectorXd const y{{1.0, -2.0, 0.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{2.0, -2.0, 0.0}});
  MatrixXd const expected = Vector3d(2, 1, 2).asDiagonal();
  CHECK(dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y, test::zeros(3));
}

TEST_CASE("NaN in, NaN out") {
  double const nan = std::nan("");
  auto const f = slant::max(slant::identity_map(2), slant::positive_part(2));
  VectorXd const y{{nan, 1.0}};
  CHECK(std::isnan(slant::evaluate(f, y)[0]));
  CHECK(slant::evaluate(f, y)[1] == 1);
  CHECK(std::isnan(slant::evaluate(slant::positive_part(2), y)[0]));
  CHECK(std::isnan(dense_slant(f, y)(0, 0)));
  CHECK(std::isnan(dense_slant(slant::positive_part(2), y)(0, 0)));
  using kernel = slant::detail::max_kernel;
  CHECK(std::isnan(kernel::value(1.0, nan)));
  CHECK(kernel::value(HUGE_VAL, 1.0) == HUGE_VAL);
  CHECK(kernel::value(-HUGE_VAL, 1.0) == 1.0);
}

TEST_CASE("value and renewal allocate nothing") {
  auto const f = slant::max(slant::positive_part(20), slant::identity_map(20));
  VectorXd const y = slanting_support::random_vector(20, 1);
  slanting_support::check_renewal(f, y);
}

TEST_CASE("parts of which nothing is known but the concept") {
  namespace archetype = slant::testing::archetype;
  archetype::slanting_function const f(2);
  auto const g = slant::max(f, slant::identity_map(2));
  slant::testing::check_slanting_laws(g, archetype::vector(VectorXd{{1.0, -2.0}}),
                                      archetype::vector(VectorXd::Zero(2)));
}

TEST_CASE("multiprecision") {
  using wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                             boost::multiprecision::et_off>;
  using vector = Eigen::Matrix<wide, Eigen::Dynamic, 1>;
  auto const f = slant::max(slant::positive_part(2), slant::identity_map(2));
  vector y(2);
  y << wide(1) / 3, wide(-2);
  CHECK(slant::evaluate(f, y)[0] == wide(1) / 3);
  CHECK(slant::evaluate(f, y)[1] == 0);
  slant::testing::check_slanting_laws(f, y);
}

TEST_CASE("bad input") {
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::positive_part(-1)),
                       "n: got -1, expected a size >= 0", slant::bad_input);
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::max(slant::positive_part(3), slant::positive_part(2))),
      "g.rows(): got 2, expected 3 (f.rows())", slant::bad_input);
}

}  // namespace max_test
