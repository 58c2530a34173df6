// SPDX-License-Identifier: MIT
//
// The programs behind the tables of the documents: printed numbers, ours beside them, and the right
// status.
#include "run_program.hpp"

namespace table_programs {
namespace {

using namespace examples_test;

/// Is there a line with these words, in this order, at its beginning? Blanks do not count.
bool has_line(std::string const& text, std::string const& words) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::istringstream wanted(words);
    bool same = true;
    for (std::string word, cell; same && wanted >> word;) same = (cells >> cell) && cell == word;
    if (same) return true;
  }
  return false;
}

/// The number behind a caption.
double number_behind(std::string const& text, std::string const& caption) {
  auto const at = text.find(caption);
  REQUIRE(at != std::string::npos);
  double value = -1;
  std::istringstream(text.substr(at + caption.size())) >> value;
  return value;
}

}  // namespace

TEST_CASE("wire_tables: all tables of small meshes, and the printed active sets") {
  auto const ran = output_of("wire_tables", "--unknowns 64");
  CHECK(contains(ran, "all runs converged, to the printed active sets\n"));
  for (auto const* title : {"Table 4.1", "Table 4.2", "Table 4.3", "Table 4.4",
                            "Tables 4.5 and 4.8", "Table 4.6", "Table 4.7"})
    CHECK(contains(ran, title));
  CHECK(has_line(ran, "0 0.1 64 16:0/13:3 16:0/13:3 ×"));  // l = 0, g = 0.1, n = 64
  CHECK(has_line(ran, "0.3 64 14:2/9:7 14:2/9:7 5(6)"));   // g = 0.3 after QPC
  CHECK(has_line(ran, "64 243/9 128/10 137/11 910/12 425/13"));
}

TEST_CASE("wire_tables: one table only; not converged is not success") {
  auto const one = run("wire_tables", "--unknowns 32 --table 4.2");
  CHECK(one.status == 0);
  CHECK(contains(one.out, "Table 4.2"));
  CHECK_FALSE(contains(one.out, "Table 4.1"));
  check_failed("wire_tables", "--unknowns 32 --table 4.4 --max-iterations 3", "iteration_limit");
}

TEST_CASE("brick_tables: sizes and printed numbers of both documents") {
  auto const ran = output_of("brick_tables", "--cells 5 --load pull --tolerance 1e-3");
  CHECK(contains(ran, "load \"pull\""));
  CHECK_FALSE(contains(ran, "load \"press\""));
  CHECK(has_line(ran, "4 900/180 - - - 187 87/15"));
  CHECK(has_line(ran, "5 1620/270 796/16 182/14 802/10 - -"));
  CHECK(contains(ran, "all runs converged\n"));
}

TEST_CASE("two_bodies: both tables and their pictures") {
  io_test::temporary_folder const folder;
  auto const output = folder / "new";
  auto const ran = output_of(
      "two_bodies", "--plates 4 6 --bricks 3 --tolerance 1e-4 --output " + word(output.string()));
  CHECK(has_line(ran, "240/24"));
  CHECK(has_line(ran, "504/36"));
  CHECK(has_line(ran, "162/9"));
  CHECK(contains(ran, "all runs converged\n"));
  CHECK(std::filesystem::exists(output / "bricks_contact.png") == has_gnuplot());
}

TEST_CASE("decomposed_brick: the displacements of the whole brick, by both methods") {
  for (std::string const options :
       {"", " --frictionless", " --method smalse", " --frictionless --method smalse"}) {
    CAPTURE(options);
    auto const ran =
        output_of("decomposed_brick", "--cubes 2 1 1 --cells 2 --tolerance 1e-10" + options);
    CHECK(contains(ran, "status                 converged\n"));
    CHECK(number_behind(ran, "coarse problem") == 12);
    CHECK(number_behind(ran, "largest jump") <= 1e-8);
    double const difference = number_behind(ran, "beside the whole brick");
    CHECK(difference >= 0);
    CHECK(difference <= 1e-8);
  }
}

TEST_CASE("decomposed_brick: too few steps") {
  check_failed("decomposed_brick", "--cubes 2 1 1 --cells 2 --max-iterations 1", "iteration_limit");
}

TEST_CASE("stacked_bricks: a stack that stands, and loads without equilibrium") {
  io_test::temporary_folder const folder;
  auto const held =
      output_of("stacked_bricks", "--bricks 2 --cells 2 --output " + word(folder.path().string()));
  for (auto const* expected : {"load \"hold\"", "factors        2,", "status         converged",
                               "equilibrium", "of the projector"})
    CHECK(contains(held, expected));
  CHECK(contains(io_test::get(folder / "stack.vtu"), "contact_force"));
  for (auto const* load : {"lift", "tip"}) {
    CAPTURE(load);
    auto const ran = run("stacked_bricks", "--bricks 2 --cells 2 --load " + std::string(load));
    CHECK(ran.status == 1);
    CHECK(contains(ran.out, "unbounded: no solution: the energy falls for ever"));
    CHECK(contains(ran.out, "direction      K d = "));
  }
}

}  // namespace table_programs
