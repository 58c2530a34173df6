// SPDX-License-Identifier: MIT
//
// Pictures: the script holds the numbers that an axis can show; what runs gnuplot copes with names,
// and with programs that fail. That gnuplot makes a PNG of it is for tests/examples.
#include <fem/plots/gnuplot.hpp>
#include <fem/plots/history_plot.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace plots_test {

using io_test::temporary_folder;
using test::contains;

TEST_CASE("histories: what a logarithmic axis cannot show is left out; Newton steps are stars") {
  std::vector<fem::history_series> series{
      {"first", {{0, 1}, {1, 0}, {2, std::nan("")}, {3, INFINITY}, {4, 1e-3}, {5, -1}}},
      {"second", {{0, 1}, {3, 0.5}, {9, 1e-5}}, {{0, 1}, {9, 1e-5}, {12, 0}}},
      {"nothing", {{0, 0}}}};
  auto const script = fem::history_script("h.png", series, {});
  CHECK(contains(script, "$series0 << EOD\n0 1\n4 0.001\nEOD\n"));
  CHECK(contains(script, "$stars1 << EOD\n0 1\n9 1e-05\nEOD\n"));
  CHECK_FALSE(contains(script, "'nothing'"));  // gnuplot refuses empty data
  fem::subtract(series[1], -3.5);
  CHECK(series[1].points[0].residual == 4.5);
  CHECK(series[1].newton_steps[0].residual == 4.5);
  CHECK(fem::history_script("h.png", {}, {}).empty());
  CHECK_FALSE(fem::history_plot("h.png", {{"only zero", {{1, 0}}}}).written);
}

TEST_CASE("text becomes one gnuplot string, whatever it contains") {
  CHECK(fem::gnuplot_string("plain") == "'plain'");
  CHECK(fem::gnuplot_string("it's `rm` \"x\"") == "'it''s `rm` \"x\"'");
  CHECK(fem::gnuplot_string("two\nlines") == "'two lines'");
}

TEST_CASE(
    "a gnuplot that is missing, fails or draws nothing is a message, and the script is there") {
  temporary_folder const folder;
  for (auto const& [program, message] :
       {std::pair{"no-such-gnuplot", "no-such-gnuplot was not found"},
        {"false", "status 1"},
        {"true", ""}}) {
    io_test::put(folder / "a.png", "old picture");
    auto const result = fem::run_gnuplot(folder / "a.png", "plot x\n", program);
    CHECK_FALSE(result.written);
    CHECK(contains(result.message, message));
    CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
    CHECK(io_test::get(folder / "a.gp") == "plot x\n");
  }
  CHECK(contains(fem::run_gnuplot(folder / "none/a.png", "plot x\n", "true").message,
                 "cannot write"));
}

}  // namespace plots_test
