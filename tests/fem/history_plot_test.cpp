// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fem/plots/history_plot.hpp>
#include <io/io_support.hpp>

namespace history_plot_test {

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("what a logarithmic axis cannot show is left out") {
  std::vector<fem::history_series> const series{
      {"first", {{0, 1}, {1, 0}, {2, std::nan("")}, {3, INFINITY}, {4, 1e-3}, {5, -1}}},
      {"nothing", {{0, 0}}}};
  auto const script = fem::history_script("h.png", series, {});
  CHECK(contains(script, "$series0 << EOD\n0 1\n4 0.001\nEOD\n"));
  CHECK(contains(script, "$series1 << EOD\nEOD\n"));
  CHECK(contains(script, "'first'"));
  CHECK_FALSE(contains(script, "'nothing'"));  // gnuplot refuses empty data
  CHECK(contains(script, "set yrange [1e-3:1e1]"));
}

TEST_CASE("Newton steps are stars in the colour of their curve") {
  std::vector<fem::history_series> const series{
      {"first", {{0, 1}, {4, 1e-3}}},
      {"second", {{0, 1}, {3, 0.5}, {9, 1e-5}}, {{0, 1}, {9, 1e-5}, {12, 0}}}};
  auto const script = fem::history_script("h.png", series, {});
  CHECK(contains(script, "$stars1 << EOD\n0 1\n9 1e-05\nEOD\n"));
  CHECK_FALSE(contains(script, "$stars0"));
  CHECK(contains(script, "$series1 using 1:2 with lines lw 2.5 dt 1 lc rgb '#D55E00'"));
  CHECK(contains(script,
                 "$stars1 using 1:2 with points pt 3 ps 1.6 lw 1.8 lc rgb '#D55E00' "
                 "title 'second: Newton steps'"));
  CHECK(contains(script, "set xrange [0:9.18]"));
}

TEST_CASE("values above the least one") {
  fem::history_series series{"q", {{0, -1}, {5, -3}}, {{5, -3}}};
  fem::subtract(series, -3.5);
  CHECK(series.points[0].residual == 2.5);
  CHECK(series.points[1].residual == 0.5);
  CHECK(series.newton_steps[0].residual == 0.5);
}

TEST_CASE("no curve, no picture, no error") {
  CHECK(fem::history_script("h.png", {}, {}).empty());
  CHECK_FALSE(fem::history_plot("h.png", {{"only zero", {{1, 0}}}}).written);
}

TEST_CASE("the history becomes a PNG where gnuplot is installed") {
  io_test::temporary_folder const folder;
  auto const result = fem::history_plot(
      folder / "h.png",
      {{"one", {{0, 1}, {10, 1e-8}}}, {"two_{x}", {{0, 1}, {20, 1e-6}}, {{20, 1e-6}}}},
      {.title = "it's a title"});
  CHECK(result.written == (io_test::get(folder / "h.png").starts_with("\x89PNG")));
  bool const missing = contains(result.message, "was not found");
  CHECK(result.written != missing);  // a script that gnuplot refuses is neither
}

}  // namespace history_plot_test
