// SPDX-License-Identifier: MIT
//
// Newton's method asks its parts for nothing more than the concepts name: archetypes of functions,
// vectors and scalars.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/smooth.hpp>
#include <slant/testing/archetypes.hpp>

#include <newton/newton_scene.hpp>

#include <doctest/doctest.h>

namespace semismooth_newton_archetypes_test {

namespace archetype = slant::testing::archetype;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("a function, its operator and a vector that can do the least") {
  archetype::slanting_function const F(3);  // |y| + y/2: zero at y = 0 only
  auto const r =
      slant::solve(slant::semismooth_newton{F}, archetype::vector(VectorXd{{1.0, 2.0, 5.0}}),
                   slant::residual_below(1e-12) || slant::at_most(20));
  using solver = decltype(slant::semismooth_newton{F})::solver_for<archetype::vector>;
  static_assert(std::is_same_v<solver, slant::bicgstab_solver>);
  CHECK(r.converged());
  CHECK(r.x().local().norm() <= 1e-12);
}

TEST_CASE("a natural residual of archetypes") {
  newton_scene::data const d(4);
  archetype::spd_operator const A(d.A);
  auto const set = newton_scene::contact_set(4, 1e-2);
  auto const F = slant::natural_residual(A, archetype::vector(d.b), set, d.ρ);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(40);
  auto const r = slant::solve(slant::semismooth_newton{F}, archetype::vector(d.zero()), stop);
  auto const definite = d.definite();
  auto const same = slant::natural_residual(definite, d.b, set, d.ρ);
  auto const expected = slant::solve(slant::semismooth_newton{same}, d.zero(), stop);
  REQUIRE(r.converged());
  CHECK((r.x().local() - expected.x()).norm() <= 1e-12 * expected.x().norm());
  CHECK(r.state.work == expected.state.work);
}

TEST_CASE("a scalar without silent conversions gives the bits of double") {
  using S = archetype::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  newton_scene::data const d(4);
  auto const strictly = [](double v) { return S(v); };
  matrix const m = d.A.unaryExpr(strictly);
  vector const b = d.b.unaryExpr(strictly), zero = d.zero().unaryExpr(strictly);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
  auto const F = slant::natural_residual(A, b, newton_scene::contact_set<S>(4, 1e-2), S(d.ρ));
  auto const definite = d.definite();
  auto const G = slant::natural_residual(definite, d.b, newton_scene::contact_set(4, 1e-2), d.ρ);
  auto const r = slant::solve(slant::semismooth_newton{F}, zero,
                              slant::residual_below(S(1e-12)) || slant::at_most(40));
  auto const expected = slant::solve(slant::semismooth_newton{G}, d.zero(),
                                     slant::residual_below(1e-12) || slant::at_most(40));
  REQUIRE(r.converged());
  CHECK(r.iterations() == expected.iterations());
  VectorXd const x = r.x().unaryExpr([](S const& x_i) { return x_i.value(); });
  CHECK((x - expected.x()).norm() <= 1e-12 * expected.x().norm());
}

}  // namespace semismooth_newton_archetypes_test
