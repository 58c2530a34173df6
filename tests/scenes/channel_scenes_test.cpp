// SPDX-License-Identifier: MIT
//
// A flow in a channel whose wall sticks and slips (g = 10) or only sticks (g = 30).
#include <slant/factorizations/ldlt.hpp>

#include <fem/channel_flow.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/wall_preconditioner.hpp>
#include <scenes/scene.hpp>
#include <support/testing.hpp>
#include "support/folders.hpp"

namespace channel_scenes_test {

using scenes::scene;

/// A flow with factors of its velocity block and its dual problem in balanced units.
struct flow_data {
  explicit flow_data(fem::stokes_flow const& flow)
      : scene(fem::make_stokes_scene(flow)), factor(slant::ldlt(scene.A)), dual(factor, scene) {}

  fem::stokes_scene scene;
  decltype(slant::ldlt(std::declval<Eigen::SparseMatrix<double> const&>())) factor;
  fem::stokes_dual<decltype(factor)> dual;
};

/// The same dual problem with dense matrices.
[[nodiscard]] oracle::dense_qp dense_flow(fem::stokes_scene const& s) {
  Eigen::Index const m = s.wall_count();
  Eigen::Index const n = 2 * m + s.pressure_count();
  VectorXd units = VectorXd::Constant(n, std::sqrt(s.viscosity));
  units.tail(n - 2 * m).array() /= s.pressure_mass.array().sqrt();
  Eigen::LLT<MatrixXd> const K{MatrixXd(s.A)};
  MatrixXd Y(s.A.rows(), n);
  Y << MatrixXd(s.T).transpose(), MatrixXd(s.N).transpose(), MatrixXd(s.B).transpose();
  VectorXd w = s.l;
  K.matrixL().solveInPlace(Y);
  K.matrixL().solveInPlace(w);
  oracle::dense_qp plain;
  plain.A = Y.transpose() * Y;
  plain.A.bottomRightCorner(n - 2 * m, n - 2 * m) += MatrixXd(s.E);
  plain.A = units.asDiagonal() * plain.A * units.asDiagonal();
  VectorXd b = Y.transpose() * w;
  b.tail(n - 2 * m) -= s.c;
  plain.b = units.cwiseProduct(b).cast<oracle::real>();
  for (Eigen::Index i = 0; i < m; ++i)
    plain.intervals.push_back({i, -s.g[i] / units[i], s.g[i] / units[i]});
  return plain;
}

[[nodiscard]] scene flow(std::string name, fem::stokes_flow const& f) {
  auto const data = std::make_shared<flow_data const>(f);
  auto const& s = data->scene;
  VectorXd const g = s.g.cwiseQuotient(data->dual.units().head(s.wall_count()));
  auto const plain = dense_flow(s);
  return {std::move(name),
          data,
          data->dual.a(),
          fem::wall_preconditioner(f.domain, s),
          data->dual.b(),
          scenes::make_set(
              {.lower = -g, .upper = g, .free = s.wall_count(), .more_free = s.pressure_count()}),
          plain,
          scenes::solved(plain)};
}

/// The channel on its coarsest mesh, or, as a light effort, a straight one whose bottom is the
/// wall.
[[nodiscard]] fem::stokes_flow channel(double g) {
  if (test::effort(true, false)) {
    return fem::make_channel_flow(
        fem::read_gmsh(test::source("examples/stokes/meshes/channel_1.msh")), {.slip_bound = g});
  }
  fem::stokes_flow flow;
  flow.domain = fem::make_rectangle({5, 3}, {2, 1});
  flow.dirichlet = {"left", "top"};
  flow.wall = "bottom";
  flow.velocity = [](Vector2d const& x) -> Vector2d { return {10 * x[1] * (1 - x[1]), 0}; };
  flow.slip_bound = [g](Vector2d const& x) { return g * (0.6 + 0.4 * x[0]); };
  return flow;
}

}  // namespace channel_scenes_test

namespace scenes {

std::vector<scene> channel_scenes() {
  std::vector<scene> all;
  for (double const g : {10.0, 30.0})
    all.push_back(channel_scenes_test::flow("channel, g = " + slant::detail::show(g),
                                            channel_scenes_test::channel(g)));
  all.back().active = std::pair{0, 0};  // with g = 30
  return all;
}

}  // namespace scenes
