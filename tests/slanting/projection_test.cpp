// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace projection_test {

using slanting_support::dense_slant;

TEST_CASE("a product of half lines and discs: values, slopes, laws, kinks") {
  auto const bounds = slant::power(slant::half_line<>{}, VectorXd{{0.0, -1.0}});
  auto const discs = slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0}});
  auto const set = slant::cartesian(bounds, discs);
  auto const f = slant::projection(set);
  VectorXd const y{{-1.0, 2.0, 3.0, 4.0, 3.0, 4.0}};
  CHECK((slant::evaluate(f, y) - VectorXd{{0.0, 2.0, 0.6, 0.8, 3.0, 4.0}}).norm() <= 1e-15);

  MatrixXd expected = MatrixXd::Zero(6, 6);
  expected(1, 1) = 1;                                                             // above its bound
  expected.block<2, 2>(2, 2) << 16.0 / 125, -12.0 / 125, -12.0 / 125, 9.0 / 125;  // (1/5)(I − eeᵀ)
  expected.block<2, 2>(4, 4).setIdentity();  // on the circle: inside
  CHECK((dense_slant(f, y) - expected).cwiseAbs().maxCoeff() <= 1e-16);

  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, VectorXd>;
  static_assert(slant::declares_self_adjoint<slope>);
  static_assert(slant::declares_firmly_nonexpansive<slope>);

  VectorXd const at_kinks{{0.0, -1.0, 0.6, 0.8, 5.0, 0.0}};
  slant::testing::check_slanting_laws(f, y, at_kinks, test::zeros(6));
}

TEST_CASE("one block, of fixed size and on dynamic vectors") {
  auto const f = slant::projection(slant::ball<3>(2.0));
  Vector3d const outside(0, 0, 8);
  CHECK(slant::evaluate(f, outside) == Vector3d(0, 0, 2));
  Eigen::Matrix3d const expected = Vector3d(0.25, 0.25, 0).asDiagonal();
  CHECK(dense_slant(f, outside) == expected);
  CHECK(dense_slant(f, VectorXd(outside)) == expected);
  CHECK(f.set().radius() == 2);
  slant::testing::check_slanting_laws(f, outside, Vector3d(2, 0, 0));
}

TEST_CASE("archetype vectors") {
  auto const f = slant::projection(slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0}}));
  using slant::testing::archetype::vector;
  slant::testing::check_slanting_laws(f, vector(VectorXd{{3.0, 4.0, 3.0, 4.0}}));
}

TEST_CASE("renewal and value allocate nothing") {
  auto const set = slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0}});
  slanting_support::check_renewal(slant::projection(set), VectorXd{{3.0, 4.0, 3.0, 4.0}});
}

TEST_CASE("a client's set whose slant is a matrix of any size") {
  struct hyperplane {  // x₁ + … + x_n = 0
    slant::index n;
    [[nodiscard]] slant::index size() const { return n; }
    [[nodiscard]] bool contains(VectorXd const& x) const { return std::abs(x.sum()) <= 1e-12; }
    void project(VectorXd const& x, VectorXd& y) const { y = x.array() - x.mean(); }
    [[nodiscard]] MatrixXd slant(VectorXd const&) const {
      return MatrixXd::Identity(n, n) - MatrixXd::Constant(n, n, 1.0 / double(n));
    }
  };
  auto const f = slant::projection(hyperplane{4});
  slant::testing::check_slanting_laws(f, VectorXd{{1.0, 2.0, 3.0, -5.0}});
  using slope = slant::slant_operator_t<std::remove_cvref_t<decltype(f)>, VectorXd>;
  static_assert(slant::declares_firmly_nonexpansive<slope>);
}

}  // namespace projection_test
