// SPDX-License-Identifier: MIT
//
// Convergence histories: a residual, or q − min q, on a logarithmic scale against products with the
// operator; steps of Newton's method as stars on the curve of their inner iterations, as in the
// lecture's Figures 12 and 13.
#pragma once

#include <cmath>
#include <fem/plots/gnuplot.hpp>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace fem {

struct history_point {
  double products;
  double residual;
};

/// One curve. Stars need not be points of it: if only Newton steps are known, the curve connects
/// them.
struct history_series {
  std::string label;
  std::vector<history_point> points;
  std::vector<history_point> newton_steps{};
};

/// The values of all points less `least`: q − min q from values of q.
inline void subtract(history_series& series, double least) {
  for (auto* points : {&series.points, &series.newton_steps})
    for (auto& point : *points) point.residual -= least;
}

/// Words on a history plot.
struct history_labels {
  std::string title = "Convergence history";
  std::string horizontal = "products with the operator";
  std::string vertical = "relative residual";
};

/// The gnuplot script. Points that a logarithmic axis cannot show (zero, NaN, infinity) are left
/// out; empty if nothing is left.
[[nodiscard]] inline std::string history_script(std::filesystem::path const& picture,
                                                std::vector<history_series> const& series,
                                                history_labels const& labels) {
  // Okabe and Ito's colours, which stay distinct for colour-blind readers.
  static constexpr char const* colours[] = {"#0072B2", "#D55E00", "#009E73",
                                            "#CC79A7", "#E69F00", "#56B4E9"};
  std::ostringstream out;
  out.precision(10);
  out << gnuplot_preamble(picture, {1200, 720});
  double smallest = INFINITY;
  double largest = 0;
  double last = 0;
  // Writes a block of data; whether anything is in it.
  auto const block = [&](char const* name, std::size_t number,
                         std::vector<history_point> const& points) {
    out << '$' << name << number << " << EOD\n";
    bool any = false;
    for (auto const& [products, residual] : points) {
      if (!(residual > 0) || !std::isfinite(residual) || !std::isfinite(products)) continue;
      out << products << ' ' << residual << '\n';
      smallest = std::fmin(smallest, residual);
      largest = std::fmax(largest, residual);
      last = std::fmax(last, products);
      any = true;
    }
    out << "EOD\n";
    return any;
  };
  std::vector<std::size_t> shown;
  std::vector<std::size_t> starred;
  for (std::size_t s = 0; s < series.size(); ++s) {
    if (block("series", s, series[s].points)) shown.push_back(s);
    if (!series[s].newton_steps.empty() && block("stars", s, series[s].newton_steps))
      starred.push_back(s);
  }
  if (shown.empty() && starred.empty()) return {};
  out << "set lmargin 12\nset rmargin 4\nset tmargin 5\nset bmargin 4.5\n"
      << "set label 1 " << gnuplot_string(labels.title)
      << " at graph 0, graph 1.075 left noenhanced font 'Sans Bold,16' tc rgb '#222222'\n"
      << "set label 2 " << gnuplot_string(labels.vertical)
      << " at graph 0, graph 1.027 left noenhanced font 'Sans,12' tc rgb '#555555'\n"
      << "set xlabel " << gnuplot_string(labels.horizontal) << " noenhanced tc rgb '#555555'\n"
      << "set logscale y\nset format y '10^{%T}'\nset ytics tc rgb '#555555'\n"
      << "set xtics tc rgb '#555555' nomirror\nset ytics nomirror scale 0\nset xtics out scale "
         "0.5\n"
      << "set border 1 lc rgb '#888888'\n"
      << "set grid ytics lt 1 lw 1 lc rgb '#E4E4E4'\n"
      << "set xrange [0:" << (last > 0 ? 1.02 * last : 1) << "]\n"
      << "set yrange [1e" << std::floor(std::log10(smallest)) << ":1e"
      << std::ceil(std::log10(largest) + 0.05) << "]\n"
      << "set key top right Left reverse noenhanced samplen 2 spacing 1.3 tc rgb '#222222' "
         "opaque\n";
  if (shown.size() < 2 && starred.empty()) out << "unset key\n";
  char const* separator = "plot ";
  auto const draw = [&](char const* name, std::size_t number, std::string const& style,
                        std::string const& title) {
    out << separator << '$' << name << number << " using 1:2 with " << style << " lc rgb '"
        << colours[number % std::size(colours)] << "' title " << gnuplot_string(title);
    separator = ", \\\n     ";
  };
  for (std::size_t s : shown)
    draw("series", s, "lines lw 2.5 dt " + std::to_string(1 + s / std::size(colours)),
         series[s].label);
  for (std::size_t s : starred)
    draw("stars", s, "points pt 3 ps 1.6 lw 1.8", series[s].label + ": Newton steps");
  out << '\n';
  return out.str();
}

/// Draws the histories as a PNG.
[[nodiscard]] inline plot_result history_plot(std::filesystem::path const& picture,
                                              std::vector<history_series> const& series,
                                              history_labels const& labels = {}) {
  std::string const script = history_script(picture, series, labels);
  if (script.empty()) return {false, "no picture: the history has no positive finite residual"};
  return run_gnuplot(picture, script);
}

}  // namespace fem
