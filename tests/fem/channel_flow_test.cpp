// SPDX-License-Identifier: MIT
//
// The channel with a round obstacle [K Ex 4] on the shipped meshes.
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/methods.hpp>

#include <fem/channel_flow.hpp>
#include <fem/stokes_balance.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/stokes_field.hpp>
#include <fem/stokes_table.hpp>
#include <fem/wall_preconditioner.hpp>
#include <support/testing.hpp>
#include "support/folders.hpp"

namespace channel_flow_test {

using namespace test::evaluated;
fem::planar_domain const& shipped_mesh(int refinement) {
  static auto const read = [](int k) {
    return fem::read_gmsh(
        test::source("examples/stokes/meshes/channel_" + std::to_string(k) + ".msh"));
  };
  static fem::planar_domain const meshes[]{read(1), read(2)};
  return meshes[refinement - 1];
}

TEST_CASE("the shipped meshes have the sizes of the printed table") {
  for (int k : {1, 2}) {
    auto const scene = fem::make_stokes_scene(fem::make_channel_flow(shipped_mesh(k)));
    auto const& printed = fem::lecture_table_4[static_cast<std::size_t>(k - 1)];
    CHECK(scene.velocity_count() == printed.velocities);
    CHECK(scene.pressure_count() == printed.pressures);
    CHECK(scene.wall_count() == printed.wall_nodes);
    // The obstacle is round: normals of the mesh are those of the circle.
    for (auto const& at : scene.wall) {
      Vector2d const x = scene.mesh.nodes.col(at.node);
      CHECK(x.norm() == doctest::Approx(0.05).epsilon(1e-12));
      CHECK((at.normal + x / 0.05).norm() < 1e-7);
    }
  }
}

struct solved_flow {
  fem::stokes_flow flow;
  fem::stokes_scene scene;
  fem::stokes_solution solution;
  slant::index products;
};

solved_flow solve(double g, double κ, bool newton = true) {
  auto flow = fem::make_channel_flow(shipped_mesh(1), {.slip_bound = g, .adhesion = κ});
  auto scene = fem::make_stokes_scene(flow);
  auto const factor = slant::factorize(scene.A);
  fem::stokes_dual const dual(factor, scene);
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(2000);
  auto const keep = [&](auto const& report) {
    REQUIRE(report.converged());
    return solved_flow{flow, scene, dual.solution(report.x()),
                       report.state.work.operator_applications};
  };
  if (newton)
    return keep(slant::solve(
        slant::symmetric_newton{dual.qp(), fem::wall_preconditioner(flow.domain, scene)},
        dual.zero(), stop));
  return keep(slant::solve(slant::kprgp{dual.qp()}, dual.zero(), stop));
}

TEST_CASE("balance of mass and the law of the wall; g = 10 sticks and slips, g = 30 only sticks") {
  for (auto const& [g, κ] : {std::pair{10.0, 0.0}, std::pair{30.0, 0.0}, std::pair{8.0, 20.0}}) {
    CAPTURE(g);
    auto const s = solve(g, κ);
    auto const balance = fem::check_balance(s.flow, s.scene, s.solution);
    CHECK(balance.residual() < 1e-8);
    // The trapezoidal rule for ∫ 7.5 (0.04 − y²) on 8 edges, and all of it comes out again.
    double inflow = 0;
    for (int i = 1; i < 8; ++i) inflow += 0.05 * 7.5 * (0.04 - std::pow(0.05 * i - 0.2, 2));
    CHECK(balance.inflow == doctest::Approx(inflow).epsilon(1e-12));
    CHECK(balance.outflow == doctest::Approx(inflow).epsilon(1e-9));

    auto const field = fem::make_wall_field(s.scene, s.solution);
    auto const sticking = field.count(fem::wall_state::stick);
    CHECK((g == 30.0) == (sticking == 30));
    CHECK(sticking > 0);
    // The flow pushes the obstacle downstream: σ acts on the fluid, upstream.
    double drag = 0;
    for (std::size_t i = 0; i < s.scene.wall.size(); ++i)
      drag += s.scene.wall[i].weight * s.scene.wall[i].tangent[0] *
              field.shear[static_cast<Eigen::Index>(i)];
    CHECK(drag < -0.5);
  }
}

TEST_CASE("Newton's method needs fewer products than printed; the active-set method agrees") {
  auto const newton = solve(10, 0);
  auto const active_set = solve(10, 0, false);
  CHECK(newton.products < fem::lecture_table_4[0].path_following[0]);
  CHECK(active_set.products < fem::lecture_table_4[0].active_set[0] / 10);
  CHECK((newton.solution.u - active_set.solution.u).norm() < 1e-8 * newton.solution.u.norm());
  CHECK((newton.solution.p - active_set.solution.p).norm() < 1e-8 * newton.solution.p.norm());
}

/// Largest over smallest eigenvalue of M A, restricted to the forces of the wall.
double condition(int refinement, bool preconditioned) {
  auto const flow = fem::make_channel_flow(shipped_mesh(refinement));
  auto const scene = fem::make_stokes_scene(flow);
  auto const factor = slant::factorize(scene.A);
  fem::stokes_dual const dual(factor, scene);
  Eigen::Index const m = scene.wall_count();
  MatrixXd A(2 * m, 2 * m);
  VectorXd y(dual.b().size());
  auto const a = dual.a();
  for (Eigen::Index j = 0; j < 2 * m; ++j) {
    slant::apply(a, VectorXd(VectorXd::Unit(y.size(), j)), y);
    A.col(j) = y.head(2 * m);
  }
  if (preconditioned) {
    MatrixXd M = MatrixXd::Zero(2 * m, 2 * m);
    M.topLeftCorner(m, m) = fem::wall_half_norm(flow.domain, scene);
    M.bottomRightCorner(m, m) = M.topLeftCorner(m, m);
    MatrixXd const L = M.llt().matrixL();
    A = L.transpose() * A * L;
  }
  VectorXd const λ = test::eigenvalues_of(A);
  return λ.maxCoeff() / λ.minCoeff();
}

TEST_CASE("with the preconditioner, the condition of the wall does not grow with its nodes") {
  CHECK(condition(1, true) < 4);
  CHECK(condition(2, true) < 4);
  CHECK(condition(2, false) > 1.8 * condition(1, false));
}

}  // namespace channel_flow_test
