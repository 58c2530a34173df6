// SPDX-License-Identifier: MIT
//
// Newton's method asks its parts for nothing more than the concepts name: archetypes of functions,
// vectors and scalars, and a vector on two processes.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/smooth.hpp>
#include <slant/testing/archetypes.hpp>

#include <newton/newton_scene.hpp>
#include <support/two_processes.hpp>

#include <doctest/doctest.h>

#include <array>

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

TEST_CASE("two processes take the same steps and reach the solution of one") {
  newton_scene::data const d(7);
  auto const A = d.definite();
  slant::index const n = 21, split = 8;
  auto const stop = slant::residual_below(1e-11) || slant::at_most(40);
  auto const F = slant::natural_residual(A, d.b, slant::half_lines(n), d.ρ);
  auto const alone = slant::solve(slant::semismooth_newton{F}, d.zero(), stop);
  test::two_processes group;
  std::array<VectorXd, 2> x;
  std::array<slant::index, 2> steps{};
  bool const finished = test::two_processes::run([&](int rank) {
    auto const first = rank == 0 ? 0 : split, count = rank == 0 ? split : n - split;
    test::shared_matrix const part{d.A.middleRows(first, count)};
    test::shared_vector const b(group, rank, d.b.segment(first, count));
    test::shared_vector const zero(group, rank, VectorXd::Zero(count));
    auto const f = slant::natural_residual(part, b, slant::half_lines(count), d.ρ);
    auto const r = slant::solve(slant::semismooth_newton{f}, zero, stop);
    x[std::size_t(rank)] = r.x().local();
    steps[std::size_t(rank)] = r.converged() ? r.iterations() : -1;
  });
  REQUIRE(finished);
  CHECK(steps[0] == alone.iterations());
  CHECK(steps[1] == alone.iterations());
  VectorXd together(n);
  together << x[0], x[1];
  CHECK((together - alone.x()).norm() <= 1e-10 * alone.x().norm());
}

}  // namespace semismooth_newton_archetypes_test
