// SPDX-License-Identifier: MIT
//
// Pictures: what runs gnuplot copes with names,
// and with programs that fail. That gnuplot makes a PNG of it is for tests/examples.
#include <fem/plots/gnuplot.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace plots_test {

using io_test::temporary_folder;
using test::contains;

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
