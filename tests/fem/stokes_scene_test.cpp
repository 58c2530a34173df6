// SPDX-License-Identifier: MIT
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/testing/laws.hpp>

#include <fem/stokes_balance.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/stokes_field.hpp>
#include <oracle/dense_stokes.hpp>
#include <support/dense_of.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace stokes_scene_test {

using namespace test::evaluated;
/// A distorted rectangle with a wall at the bottom, a force and a flow through it.
fem::stokes_flow small_flow(double g, double κ) {
  fem::stokes_flow flow;
  flow.domain = fem::make_rectangle({3, 2}, {1.5, 1});
  for (Eigen::Index i = 0; i < flow.domain.mesh.node_count(); ++i) {
    double const x = flow.domain.mesh.nodes(0, i);
    flow.domain.mesh.nodes(1, i) += 0.2 * x * (1.5 - x);  // both walls are curved
  }
  flow.dirichlet = {"left", "top"};
  flow.wall = "bottom";
  flow.viscosity = 0.7;
  flow.velocity = [](Vector2d const& x) -> Vector2d { return {x[1] * (1.3 - x[1]), 0.1 * x[1]}; };
  flow.force = [](Vector2d const& x) -> Vector2d { return {3 * x[1] - 9 * x[0] + 4, 1 - x[0]}; };
  flow.slip_bound = [g](Vector2d const& x) { return g * (1 + x[0] / 3); };
  flow.adhesion = [κ](Vector2d const& x) { return κ * (2 - x[0]); };
  return flow;
}

oracle::stokes_problem naive(fem::stokes_flow const& flow) {
  auto const& nodes = flow.domain.mesh.nodes;
  oracle::stokes_problem p{nodes, flow.domain.mesh.cells, flow.viscosity, nodes, {}, nodes, {}};
  p.fixed.assign(static_cast<std::size_t>(nodes.cols()), false);
  for (int i = 0; i < nodes.cols(); ++i) {
    int const column = i / 3;  // the last axis runs fastest
    int const row = i % 3;
    p.fixed[static_cast<std::size_t>(i)] = column == 0 || row == 2;
    p.force.col(i) = flow.force(nodes.col(i));
    p.given.col(i) = flow.velocity(nodes.col(i));
    if (row != 0 || column == 0) continue;
    Vector2d along = column == 3 ? Vector2d(0, 0) : Vector2d(nodes.col(i + 3) - nodes.col(i));
    double weight = along.norm() / 2;
    Vector2d const before = nodes.col(i) - nodes.col(i - 3);
    along = (along + before).normalized();
    weight += before.norm() / 2;
    p.wall.push_back({i,
                      {along[1], -along[0]},
                      along,
                      weight,
                      flow.slip_bound(nodes.col(i)),
                      flow.adhesion(nodes.col(i))});
  }
  return p;
}

struct solved {
  fem::stokes_scene scene;
  fem::stokes_solution solution;
  bool converged;
};

solved solve(fem::stokes_flow const& flow, fem::dual_units units, double tolerance = 1e-13) {
  solved s{fem::make_stokes_scene(flow), {}, false};
  auto const factor = slant::factorize(s.scene.A);
  fem::stokes_dual const dual(factor, s.scene, units);
  auto const r = test::minimise(slant::symmetric_newton{dual.qp()}, dual.zero(), tolerance, 200);
  s.converged = r.converged();
  s.solution = dual.solution(r.x());
  return s;
}

TEST_CASE("a small flow: velocities, pressures and wall forces are those of the naive solver") {
  struct wall {
    double g, κ;
  };
  // Nothing slips, some of the wall slips, all of it slips; with Navier's law and without.
  bool mixed = false;
  for (auto const& [g, κ] :
       {wall{1e3, 0}, wall{0.35, 0}, wall{0.3, 0.4}, wall{0.01, 0}, wall{0, 1}}) {
    CAPTURE(g);
    auto const flow = small_flow(g, κ);
    auto const ours = solve(flow, fem::dual_units::balanced);
    REQUIRE(ours.converged);
    auto const reference = oracle::dense_stokes(naive(flow)).solve(1e-12);
    REQUIRE(reference.has_value());
    CHECK((ours.scene.velocity(ours.solution.u) - reference->velocity).norm() <
          1e-11 * reference->velocity.norm());
    CHECK((ours.solution.p - reference->pressure).norm() < 1e-10 * reference->pressure.norm());
    CHECK((ours.solution.tangential - reference->tangential).norm() <=
          1e-10 * reference->pressure.norm());
    CHECK((ours.solution.normal - reference->normal).norm() < 1e-10 * reference->normal.norm());
    auto const field = fem::make_wall_field(ours.scene, ours.solution);
    for (std::size_t i = 0; i < field.state.size(); ++i)
      CHECK((field.state[i] == fem::wall_state::stick) == (reference->slip[i] == 0));
    auto const sticking = field.count(fem::wall_state::stick);
    CHECK((g < 1e3 || sticking == 3));
    CHECK((g > 0.01 || sticking == 0));
    mixed = mixed || (sticking > 0 && sticking < 3);
  }
  CHECK(mixed);
}

TEST_CASE("units of the dual problem do not change the solution") {
  auto const flow = small_flow(0.35, 0.1);
  auto const one = solve(flow, fem::dual_units::balanced);
  auto const two = solve(flow, fem::dual_units::physical);
  REQUIRE(one.converged);
  REQUIRE(two.converged);
  CHECK((one.solution.u - two.solution.u).norm() < 1e-11 * one.solution.u.norm());
  CHECK((one.solution.p - two.solution.p).norm() < 1e-10 * one.solution.p.norm());
}

TEST_CASE("A is what its laws say, and what the formula says") {
  auto const scene = fem::make_stokes_scene(small_flow(1, 0.5));
  auto const factor = slant::factorize(scene.A);
  fem::stokes_dual const dual(factor, scene, fem::dual_units::physical);
  auto const A = dual.a();
  slant::testing::check_operator_laws(A);

  Eigen::Index const m = scene.wall_count();
  MatrixXd C(2 * m + scene.pressure_count(), scene.velocity_count());
  C << scene.T.toDense(), scene.N.toDense(), scene.B.toDense();
  MatrixXd expected = C * scene.A.toDense().inverse() * C.transpose();
  expected.bottomRightCorner(scene.pressure_count(), scene.pressure_count()) += scene.E.toDense();
  CHECK((test::dense_of(A) - expected).norm() < 1e-12 * expected.norm());
  CHECK(test::eigenvalues_of(expected)[0] > 1e-6);
}

TEST_CASE("bad data are refused") {
  auto const refused = [](fem::stokes_flow const& flow, char const* message) {
    CHECK_THROWS_WITH_AS(static_cast<void>(fem::make_stokes_scene(flow)), message,
                         std::invalid_argument);
  };
  auto flow = small_flow(1, 0);
  flow.viscosity = 0;
  refused(flow, "viscosity: got 0, expected a positive finite number");
  refused(small_flow(-1, 0), "slip_bound: got -1.1666666666666667, expected a number >= 0");
  refused(small_flow(std::nan(""), 0), "slip_bound: got nan, expected a number >= 0");
  refused(small_flow(1, -1), "adhesion: got -1.5, expected a finite number >= 0");
  flow = small_flow(1, 0);
  flow.wall = "floor";
  refused(flow, "part of the boundary: got floor, expected a name that the mesh has");
  flow = small_flow(1, 0);
  flow.dirichlet = {};
  refused(flow, "edges with a given velocity: got 0, expected at least one");
  flow.dirichlet = {"left", "right", "top"};
  refused(flow, "edges with a given stress: got 0, expected at least one");
}

}  // namespace stokes_scene_test
