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

TEST_CASE("no curve, no picture, no error") {
  CHECK(fem::history_script("h.png", {}, {}).empty());
  CHECK_FALSE(fem::history_plot("h.png", {{"only zero", {{1, 0}}}}).written);
}

TEST_CASE("the history becomes a PNG where gnuplot is installed") {
  io_test::temporary_folder const folder;
  auto const result = fem::history_plot(
      folder / "h.png", {{"one", {{0, 1}, {10, 1e-8}}}, {"two_{x}", {{0, 1}, {20, 1e-6}}}},
      {.title = "it's a title"});
  CHECK(result.written == (io_test::get(folder / "h.png").substr(1, 3) == "PNG"));
  bool const missing = contains(result.message, "was not found");
  CHECK(result.written != missing);  // a script that gnuplot refuses is neither
}

}  // namespace history_plot_test
