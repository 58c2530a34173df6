// SPDX-License-Identifier: MIT
//
// Friction problems as folders: what is read and written, and every way in which it can be wrong.
#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>

#include <support/folders.hpp>
#include <support/testing.hpp>
#include "io_support.hpp"

namespace friction_folder_test {

using io_test::temporary_folder;

std::string const coordinate = "%%MatrixMarket matrix coordinate real general\n";

/// One contact in space, or what is made of it.
struct one_contact {
  one_contact() {
    put("W.mtx", coordinate + "3 3 4\n1 1 2\n2 2 1\n3 3 1\n1 2 0.5\n");
    put("q.txt", "-1\n2\n3\n");
    put("mu.txt", "0.5\n");
  }
  void put(std::string_view name, std::string_view text) const {
    io_test::put(folder / name, text);
  }
  [[nodiscard]] auto read(slant::friction_folder_options const& options = {}) const {
    return slant::read_friction_problem(folder.path(), options);
  }
  /// The refusal, without the name of the folder.
  [[nodiscard]] std::string refused(slant::friction_folder_options const& options = {}) const {
    std::string const message = SLANT_COMPLAINT(read(options));
    std::string const root = folder.path().string() + "/";
    return message.starts_with(root) ? message.substr(root.size()) : message;
  }
  temporary_folder folder{};
};

std::string refused_with(std::string_view name, std::string_view text) {
  one_contact const files;
  files.put(name, text);
  return files.refused();
}

TEST_CASE("friction folder: the texts of its files, without a file") {
  std::string const W = coordinate + "3 3 2\n1 1 2\n3 3 1\n";
  auto const p = slant::parse_friction_problem({W, "-1\n2\n3\n", "0.5\n"}, "box");
  CHECK(p.W.coeff(2, 2) == 1);
  CHECK(p.q == Vector3d(-1, 2, 3));
  CHECK(SLANT_COMPLAINT(slant::parse_friction_problem({W, "-1\n2\n3\n", "-1\n"}, "box")) ==
        "box/mu.txt: got -1 of contact 0, expected a number >= 0");
  // Six bytes follow the sizes.
  CHECK(
      SLANT_COMPLAINT(slant::parse_friction_problem({coordinate + "30 30 1\n1 1 2\n", "1\n", "1\n"},
                                                    "box", {.W = {.unbacked_dimension = 2}})) ==
      "box/W.mtx:2: got '30', expected a number of rows from 0 to 6");
}

TEST_CASE("friction folder: the dimension follows from the sizes") {
  one_contact const files;
  auto const p = files.read();
  CHECK(p.dimension() == 3);
  CHECK(p.contacts() == 1);
  CHECK(p.W.coeff(0, 1) == 0.5);
  CHECK(p.W.coeff(1, 0) == 0);
  CHECK(p.q == Vector3d(-1, 2, 3));
  CHECK(p.mu[0] == 0.5);

  files.put("W.mtx", coordinate + "2 2 1\n1 1 2\n");
  files.put("q.txt", "-1\n2\n");
  CHECK(files.read().dimension() == 2);
  // 6 numbers are three contacts in the plane or two in space.
  files.put("W.mtx", coordinate + "6 6 0\n");
  files.put("q.txt", "1\n2\n3\n4\n5\n6\n");
  files.put("mu.txt", "0\n0\n0\n");
  CHECK(files.read().dimension() == 2);
  files.put("mu.txt", "0\n0\n");
  CHECK(files.read().dimension() == 3);
}

TEST_CASE("friction folder: refusals name the file, the value and what was expected") {
  CHECK(refused_with("q.txt", "1\n2\n3\n4\n") ==
        "q.txt: got 4 numbers, expected 2 (in the plane) or 3 (in space), for mu.txt has 1");
  CHECK(refused_with("mu.txt", "1\n2\n") ==
        "q.txt: got 3 numbers, expected 4 (in the plane) or 6 (in space), for mu.txt has 2");
  CHECK(refused_with("W.mtx", coordinate + "3 2 1\n1 1 2\n") ==
        "W.mtx: got 3 rows and 2 columns, expected 3 of both, as many as numbers in q.txt");
  CHECK(refused_with("mu.txt", "-0.5\n") ==
        "mu.txt: got -0.5 of contact 0, expected a number >= 0");
  CHECK(refused_with("mu.txt", "# none\n") ==
        "mu.txt: got no number, expected one for each contact");
  CHECK(refused_with("W.mtx", coordinate + "3 3 1\n1 1 x\n") ==
        "W.mtx:3: got 'x', expected a finite number");
  for (std::string const name : {"W.mtx", "q.txt", "mu.txt"}) {
    one_contact const files;
    std::filesystem::remove(files.folder / name);
    CHECK(files.refused() == name + ": got no such file, expected a readable text file");
  }
  temporary_folder const empty;
  CHECK(SLANT_COMPLAINT(slant::read_friction_problem(empty / "none")) ==
        (empty / "none").string() +
            ": got no folder, expected a folder with W.mtx, q.txt and mu.txt");
}

TEST_CASE("friction folder: W that is not symmetric is taken as it is, or refused if asked") {
  one_contact const files;
  CHECK(slant::contact::asymmetry(files.read().W) == 0.25);
  slant::friction_folder_options const strict{.asymmetry =
                                                  slant::contact::asymmetric_data::refused};
  CHECK(files.refused(strict).starts_with(
      "W.mtx: got a matrix of asymmetry 0.25, expected a symmetric one, max |W - W^T| <= "));
  files.put("W.mtx", coordinate + "3 3 3\n1 1 2\n1 2 0.5\n2 1 0.5\n");
  CHECK(files.read(strict).W.nonZeros() == 3);
}

TEST_CASE("friction folder: what is written reads back to the same bits") {
  auto const p = slant::read_friction_problem(test::data("friction/Rover4609"));
  temporary_folder const folder;
  slant::write_friction_problem(folder.path(), p);
  auto const again = slant::read_friction_problem(folder.path());
  CHECK(MatrixXd(again.W) == MatrixXd(p.W));
  CHECK(again.q == p.q);
  CHECK(again.mu == p.mu);
}

TEST_CASE("friction folder: problems from simulations") {
  // W = I, q = (−1, 1, 3), μ = 0.1 three times: slip along (1, 3).
  auto const p = slant::read_friction_problem(test::data("friction/FC3D_Example1"));
  CHECK(p.contacts() == 3);
  CHECK(p.dimension() == 3);
  VectorXd r(9);
  for (int i = 0; i < 3; ++i) r.segment(3 * i, 3) << 1, -0.1 / std::sqrt(10), -0.3 / std::sqrt(10);
  CHECK(slant::contact::verify(p, r).relative_natural_map < 1e-15);
  CHECK(slant::contact::verify(p, r).slip == 3);

  auto const rover = slant::read_friction_problem(test::data("friction/Rover4396"));
  CHECK(rover.contacts() == 2);
  CHECK(slant::contact::asymmetry(rover.W) > 1e-6);
  CHECK(slant::contact::asymmetry(rover.W) < 1e-4);
}

}  // namespace friction_folder_test
