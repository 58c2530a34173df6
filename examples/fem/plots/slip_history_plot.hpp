// SPDX-License-Identifier: MIT
//
// What a contact side does in the course of a sequence of load steps, two views one above the
// other: the states of the nodes nearest to the middle line against place and time, and how much of
// the side is open, sticks and slips.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fem/contact_field.hpp>
#include <fem/plots/gnuplot.hpp>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace fem {

/// The contact side after a step.
struct slip_record {
  double time;
  std::vector<contact_state> state;  ///< of each contact node
};

namespace detail {

/// The contact nodes nearest to the middle line of the side; all of a body of the plane.
template <int D>
[[nodiscard]] std::vector<std::size_t> middle_nodes(contact_field<D> const& field) {
  auto const distance = [&](std::size_t i) {
    if constexpr (D == 2) {
      return 0.0;
    } else {
      double const middle = (field.side.lower[1] + field.side.upper[1]) / 2;
      return std::fabs(field.patches[i].centre[1] - middle);
    }
  };
  double least = INFINITY;
  for (std::size_t i = 0; i < field.patches.size(); ++i) least = std::fmin(least, distance(i));
  std::vector<std::size_t> nodes;
  double below = INFINITY;  // of two lines at the same distance one is enough
  for (std::size_t i = 0; i < field.patches.size(); ++i) {
    if (distance(i) > least * (1 + 1e-9) + 1e-12 * field.side.upper.norm()) continue;
    if constexpr (D == 3) {
      if (below == INFINITY) below = field.patches[i].centre[1];
      if (field.patches[i].centre[1] != below) continue;
    }
    nodes.push_back(i);
  }
  return nodes;
}

}  // namespace detail

/// The gnuplot script; the patches of `field` say where the nodes are.
template <int D>
[[nodiscard]] std::string slip_history_script(std::filesystem::path const& picture,
                                              contact_field<D> const& field,
                                              std::vector<slip_record> const& records,
                                              std::string const& title) {
  constexpr std::array<char const*, 3> names{"open", "stick", "slip"};
  constexpr std::array<char const*, 3> colours{"#EDEDED", "#0072B2", "#E69F00"};
  std::ostringstream out;
  out.precision(8);
  out << gnuplot_preamble(picture, {1200, 900}) << "$line << EOD\n";
  double before = 0;
  auto const nodes = detail::middle_nodes(field);
  for (auto const& r : records) {
    for (std::size_t const i : nodes) {
      auto const& patch = field.patches[i];
      out << (patch.lower[0] + patch.upper[0]) / 2 << ' ' << (before + r.time) / 2 << ' '
          << patch.lower[0] << ' ' << patch.upper[0] << ' ' << before << ' ' << r.time << ' '
          << static_cast<int>(r.state[i]) << '\n';
    }
    before = r.time;
  }
  out << "EOD\n$shares << EOD\n";
  double whole = 0;
  for (auto const& patch : field.patches) whole += patch.measure();
  before = 0;
  for (auto const& r : records) {
    std::array<double, 3> area{};
    for (std::size_t i = 0; i < r.state.size(); ++i) {
      area[static_cast<std::size_t>(r.state[i])] += field.patches[i].measure();
    }
    out << (before + r.time) / 2 << ' ' << before << ' ' << r.time << ' ' << area[2] / whole << ' '
        << (area[2] + area[1]) / whole << '\n';
    before = r.time;
  }
  out << "EOD\nset multiplot layout 2,1 title " << gnuplot_string(title)
      << " font 'Sans Bold,16' noenhanced\n"
      << "set border 15 lc rgb '#888888' front\nset tics out nomirror tc rgb '#555555'\n"
      << "set lmargin 12\nset rmargin 16\nset key outside right noenhanced tc rgb '#222222'\n"
      << "set xrange [0:" << before << "]\nset style fill solid 1.0 noborder\n"
      << "set title 'States along the " << (D == 2 ? "contact" : "middle line")
      << "' noenhanced\nset ylabel 'x' tc rgb '#555555'\n"
      << "set yrange [" << field.side.lower[0] << ':' << field.side.upper[0]
      << "]\nset object 1 rectangle from graph 0,0 to graph 1,1 behind fs solid noborder "
         "fc rgb '#BDBDBD'\n";
  char const* separator = "plot ";
  for (std::size_t s = 0; s < 3; ++s) {
    out << separator << "$line using 2:($7==" << s
        << " ? $1 : NaN):5:6:3:4 with boxxyerror lc rgb '" << colours[s] << "' title '" << names[s]
        << "'";
    separator = ", ";
  }
  out << "\nunset object 1\nset title 'Share of the contact side' noenhanced\n"
      << "set xlabel 'time' tc rgb '#555555'\nset ylabel 'area'\nset yrange [0:1]\n"
      << "plot $shares using 1:(0.5):2:3:5:(1) with boxxyerror lc rgb '" << colours[0]
      << "' title 'open', $shares using 1:(0.5):2:3:4:5 with boxxyerror lc rgb '" << colours[1]
      << "' title 'stick', $shares using 1:(0.5):2:3:(0):4 with boxxyerror lc rgb '" << colours[2]
      << "' title 'slip'\n"
      << "unset multiplot\n";
  return out.str();
}

/// Draws both views as a PNG.
template <int D>
[[nodiscard]] plot_result slip_history_plot(std::filesystem::path const& picture,
                                            contact_field<D> const& field,
                                            std::vector<slip_record> const& records,
                                            std::string const& title) {
  if (field.size() == 0 || records.empty()) {
    return {false, "no picture: there are no contact nodes or no steps"};
  }
  return run_gnuplot(picture, slip_history_script(picture, field, records, title));
}

}  // namespace fem
