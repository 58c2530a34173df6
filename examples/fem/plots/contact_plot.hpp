// SPDX-License-Identifier: MIT
//
// Three views of the contact side of a body, one above the other: pressure, friction with its
// directions, and the state of each node. Every node is drawn as the rectangle that belongs to it,
// so the picture shows the discrete solution and no interpolation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fem/contact_field.hpp>
#include <fem/plots/gnuplot.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace fem {

/// Words on a contact plot.
struct contact_labels {
  std::string title = "Contact stresses";
  std::string stress_unit = "MPa";
};

namespace detail {

/// Of the sorted distinct coordinates, every n-th, so that at most `most` remain; an arrow at each.
[[nodiscard]] inline std::vector<double> thinned(std::vector<double> values, std::size_t most) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::size_t const every = (values.size() + most - 1) / most;
  std::vector<double> result;
  for (std::size_t i = every / 2; i < values.size(); i += every) result.push_back(values[i]);
  return result;
}

/// Nodes as rows  x y left right bottom top pressure friction state at_bound,  then the arrows as
/// rows x y dx dy; points and arrows stand in the middle of the rectangles.
inline void write_contact_data(std::ostream& out, contact_field<3> const& field, double bound) {
  out << "$nodes << EOD\n";
  std::array<std::vector<double>, 2> coordinates;
  double spacing = INFINITY;
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    auto const& patch = field.patches[at];
    Eigen::Vector2d const middle = (patch.lower + patch.upper) / 2;
    out << middle[0] << ' ' << middle[1] << ' ' << patch.lower[0] << ' ' << patch.upper[0] << ' '
        << patch.lower[1] << ' ' << patch.upper[1] << ' ' << field.normal[i] << ' '
        << field.friction.col(i).norm() << ' ' << static_cast<int>(field.state[at]) << ' '
        << field.at_slip_bound[at] << '\n';
    for (std::size_t t = 0; t < 2; ++t)
      coordinates[t].push_back(patch.centre[static_cast<Eigen::Index>(t)]);
  }
  out << "EOD\n$arrows << EOD\n";
  std::array<std::vector<double>, 2> const kept{thinned(coordinates[0], 40),
                                                thinned(coordinates[1], 14)};
  for (auto const& values : kept)
    for (std::size_t i = 1; i < values.size(); ++i)
      spacing = std::fmin(spacing, values[i] - values[i - 1]);
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    auto const& centre = field.patches[at].centre;
    if (!std::binary_search(kept[0].begin(), kept[0].end(), centre[0]) ||
        !std::binary_search(kept[1].begin(), kept[1].end(), centre[1]))
      continue;
    Eigen::Vector2d const arrow = 0.75 * spacing / bound * field.friction.col(i);
    Eigen::Vector2d const middle = (field.patches[at].lower + field.patches[at].upper) / 2;
    Eigen::Vector2d const tail = middle - arrow / 2;
    out << tail[0] << ' ' << tail[1] << ' ' << arrow[0] << ' ' << arrow[1] << '\n';
  }
  out << "EOD\n";
}

}  // namespace detail

/// The gnuplot script of the three panels.
[[nodiscard]] inline std::string contact_script(std::filesystem::path const& picture,
                                                contact_field<3> const& field,
                                                contact_labels const& labels) {
  struct panel {
    std::string title;
    std::string palette;
    double largest;
    int column;
  };
  auto const positive = [](double value) { return value > 0 ? value : 1.0; };
  double const bound = positive(field.slip_bound.maxCoeff());
  std::array<panel, 2> const stresses{
      {{"Contact pressure [" + labels.stress_unit + "]",
        "0 '#F7FBFF', 1 '#C6DBEF', 2 '#6BAED6', 3 '#2171B5', 4 '#08306B'",
        positive(field.normal.maxCoeff()), 7},
       {"Friction on the body [" + labels.stress_unit + "], arrows: direction and size",
        "0 '#FFFCF7', 1 '#FDE6CB', 2 '#FBCB94', 3 '#F3A45C', 4 '#E07B39'",
        std::fmax(bound, field.friction.colwise().norm().maxCoeff()), 8}}};

  // Pixels: the panels keep the proportions of the contact side.
  constexpr int width = 1440;
  constexpr int left = 90;
  constexpr int panel_width = 1080;
  constexpr int head = 70;
  constexpr int above = 46;
  constexpr int below = 44;
  Eigen::Vector2d const extent = field.side.upper - field.side.lower;
  int const panel_height = std::clamp(
      static_cast<int>(std::lround(panel_width * extent[1] / extent[0])), 120, panel_width);
  int const height = head + 3 * (above + panel_height + below) + 30;
  auto const x = [&](double pixel) { return pixel / width; };
  auto const y = [&](double pixel) { return 1 - pixel / height; };

  std::ostringstream out;
  out.precision(8);
  out << gnuplot_preamble(picture, {width, height});
  detail::write_contact_data(out, field, bound);
  out << "set multiplot\n"
      << "set style fill solid 1.0 border rgb '#FFFFFF'\nunset key\nset tics out scale 0.4 "
         "nomirror\n"
      << "set border 15 lc rgb '#888888' front\nset tics tc rgb '#555555'\n"
      << "set ylabel 'y' norotate offset 1.5,0 tc rgb '#555555'\n"
      << "set lmargin at screen " << x(left) << "\nset rmargin at screen " << x(left + panel_width)
      << "\nset xrange [" << field.side.lower[0] << ':' << field.side.upper[0] << "]\nset yrange ["
      << field.side.lower[1] << ':'
      << field.side.upper[1]
      // What no rectangle covers belongs to fixed nodes.
      << "]\nset object 1 rectangle from graph 0,0 to graph 1,1 behind fs solid noborder "
         "fc rgb '#BDBDBD'\n"
      << "set label 1 " << gnuplot_string(labels.title) << " at screen " << x(left) << ", screen "
      << y(34) << " left noenhanced font 'Sans Bold,17' tc rgb '#222222'\n";

  int top = head + above;
  auto const place = [&](std::string const& title) {
    out << "set tmargin at screen " << y(top) << "\nset bmargin at screen " << y(top + panel_height)
        << "\nset label 2 " << gnuplot_string(title) << " at screen " << x(left) << ", screen "
        << y(top - 18) << " left noenhanced font 'Sans,14' tc rgb '#222222'\n";
    top += above + panel_height + below;
  };
  std::string const rectangles = "plot $nodes using 1:2:3:4:5:6:";

  for (panel const& p : stresses) {
    int const bar_top = top;
    place(p.title);
    out << "set palette defined (" << p.palette << ")\nset cbrange [0:" << p.largest
        << "]\nset cbtics tc rgb '#555555'\nset colorbox user origin " << x(left + panel_width + 30)
        << ',' << y(bar_top + panel_height) << " size " << x(22) << ','
        << static_cast<double>(panel_height) / height << " noborder\n"
        << rectangles << p.column << " with boxxyerror lc palette lw 0.4";
    if (p.column == 8)
      out << ", $arrows using 1:2:3:4 with vectors head size screen 0.004,25 filled lw 1.3 "
             "lc rgb '#2B1400'";
    out << "\nunset label 1\n";
  }

  struct shown_state {
    contact_state state;
    char const* name;
    char const* colour;
  };
  constexpr std::array<shown_state, 3> states{{{contact_state::open, "open", "#EDEDED"},
                                               {contact_state::stick, "stick", "#0072B2"},
                                               {contact_state::slip, "slip", "#E69F00"}}};
  int const key_x = left + panel_width + 40;
  int key_y = top + 22;
  place("State of the contact nodes");
  out << "unset colorbox\nset palette defined (0 '" << states[0].colour << "', 1 '"
      << states[1].colour << "', 2 '" << states[2].colour << "')\nset cbrange [0:2]\n"
      << "set xlabel 'x' tc rgb '#555555'\n";
  int label = 10;
  auto const key = [&](std::string const& text, std::string const& point) {
    out << "set label " << label++ << ' ' << gnuplot_string(text) << " at screen " << x(key_x)
        << ", screen " << y(key_y) << " left offset 1.5,0 tc rgb '#222222' point " << point << '\n';
    key_y += 30;
  };
  for (auto const& s : states)
    key(std::string(s.name) + "  " + std::to_string(field.count(s.state)),
        std::string("pt 5 ps 2.4 lc rgb '") + s.colour + "'");
  key("fixed end", "pt 5 ps 2.4 lc rgb '#BDBDBD'");
  key("open, and friction", "pt 7 ps 0.7 lc rgb '#E69F00'");
  key_y -= 8;
  out << "set label " << label++ << " 'at its bound' at screen " << x(key_x) << ", screen "
      << y(key_y) << " left offset 1.5,0 tc rgb '#222222'\n";
  out << rectangles << "9 with boxxyerror lc palette lw 0.4, "
      << "$nodes using ($9==0 && $10==1 ? $1 : NaN):2 with points pt 7 ps 0.7 lc rgb '#E69F00'\n"
      << "unset multiplot\n";
  return out.str();
}

/// Draws the three panels as a PNG.
[[nodiscard]] inline plot_result contact_plot(std::filesystem::path const& picture,
                                              contact_field<3> const& field,
                                              contact_labels const& labels = {}) {
  if (field.size() == 0) return {false, "no picture: there are no contact nodes"};
  return run_gnuplot(picture, contact_script(picture, field, labels));
}

}  // namespace fem
