// SPDX-License-Identifier: MIT
//
// The program membranes: values beside printed ones, files, statuses; and its file for ParaView,
// read back.
#include <fem/double_obstacle.hpp>
#include <fem/membrane_vtu.hpp>
#include <pugixml.hpp>
#include "run_program.hpp"

namespace membranes {
namespace {

using namespace examples_test;

/// The words of the line that begins with "nx × ny".
std::vector<std::string> row(std::string const& text, std::string const& grid) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    auto const begin = line.find(grid);
    if (begin == std::string::npos || line.find_first_not_of(' ') != begin) continue;
    std::istringstream words(line.substr(begin + grid.size()));
    std::vector<std::string> result;
    for (std::string next; words >> next;) result.push_back(next);
    return result;
  }
  return {};
}

/// A data array of points.
std::vector<double> point_data(pugi::xml_document const& file, char const* name) {
  auto const piece = file.child("VTKFile").child("UnstructuredGrid").child("Piece");
  std::istringstream text(
      piece.child("PointData").find_child_by_attribute("Name", name).child_value());
  std::vector<double> values;
  for (double value; text >> value;) values.push_back(value);
  return values;
}

}  // namespace

TEST_CASE("membranes: printed values beside ours, by both methods") {
  for (std::string const method : {"newton", "kprgp"}) {
    auto const ran = output_of("membranes", "--problem bearing --size 8 12 --method " + method);
    auto const words = row(ran, "8 × 12");
    REQUIRE(words.size() == 10);
    CHECK(std::stod(words[0]) == doctest::Approx(-0.1834372196).epsilon(1e-8));
    CHECK(words[1] + " " + words[2] == "-0.183437 PETSc");
    CHECK(words[3] + " " + words[4] + " " + words[5] == "36 60 0");  // lower, free, upper
    CHECK(words[9] == "converged");
    CHECK(contains(ran, "all problems converged\n"));
  }
}

TEST_CASE("membranes: all problems by nested iteration, and their files") {
  io_test::temporary_folder const folder;
  auto const output = folder / "new";
  auto const ran = output_of("membranes", "--size 40 --output " + word(output.string()));
  bool const drawn = has_gnuplot();
  for (std::string const name : {"torsion", "bearing", "lower_obstacle", "double_obstacle"}) {
    CHECK(contains(ran, name + ", newton by nested iteration\n"));
    CHECK(contains(io_test::get(output / (name + ".vtu")), "\"contact\""));
    CHECK(io_test::get(output / (name + ".png")).starts_with("\x89PNG") == drawn);
  }
  CHECK(row(ran, "10 × 10").size() == 9);
  CHECK(row(ran, "20 × 20").size() == 9);
  CHECK(row(ran, "40 × 40").size() == 9);
  CHECK(contains(ran, "no picture: ") == !drawn);
}

TEST_CASE("membranes: one grid from zero; not converged is not success") {
  auto const zero = run("membranes", "--problem torsion --twist 20 --size 20 --from-zero");
  CHECK(zero.status == 0);
  CHECK(row(zero.out, "10 × 10").empty());
  CHECK(row(zero.out, "20 × 20").size() == 9);
  check_failed("membranes", "--problem torsion --size 20 --max-iterations 1", "iteration_limit");
}

TEST_CASE("membranes refuses bad options in one line") {
  auto const check = [](auto const&... with) { check_refused("membranes", with...); };
  check("--problem drum", "--problem: got drum, expected torsion, bearing, lower_obstacle, double");
  check("--eccentricity 1", "--eccentricity: got 1, expected a number in (0, 1)");
  check("--twist -5", "--twist: got -5, expected a number > 0");
}

TEST_CASE("a membrane for ParaView: every node with its numbers, zero on the edges") {
  auto const m = fem::make_double_obstacle<>(3, 2);
  VectorXd const v = VectorXd::LinSpaced(6, 1, 6);
  fem::membrane_contact<> contact{Eigen::VectorXi::LinSpaced(6, 0, 5), 10 * v};
  contact.state.array() = contact.state.array().min(2) - 1;
  io_test::temporary_folder const folder;
  fem::write_membrane_vtu(folder / "m.vtu", m, v, contact, slant::vtu_encoding::ascii);
  pugi::xml_document file;
  REQUIRE(file.load_file((folder / "m.vtu").c_str()));
  auto const piece = file.child("VTKFile").child("UnstructuredGrid").child("Piece");
  CHECK(piece.attribute("NumberOfPoints").as_int() == 20);
  CHECK(piece.attribute("NumberOfCells").as_int() == 24);
  using list = std::vector<double>;
  CHECK(point_data(file, "height") ==
        list{0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 4, 5, 6, 0, 0, 0, 0, 0, 0});
  CHECK(point_data(file, "reaction") ==
        list{0, 0, 0, 0, 0, 0, 10, 20, 30, 0, 0, 40, 50, 60, 0, 0, 0, 0, 0, 0});
  CHECK(point_data(file, "contact") ==
        list{0, 0, 0, 0, 0, 0, -1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0});
}

}  // namespace membranes
