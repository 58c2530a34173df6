// SPDX-License-Identifier: MIT
//
// The program coulomb: bodies pressed, dragged and released.
#include <pugixml.hpp>
#include "run_program.hpp"

namespace coulomb {
namespace {

using namespace examples_test;

/// A line of the table.
struct row {
  int step = 0;
  double press = 0, drag = 0;
  int open = 0, stick = 0, slip = 0, products = 0, steps = 0;
  std::string by{}, status{};

  bool operator==(row const&) const = default;
  [[nodiscard]] bool same_contacts(row const& other) const {
    return open == other.open && stick == other.stick && slip == other.slip;
  }
};

std::vector<row> rows_of(std::string const& out) {
  std::vector<row> rows;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line);
    row r;
    text >> r.step >> r.press >> r.drag >> r.open >> r.stick >> r.slip >> r.products >> r.steps >>
        r.by >> r.status;
    if (text) rows.push_back(r);
  }
  return rows;
}

/// The slip that the drag has left behind.
double left_behind(std::string const& out) {
  std::string const left = "left behind    by the drag: slip of ";
  REQUIRE(contains(out, left));
  return std::stod(out.substr(out.find(left) + left.size()));
}

/// All steps of a run that did what it should, each of these contacts counted once.
std::vector<row> check_run(std::string const& options, int steps, int contacts) {
  auto const ran = run("coulomb", options);
  CAPTURE(ran.out);
  CAPTURE(ran.err);
  CHECK(ran.status == 0);
  CHECK(ran.err == "");
  auto const rows = rows_of(ran.out);
  REQUIRE(rows.size() == static_cast<std::size_t>(steps));
  for (auto const& r : rows) {
    CHECK(r.status == "converged");
    CHECK(r.open + r.stick + r.slip == contacts);
  }
  return rows;
}

}  // namespace

TEST_CASE("coulomb: orthotropic friction on a brick, and the files") {
  io_test::temporary_folder const folder;
  auto const ran =
      output_of("coulomb", "--cells 2 --steps 2 --friction 0.3 --friction-across 0.5 --output " +
                               word(folder.path().string()));
  for (auto const* expected : {"in 6 load steps", "0.5 along y (orthotropic)", "144 tetrahedra",
                               "converged", "K was factored once"})
    CHECK(contains(ran, expected));
  for (auto const& r : rows_of(ran)) CHECK(r.by == "radii");
  // What the drag has left behind after it has gone: the path counts, that is what friction is.
  CHECK(left_behind(ran) > 0);
  auto const list = io_test::get(folder / "coulomb.pvd");
  CHECK(contains(list, "timestep=\"0.5\""));
  CHECK(contains(list, "coulomb_005.vtu"));
  CHECK(contains(io_test::get(folder / "coulomb_005.vtu"), "contact_state"));
}

TEST_CASE("coulomb: two plates, by two methods the same, and the files") {
  io_test::temporary_folder const folder;
  std::string const plates = "--model plates --cells 3 --steps 2 --friction 0.3";
  auto const rows = check_run(plates + " --output " + word(folder.path().string()), 6, 9);
  auto const again = check_run(plates + " --method radii", 6, 9);
  REQUIRE(again.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].by == "newton");
    CHECK(again[i].by == "radii");
    CHECK(rows[i].same_contacts(again[i]));
  }
  CHECK(rows[3].drag == 1);
  CHECK(rows[3].open > rows[1].open);  // its end is torn off
  CHECK(rows[3].slip > 0);

  pugi::xml_document file;
  REQUIRE(file.load_file((folder / "coulomb_005.vtu").c_str()));
  auto const piece = file.child("VTKFile").child("UnstructuredGrid").child("Piece");
  CHECK(piece.attribute("NumberOfPoints").as_int() == 2 * 10 * 4);
  CHECK(piece.attribute("NumberOfCells").as_int() == 2 * 2 * 9 * 3);
}

TEST_CASE("coulomb: friction from none to much, the same everywhere or not") {
  std::string const plates = "--model plates --cells 3 --steps 1 ";
  // Without friction all that touches slips.
  for (auto const& r : check_run(plates + "--friction 0", 3, 9)) CHECK(r.stick == 0);
  auto const uniform = check_run(plates + "--friction 1", 3, 9);
  auto const varied = check_run(plates + "--friction 1 --friction-variation 1", 3, 9);
  CHECK(uniform != varied);
  (void)check_run("--model bricks --cells 3 --steps 1 --friction 2 --friction-variation 0.5", 3, 9);
}

TEST_CASE("coulomb: where Newton's method fails the other one goes on") {
  std::string const plates = "--model plates --cells 3 --steps 1 --friction 10";
  auto const rows = check_run(plates, 3, 9);
  CHECK(rows[1].by == "radii");
  CHECK(rows[2].by == "newton");
  // Alone it says so, and the sequence ends.
  auto const alone = run("coulomb", plates + " --method newton");
  CHECK(alone.status == 1);
  CHECK(contains(alone.out, " -       -       - "));
  CHECK_FALSE(contains(alone.out, "radii"));
}

TEST_CASE("coulomb refuses bad options in one line") {
  auto const check = [](auto const&... with) { check_refused("coulomb", with...); };
  check("--friction inf", "--friction: got inf, expected a finite number >= 0");
  check("--friction-variation 1.5", "--friction-variation: got 1.5, expected a number in [0, 1]");
  check("--method cg", "--method: got cg, expected coulomb, newton or radii");
  check("--method newton --friction-across 0.2",
        "--method: got newton, expected coulomb or radii, as --friction-across is given");
  check("--model plates --friction-across 0.2",
        "--friction-across: got 0.2, expected nothing with --model plates");
}

}  // namespace coulomb
