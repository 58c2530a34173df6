// SPDX-License-Identifier: MIT
//
// The contact side of a body of the plane, two views one above the other: pressure, and friction
// between its bounds, against the place. The colour of a node is its state.
#pragma once

#include <array>
#include <fem/contact_field.hpp>
#include <fem/plots/contact_plot.hpp>
#include <fem/plots/gnuplot.hpp>
#include <sstream>
#include <string>

namespace fem {

/// The gnuplot script of the two panels.
[[nodiscard]] inline std::string contact_script(std::filesystem::path const& picture,
                                                contact_field<2> const& field,
                                                contact_labels const& labels) {
  std::ostringstream out;
  out.precision(8);
  out << gnuplot_preamble(picture, {1200, 820}) << "$nodes << EOD\n";
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    out << field.patches[at].centre[0] << ' ' << field.normal[i] << ' ' << field.friction(0, i)
        << ' ' << field.slip_bound[i] << ' ' << static_cast<int>(field.state[at]) << '\n';
  }
  out << "EOD\nset multiplot layout 2,1 title " << gnuplot_string(labels.title)
      << " font 'Sans Bold,16' noenhanced\n"
      << "set border 3 lc rgb '#888888'\nset tics nomirror tc rgb '#555555'\n"
      << "set grid ytics lt 1 lw 1 lc rgb '#E4E4E4'\nset lmargin 14\nset rmargin 4\n"
      << "set key top right noenhanced tc rgb '#222222' opaque\nset xrange [" << field.side.lower[0]
      << ':' << field.side.upper[0] << "]\n";
  struct shown_state {
    contact_state state;
    char const* name;
    char const* colour;
  };
  constexpr std::array<shown_state, 3> states{{{contact_state::open, "open", "#999999"},
                                               {contact_state::stick, "stick", "#0072B2"},
                                               {contact_state::slip, "slip", "#E69F00"}}};
  auto const points = [&](int column) {
    for (auto const& s : states)
      out << ", $nodes using 1:($5==" << static_cast<int>(s.state) << " ? $" << column
          << " : NaN) with points pt 7 ps 0.8 lc rgb '" << s.colour << "' title '" << s.name << ' '
          << field.count(s.state) << "'";
    out << '\n';
  };
  out << "set title 'Contact pressure [" << labels.stress_unit
      << "]' noenhanced\nplot $nodes using 1:2 with lines lw 1.5 lc rgb '#BBBBBB' notitle";
  points(2);
  out << "set title 'Friction on the (first) body [" << labels.stress_unit
      << "]' noenhanced\nset xlabel 'x' tc rgb '#555555'\n"
      << "plot $nodes using 1:4 with lines dt 2 lc rgb '#888888' title 'slip bound', "
         "$nodes using 1:(-$4) with lines dt 2 lc rgb '#888888' notitle, "
         "$nodes using 1:3 with lines lw 1.5 lc rgb '#BBBBBB' notitle";
  points(3);
  out << "unset multiplot\n";
  return out.str();
}

/// Draws the two panels as a PNG.
[[nodiscard]] inline plot_result contact_plot(std::filesystem::path const& picture,
                                              contact_field<2> const& field,
                                              contact_labels const& labels = {}) {
  if (field.size() == 0) return {false, "no picture: there are no contact nodes"};
  return run_gnuplot(picture, contact_script(picture, field, labels));
}

}  // namespace fem
