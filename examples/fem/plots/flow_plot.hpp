// SPDX-License-Identifier: MIT
//
// Pictures of a flow past an obstacle like the lecture's Figures 9 and 10 [K]: arrows in the
// channel and near the obstacle; the shear stress along the obstacle between its bounds. The colour
// of a wall node says whether the fluid sticks or slips there.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fem/plots/gnuplot.hpp>
#include <fem/stokes_field.hpp>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace fem {

/// A part of the plane.
struct plot_window {
  Eigen::Vector2d lower;
  Eigen::Vector2d upper;
};

namespace detail {

/// At most one node per cell of a grid of columns × rows cells, the one nearest to its centre: as
/// many arrows as can be told apart, whatever the mesh.
[[nodiscard]] inline std::vector<Eigen::Index> thinned(Eigen::Matrix2Xd const& nodes,
                                                       plot_window const& window, int columns,
                                                       int rows) {
  std::vector<Eigen::Index> chosen(static_cast<std::size_t>(columns * rows), -1);
  std::vector<double> distance(chosen.size(), std::numeric_limits<double>::infinity());
  Eigen::Array2d const count(columns, rows);
  for (Eigen::Index node = 0; node < nodes.cols(); ++node) {
    Eigen::Array2d const at =
        (nodes.col(node) - window.lower).array() / (window.upper - window.lower).array() * count;
    if (!(at >= 0).all() || !(at < count).all()) continue;
    Eigen::Array2d const cell = at.floor();
    auto const number = static_cast<std::size_t>(cell[1] * columns + cell[0]);
    double const d = (at - cell - 0.5).matrix().norm();
    if (d >= distance[number]) continue;
    distance[number] = d;
    chosen[number] = node;
  }
  std::erase(chosen, -1);
  return chosen;
}

/// Arrows of the velocities in a window, the longest as long as two cells.
inline void add_arrows(std::ostringstream& out, char const* name, Eigen::Matrix2Xd const& nodes,
                       Eigen::Matrix2Xd const& velocity, plot_window const& window, int columns,
                       int rows) {
  auto const chosen = thinned(nodes, window, columns, rows);
  double fastest = 0;
  for (auto const node : chosen) fastest = std::max(fastest, velocity.col(node).norm());
  double const cell = (window.upper - window.lower)[0] / columns;
  double const scale = fastest > 0 ? 2 * cell / fastest : 0;
  out << name << " << EOD\n";
  for (auto const node : chosen) {
    Eigen::Vector2d const arrow = scale * velocity.col(node);
    out << nodes(0, node) << ' ' << nodes(1, node) << ' ' << arrow[0] << ' ' << arrow[1] << ' '
        << velocity.col(node).norm() << '\n';
  }
  out << "EOD\n";
}

/// Position in degrees around the centre, x, y, σ_t, its bounds and the state of each wall node,
/// sorted by the position.
inline void add_wall(std::ostringstream& out, stokes_scene const& scene, wall_field const& field) {
  Eigen::Vector2d centre(0, 0);
  for (auto const& at : scene.wall) centre += scene.mesh.nodes.col(at.node);
  centre /= static_cast<double>(scene.wall.size());
  std::vector<std::array<double, 7>> rows;
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    Eigen::Vector2d const x = scene.mesh.nodes.col(scene.wall[at].node);
    double const angle = std::atan2(x[1] - centre[1], x[0] - centre[0]) * 180 / std::numbers::pi;
    double const navier = field.shear[i] - field.friction[i];  // −κ u_t moves the bounds
    rows.push_back({angle, x[0], x[1], field.shear[i], navier + field.bound[i],
                    navier - field.bound[i], field.state[at] == wall_state::slip ? 1.0 : 0.0});
  }
  std::sort(rows.begin(), rows.end());
  out << "$wall << EOD\n";
  for (auto const& row : rows) {
    for (double const value : row) out << value << ' ';
    out << '\n';
  }
  out << "EOD\n";
}

/// The points of the wall in two colours, from two columns of $wall.
inline void plot_states(std::ostringstream& out, char const* columns, wall_field const& field) {
  out << ", $wall using " << columns << "($7==0 ? $" << (columns[0] == '2' ? 3 : 4)
      << " : NaN) with points pt 7 ps 1 lc rgb '#0072B2' title 'stick "
      << field.count(wall_state::stick) << "', $wall using " << columns << "($7==1 ? $"
      << (columns[0] == '2' ? 3 : 4)
      << " : NaN) with points pt 7 ps 1 lc rgb '#E69F00' title 'slip "
      << field.count(wall_state::slip) << "'\n";
}

}  // namespace detail

/// The gnuplot script of three panels: channel, surroundings of the obstacle, σ_t along it.
[[nodiscard]] inline std::string flow_script(std::filesystem::path const& picture,
                                             stokes_scene const& scene,
                                             stokes_solution const& solution,
                                             wall_field const& field, plot_window const& channel,
                                             plot_window const& near, std::string const& title) {
  auto const velocity = scene.velocity(solution.u);
  std::ostringstream out;
  out.precision(8);
  out << gnuplot_preamble(picture, {1300, 1000});
  detail::add_arrows(out, "$channel", scene.mesh.nodes, velocity, channel, 88, 16);
  detail::add_arrows(out, "$near", scene.mesh.nodes, velocity, near, 30, 30);
  detail::add_wall(out, scene, field);
  auto const range = [&](plot_window const& w) {
    out << "set xrange [" << w.lower[0] << ':' << w.upper[0] << "]\nset yrange [" << w.lower[1]
        << ':' << w.upper[1] << "]\n";
  };
  out << "set multiplot title " << gnuplot_string(title) << " font 'Sans Bold,16' noenhanced\n"
      << "set border 3 lc rgb '#888888'\nset tics nomirror tc rgb '#555555'\n"
      << "set palette defined (0 '#1B2A6B', 0.5 '#2A9D8F', 1 '#E9C46A')\n"
      << "set key noenhanced tc rgb '#222222' opaque\n"
      << "set origin 0,0.64\nset size 1,0.31\nset size ratio -1\n"
      << "set title 'Velocity in the channel' noenhanced\nset cblabel 'speed'\n";
  range(channel);
  out << "plot $channel using 1:2:3:4:5 with vectors head size screen 0.004,20 lw 1 lc palette "
         "notitle, $wall using 2:3 with points pt 7 ps 0.4 lc rgb '#444444' notitle\n"
      << "set origin 0,0\nset size 0.47,0.62\nset size ratio -1\nunset colorbox\n"
      << "set title 'Velocity near the obstacle' noenhanced\nset key top left\n";
  range(near);
  out << "plot $near using 1:2:3:4:5 with vectors head size screen 0.006,20 lw 1.3 lc palette "
         "notitle";
  detail::plot_states(out, "2:", field);
  out << "set origin 0.47,0\nset size 0.53,0.62\nset size noratio\nset key top right\n"
      << "set title 'Shear stress along the obstacle' noenhanced\n"
      << "set xlabel 'position on the obstacle, degrees from downstream' tc rgb '#555555'\n"
      << "set xrange [-180:180]\nset xtics 60\nset autoscale y\nset offsets 0,0,graph 0.35,graph "
         "0.05\nset grid ytics lt 1 lw 1 lc rgb '#E4E4E4'\n"
      << "plot ";
  if (field.bound.allFinite())
    out << "$wall using 1:5 with lines dt 2 lc rgb '#888888' title 'bounds', $wall using 1:6 with "
           "lines dt 2 lc rgb '#888888' notitle, ";
  out << "$wall using 1:4 with lines lw 1.5 lc rgb '#BBBBBB' title 'shear stress'";
  detail::plot_states(out, "1:", field);
  out << "unset multiplot\n";
  return out.str();
}

/// Draws the panels as a PNG.
[[nodiscard]] inline plot_result flow_plot(std::filesystem::path const& picture,
                                           stokes_scene const& scene,
                                           stokes_solution const& solution, wall_field const& field,
                                           plot_window const& channel, plot_window const& near,
                                           std::string const& title) {
  if (field.size() == 0) return {false, "no picture: there are no wall nodes"};
  return run_gnuplot(picture, flow_script(picture, scene, solution, field, channel, near, title));
}

}  // namespace fem
