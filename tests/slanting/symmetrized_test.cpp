// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace symmetrized_test {

using namespace test::evaluated;
using slanting_support::dense;

struct scene {
  MatrixXd m = slanting_support::random_spd(8, 1);
  VectorXd b = 20 * slanting_support::random_vector(8, 2);
  VectorXd x = slanting_support::random_vector(8, 3);
  double ρ = 0.1;
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::power(slant::half_line<>{}, 2),
                            slant::power(slant::ball<2>{}, VectorXd{{1.0, 5.0, 0.0}}));
  }
};

TEST_CASE("H is symmetric, semidefinite and definite on the range of G") {
  scene const s;
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_definite>(s.m);
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  auto const newton = f.slant(s.x);
  auto const h = slant::symmetrized(newton);
  static_assert(slant::psd_operator<std::remove_cvref_t<decltype(h)>, VectorXd>);
  MatrixXd const hd = dense(h, s.x);
  MatrixXd const g = dense(slant::slant_of_projection(newton), s.x);
  MatrixXd const id = MatrixXd::Identity(8, 8);
  CHECK((hd - (g * (id - g) + s.ρ * g * s.m * g)).norm() <= 1e-15 * hd.norm());
  CHECK((hd - hd.transpose()).norm() <= 1e-15 * hd.norm());
  for (unsigned seed = 10; seed < 30; ++seed) {
    VectorXd const s_any = slanting_support::random_vector(8, seed);
    VectorXd const in_range = g * s_any;
    CHECK(s_any.dot(hd * s_any) >= 0);
    CHECK(in_range.dot(hd * in_range) > 1e-3 * s.ρ * in_range.squaredNorm());
  }
  VectorXd const radial = VectorXd::Unit(8, 6);  // the disc of radius 0 cannot move
  CHECK((hd * radial).norm() == 0);
}

TEST_CASE("one product by A each, no allocation, follows renewals of the operator") {
  scene const s;
  auto const a = slant::counted(slant::matrix<slant::self_adjoint, slant::positive_definite>(s.m));
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  auto newton = f.slant(VectorXd::Zero(8).eval());
  auto const h = slant::symmetrized(newton);
  auto wf = slant::workspace(f, s.x);
  auto w = slant::workspace(h, s.x);
  VectorXd y(8);
  slant::testing::allocation_guard const guard;
  slant::update_slant(f, s.x, newton, wf);
  a.reset_counts();
  slant::apply(h, s.x, y, w);
  auto const allocations = guard.count();
  CHECK(a.counts().applications == 1);
  CHECK(allocations == 0);
  CHECK(dense(h, s.x) == dense(slant::symmetrized(f.slant(s.x)), s.x));
}

TEST_CASE("archetypes") {
  namespace archetype = slant::testing::archetype;
  scene const s;
  archetype::spd_operator const a(s.m);
  auto const f = slant::natural_residual(a, s.b, s.set(), s.ρ);
  archetype::vector const x(s.x);
  auto const h = slant::symmetrized(f.slant(x));
  CHECK(dense(h, x).isApprox(dense(h, x).transpose(), 1e-13));
}

}  // namespace symmetrized_test
