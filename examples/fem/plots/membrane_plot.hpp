// SPDX-License-Identifier: MIT
//
// Two views of a membrane side by side: its height and where it touches which obstacle.
#pragma once

#include <algorithm>
#include <fem/membrane_contact.hpp>
#include <fem/plots/gnuplot.hpp>
#include <sstream>
#include <string>

namespace fem {

namespace detail {

/// Rows  x y height state  of the interior nodes, at most about `most` in each direction.
inline void write_membrane_data(std::ostream& out, membrane<> const& m, Eigen::VectorXd const& v,
                                membrane_contact<> const& contact, Eigen::Index most) {
  auto const& grid = m.grid;
  Eigen::Index const right = (grid.nx + most - 1) / most;
  Eigen::Index const up = (grid.ny + most - 1) / most;
  out << "$nodes << EOD\n";
  for (Eigen::Index j = up / 2; j < grid.ny; j += up) {
    for (Eigen::Index i = right / 2; i < grid.nx; i += right) {
      Eigen::Index const unknown = grid.unknown(i, j);
      out << grid.x(i) << ' ' << grid.y(j) << ' ' << v[unknown] << ' ' << contact.state[unknown]
          << '\n';
    }
    out << '\n';
  }
  out << "EOD\n";
}

}  // namespace detail

/// The gnuplot script of both views.
[[nodiscard]] inline std::string membrane_script(std::filesystem::path const& picture,
                                                 std::string const& title, membrane<> const& m,
                                                 Eigen::VectorXd const& v,
                                                 membrane_contact<> const& contact) {
  std::ostringstream out;
  out.precision(8);
  out << gnuplot_preamble(picture, {1280, 560});
  detail::write_membrane_data(out, m, v, contact, 200);
  out << "set multiplot layout 1,2 title " << gnuplot_string(title)
      << " noenhanced\nunset key\nset tics out nomirror tc rgb '#555555'\n"
      << "set border 15 lc rgb '#888888' front\n"
      << "set xlabel 'x' tc rgb '#555555'\nset ylabel 'y' norotate tc rgb '#555555'\n"
      << "set xrange [0:" << m.grid.width << "]\nset yrange [0:" << m.grid.height << "]\n"
      << "set object 1 rectangle from graph 0,0 to graph 1,1 behind fs solid noborder "
         "fc rgb '#FFFFFF'\n"
      << "set title 'Height' tc rgb '#222222'\n"
      << "set palette defined (0 '#F7FBFF', 1 '#C6DBEF', 2 '#6BAED6', 3 '#2171B5', 4 '#08306B')\n"
      << "plot $nodes using 1:2:3 with image\n"
      << "set title 'Contact: lower obstacle " << contact.count(membrane_state::on_lower)
      << ", none " << contact.count(membrane_state::free) << ", upper obstacle "
      << contact.count(membrane_state::on_upper) << " nodes' tc rgb '#222222'\n"
      << "set palette maxcolors 3 defined (-1 '#0072B2', 0 '#EDEDED', 1 '#E69F00')\n"
      << "set cbrange [-1.5:1.5]\n"
      << "set cbtics ('lower' -1, 'free' 0, 'upper' 1)\n"
      << "plot $nodes using 1:2:4 with image\nunset multiplot\n";
  return out.str();
}

/// Draws both views as a PNG.
[[nodiscard]] inline plot_result membrane_plot(std::filesystem::path const& picture,
                                               std::string const& title, membrane<> const& m,
                                               Eigen::VectorXd const& v,
                                               membrane_contact<> const& contact) {
  return run_gnuplot(picture, membrane_script(picture, title, m, v, contact));
}

}  // namespace fem
