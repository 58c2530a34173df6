// SPDX-License-Identifier: MIT
#include <slant/newton/krylov_solvers.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/testing/archetypes.hpp>

#include <slanting/slanting_support.hpp>
#include <support/allocation_guard.hpp>

#include <doctest/doctest.h>

namespace cg_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("a sequence of definite systems in the memory of the first") {
  slant::cg_solver const solver;
  VectorXd dy(20);
  auto const spd = [](MatrixXd const& m) {
    return slant::counted(slant::matrix<slant::self_adjoint, slant::positive_definite>(m));
  };
  MatrixXd const first = slanting_support::random_spd(20, 1);
  VectorXd f = slanting_support::random_vector(20, 2);
  auto p = solver.prepare(spd(first), f);
  for (unsigned seed : {1U, 5U, 9U}) {
    MatrixXd const m = slanting_support::random_spd(20, seed);
    f = std::ldexp(1.0, 100 * (int(seed) - 5)) * slanting_support::random_vector(20, seed + 1);
    auto const G = spd(m);
    slant::testing::allocation_guard const guard;
    auto const r = solver.solve(G, f, {1e-9, f.norm(), 0}, dy, p);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK(r.status == slant::status::converged);
    CHECK(r.operator_applications == r.iterations);
    CHECK(G.applications() == r.iterations);
    double const residual = (f + m * dy).norm();
    CHECK(std::abs(residual - r.residual_norm) <= 1e-13 * f.norm());
    CHECK(residual <= 1.001e-9 * f.norm());
  }
}

TEST_CASE("warm start: half of the last direction, one application more") {
  MatrixXd const m = slanting_support::random_spd(20, 1);
  auto const G = slant::matrix<slant::self_adjoint, slant::positive_definite>(m);
  VectorXd const f = slanting_support::random_vector(20, 2);
  VectorXd const half = f / 2;
  VectorXd dy(20);
  slant::cg_solver const solver{.warm_start = true};
  auto p = solver.prepare(G, f);
  CHECK(solver.solve(G, f, {1e-8, f.norm(), 0}, dy, p).iterations > 5);
  auto const r = solver.solve(G, half, {1e-7, half.norm(), 0.5}, dy, p);
  CHECK(r.iterations == 0);
  CHECK(r.operator_applications == 1);
  CHECK((half + m * dy).norm() <= 1e-7 * half.norm());
}

TEST_CASE("an operator that breaks its word; limits") {
  MatrixXd const indefinite = VectorXd{{1.0, -1.0}}.asDiagonal();
  auto const G = slant::matrix<slant::self_adjoint, slant::positive_definite>(indefinite);
  VectorXd const f = VectorXd::Ones(2);
  VectorXd dy(2);
  slant::cg_solver const solver;
  auto p = solver.prepare(G, f);
  CHECK(solver.solve(G, f, {1e-8, f.norm(), 0}, dy, p).status == slant::status::breakdown);
  CHECK(dy.allFinite());
  CHECK_THROWS_AS(slant::cg_solver{.max_iterations = -1}.validate(), slant::bad_input);

  namespace archetype = slant::testing::archetype;
  static_assert(
      slant::direction_solver<slant::cg_solver, archetype::spd_operator, archetype::vector>);
  static_assert(
      !slant::direction_solver<slant::cg_solver, archetype::psd_operator, archetype::vector>);
}

}  // namespace cg_solver_test
