// SPDX-License-Identifier: MIT
//
// Pictures: the script is well-formed and holds the numbers, and gnuplot, where it is installed,
// makes a PNG of it.
#include <fem/plots/contact_line_plot.hpp>
#include <fem/plots/gnuplot.hpp>
#include <fem/plots/history_plot.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace plots_test {

using io_test::temporary_folder;

bool contains(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("histories: what a logarithmic axis cannot show is left out; Newton steps are stars") {
  std::vector<fem::history_series> series{
      {"first", {{0, 1}, {1, 0}, {2, std::nan("")}, {3, INFINITY}, {4, 1e-3}, {5, -1}}},
      {"second", {{0, 1}, {3, 0.5}, {9, 1e-5}}, {{0, 1}, {9, 1e-5}, {12, 0}}},
      {"nothing", {{0, 0}}}};
  auto const script = fem::history_script("h.png", series, {});
  for (auto const* part :
       {"$series0 << EOD\n0 1\n4 0.001\nEOD\n", "$series2 << EOD\nEOD\n", "'first'",
        "$stars1 << EOD\n0 1\n9 1e-05\nEOD\n", "title 'second: Newton steps'"})
    CHECK(contains(script, part));
  CHECK_FALSE(contains(script, "'nothing'"));  // gnuplot refuses empty data
  CHECK_FALSE(contains(script, "$stars0"));
  fem::subtract(series[1], -3.5);
  CHECK(series[1].points[0].residual == 4.5);
  CHECK(series[1].newton_steps[0].residual == 4.5);
  CHECK(fem::history_script("h.png", {}, {}).empty());
  CHECK_FALSE(fem::history_plot("h.png", {{"only zero", {{1, 0}}}}).written);
}

TEST_CASE("histories become a PNG where gnuplot is installed, a field without nodes does not") {
  temporary_folder const folder;
  auto const h = fem::history_plot(
      folder / "h.png",
      {{"one", {{0, 1}, {10, 1e-8}}}, {"two_{x}", {{0, 1}, {20, 1e-6}}, {{20, 1e-6}}}},
      {.title = "it's a title"});
  CHECK(h.written == (io_test::get(folder / "h.png").starts_with("\x89PNG")));
  CHECK(h.written != contains(h.message, "was not found"));
  CHECK_FALSE(fem::contact_plot(folder / "d.png", fem::contact_field<2>{}).written);
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

TEST_CASE("the program runs in the folder of the picture, however that is called") {
  temporary_folder const folder;
  auto const odd = folder / "it's a $(folder)";
  std::filesystem::create_directory(odd);
  io_test::put(odd / "draw", "#!/bin/sh\ncat \"$1\" > drawn.png\n");
  std::filesystem::permissions(odd / "draw", std::filesystem::perms::owner_all);
  auto const result = fem::run_gnuplot(odd / "drawn.png", "content", (odd / "draw").string());
  CHECK(result.written);
  CHECK(io_test::get(odd / "drawn.png") == "content");
}

}  // namespace plots_test
