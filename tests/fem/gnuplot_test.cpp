// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fem/plots/gnuplot.hpp>
#include <io/io_support.hpp>

namespace gnuplot_test {

TEST_CASE("text becomes one gnuplot string, whatever it contains") {
  CHECK(fem::gnuplot_string("plain") == "'plain'");
  CHECK(fem::gnuplot_string("it's `rm` \"x\"") == "'it''s `rm` \"x\"'");
  CHECK(fem::gnuplot_string("two\nlines") == "'two lines'");
}

TEST_CASE("a missing gnuplot is a message, and the script is there") {
  io_test::temporary_folder const folder;
  io_test::put(folder / "a.png", "old picture");
  auto const result = fem::run_gnuplot(folder / "a.png", "plot x\n", "no-such-gnuplot");
  CHECK_FALSE(result.written);
  CHECK(result.message.find("no-such-gnuplot was not found") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
  CHECK(io_test::get(folder / "a.gp") == "plot x\n");
}

TEST_CASE("a failing program leaves no picture") {
  io_test::temporary_folder const folder;
  auto const result = fem::run_gnuplot(folder / "a.png", "plot x\n", "false");
  CHECK_FALSE(result.written);
  CHECK(result.message.find("status 1") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("a program that draws nothing is not believed") {
  io_test::temporary_folder const folder;
  CHECK_FALSE(fem::run_gnuplot(folder / "a.png", "plot x\n", "true").written);
}

TEST_CASE("the program runs in the folder of the picture, however that is called") {
  io_test::temporary_folder const folder;
  auto const odd = folder / "it's a $(folder)";
  std::filesystem::create_directory(odd);
  io_test::put(odd / "draw", "#!/bin/sh\ncat \"$1\" > drawn.png\n");
  std::filesystem::permissions(odd / "draw", std::filesystem::perms::owner_all);
  auto const result = fem::run_gnuplot(odd / "drawn.png", "content", (odd / "draw").string());
  CHECK(result.written);
  CHECK(io_test::get(odd / "drawn.png") == "content");
}

TEST_CASE("a folder that does not exist is a message") {
  io_test::temporary_folder const folder;
  auto const result = fem::run_gnuplot(folder / "none/a.png", "plot x\n", "true");
  CHECK_FALSE(result.written);
  CHECK(result.message.find("cannot write") != std::string::npos);
}

}  // namespace gnuplot_test
