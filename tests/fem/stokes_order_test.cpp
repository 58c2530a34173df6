// SPDX-License-Identifier: MIT
//
// A manufactured flow in the unit square that sticks to one half of its wall y = 0 and slips along
// the other:
//
//     ψ = s(x) sin y + y²,  s = 4 (x − ½)₊⁴,   u = (∂ψ/∂y, −∂ψ/∂x),   p = sin(2x) cos y.
//
// On the wall u = (s, 0) and σ_t = −ν ∂u₁/∂y = −2ν: with κ = ν/2 its law holds for g = 2ν − κ s
// where the fluid slips and any g ≥ 2ν elsewhere.
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <fem/stokes_balance.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/stokes_field.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace stokes_order_test {

constexpr double ν = 0.8;
constexpr double κ = ν / 2;

/// Derivative number k of s.
double s(double x, int k = 0) {
  double const d = std::max(0.0, x - 0.5);
  return std::array{4 * d * d * d * d, 16 * d * d * d, 48 * d * d,
                    96 * d}[static_cast<std::size_t>(k)];
}
Vector2d velocity(Vector2d const& x) {
  return {s(x[0]) * std::cos(x[1]) + 2 * x[1], -s(x[0], 1) * std::sin(x[1])};
}
double pressure(Vector2d const& x) {
  return std::sin(2 * x[0]) * std::cos(x[1]);
}
Vector2d force(Vector2d const& x) {
  double const sine = std::sin(x[1]);
  double const cosine = std::cos(x[1]);
  return {-ν * (s(x[0], 2) - s(x[0])) * cosine + 2 * std::cos(2 * x[0]) * cosine,
          ν * (s(x[0], 3) - s(x[0], 1)) * sine - std::sin(2 * x[0]) * sine};
}
/// ν du/dn − p n on the side x = 1.
Vector2d stress(Vector2d const& x, Vector2d const& n) {
  return Vector2d(ν * s(x[0], 1) * std::cos(x[1]), -ν * s(x[0], 2) * std::sin(x[1])) -
         pressure(x) * n;
}

struct errors {
  double velocity, pressure, gradient, shear;
  Eigen::Index wrong_states;
};

errors solve(int cells) {
  fem::stokes_flow flow;
  flow.domain = fem::make_rectangle({cells, cells}, {1, 1});
  flow.dirichlet = {"left", "top"};
  flow.wall = "bottom";
  flow.viscosity = ν;
  flow.velocity = velocity;
  flow.force = force;
  flow.stress = stress;
  flow.slip_bound = [](Vector2d const& x) {
    return 2 * ν - κ * s(x[0]) + std::max(0.0, 0.5 - x[0]);
  };
  flow.adhesion = [](Vector2d const&) { return κ; };
  auto const scene = fem::make_stokes_scene(flow);
  auto const factor = slant::factorize(scene.A);
  fem::stokes_dual const dual(factor, scene);
  auto const r = test::minimise(slant::symmetric_newton{dual.qp()}, dual.zero(), 1e-10, 100);
  REQUIRE(r.converged());
  auto const solution = dual.solution(r.x());
  CHECK(fem::check_balance(flow, scene, solution).residual() < 1e-9);
  auto const field = fem::make_wall_field(scene, solution);

  errors e{};
  auto const u = scene.velocity(solution.u);
  for (Eigen::Index cell = 0; cell < scene.mesh.cell_count(); ++cell) {
    auto const element = fem::element_of<2>(scene.mesh, cell);
    Eigen::Matrix<double, 2, 3> values;
    Vector3d pressures;
    Eigen::Matrix<double, 2, 3> corners;
    for (int a = 0; a < 3; ++a) {
      int const node = scene.mesh.cells(a, cell);
      values.col(a) = u.col(node);
      pressures[a] = solution.p[node];
      corners.col(a) = scene.mesh.nodes.col(node);
    }
    for (auto const& q : fem::triangle_points()) {
      Vector2d const x = corners * q.at;
      double const dx = q.weight * element.volume;
      e.velocity += dx * (values * q.at - velocity(x)).squaredNorm();
      e.pressure += dx * std::pow(pressures.dot(q.at) - pressure(x), 2);
      Eigen::Matrix2d exact;
      exact << s(x[0], 1) * std::cos(x[1]), -s(x[0]) * std::sin(x[1]) + 2,
          -s(x[0], 2) * std::sin(x[1]), -s(x[0], 1) * std::cos(x[1]);
      e.gradient += dx * (values * element.gradients.transpose() - exact).squaredNorm();
    }
  }
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const& at = scene.wall[static_cast<std::size_t>(i)];
    double const x = scene.mesh.nodes(0, at.node);
    e.shear += at.weight * std::pow(field.shear[i] + 2 * ν, 2);
    bool const slips = field.state[static_cast<std::size_t>(i)] == fem::wall_state::slip;
    // The border between stick and slip is known up to an edge or two.
    if (std::abs(x - 0.5) > 0.1) e.wrong_states += slips == (x > 0.5) ? 0 : 1;
  }
  return {std::sqrt(e.velocity), std::sqrt(e.pressure), std::sqrt(e.gradient), std::sqrt(e.shear),
          e.wrong_states};
}

TEST_CASE("a manufactured stick-slip flow: orders in h") {
  auto const coarse = solve(12);
  auto const middle = solve(24);
  auto const fine = solve(48);
  auto const order = [](double before, double after) { return std::log2(before / after); };
  for (auto const& [before, after] : {std::pair{coarse, middle}, std::pair{middle, fine}}) {
    CHECK(order(before.velocity, after.velocity) > 1.9);
    CHECK(order(before.gradient, after.gradient) > 0.95);
    CHECK(order(before.pressure, after.pressure) > 1.4);
    CHECK(order(before.shear, after.shear) > 1.9);
    CHECK(after.wrong_states == 0);
  }
  CHECK(fine.velocity < 1e-3);
  CHECK(fine.pressure < 0.02);
  CHECK(fine.shear < 1e-3);
}

}  // namespace stokes_order_test
