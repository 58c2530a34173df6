// SPDX-License-Identifier: MIT
//
// The folder of a contact problem: what is read, and every way in which it can be wrong.
#include <doctest/doctest.h>

#include <from_files/problem_folder.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "io_support.hpp"

namespace {

using io_test::refusal;
using io_test::temporary_folder;
namespace fs = std::filesystem;

std::string const coordinate = "%%MatrixMarket matrix coordinate real general\n";

/// Three unknowns, one contact node, friction in space.
class problem {
 public:
  problem() {
    put("K.mtx",
        "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 4\n2 1 -1\n2 2 4\n"
        "3 2 -1\n3 3 4\n");
    put("N.mtx", coordinate + "1 3 1\n1 3 -1\n");
    put("T.mtx", coordinate + "2 3 2\n1 1 1\n2 2 1\n");
    put("f.txt", "1\n2\n-3\n");
    put("d.txt", "0.5\n");
    put("g.txt", "0.3\n");
  }
  void put(std::string_view name, std::string_view text) const {
    io_test::put(folder / name, text);
  }
  void remove(std::string_view name) const { fs::remove(folder / name); }
  [[nodiscard]] from_files::contact_data read() const {
    return from_files::read_problem_folder(folder.path());
  }
  /// The refusal, without the name of the folder.
  [[nodiscard]] std::string refused() const {
    std::string const message = refusal([&] { (void)read(); });
    std::string const root = folder.path().string() + "/";
    return message.starts_with(root) ? message.substr(root.size()) : message;
  }

  temporary_folder folder{};
};

}  // namespace

TEST_CASE("problem folder: friction in space") {
  auto const data = problem().read();
  Eigen::Matrix3d K;
  K << 4, -1, 0, -1, 4, -1, 0, -1, 4;
  CHECK(Eigen::Matrix3d(data.K) == K);
  CHECK(Eigen::RowVector3d(data.N) == Eigen::RowVector3d(0, 0, -1));
  CHECK(Eigen::Matrix<double, 2, 3>(data.T) == Eigen::Matrix<double, 2, 3>::Identity());
  CHECK(data.f == Eigen::Vector3d(1, 2, -3));
  CHECK(data.d[0] == 0.5);
  CHECK(data.g[0] == 0.3);
  CHECK(data.has_friction);
  CHECK(data.tangent_dimension == 2);
}

TEST_CASE("problem folder: friction in the plane, and none") {
  problem const folder;
  folder.put("T.mtx", coordinate + "1 3 1\n1 1 1\n");
  CHECK(folder.read().tangent_dimension == 1);
  folder.remove("T.mtx");
  folder.remove("g.txt");
  auto const data = folder.read();
  CHECK_FALSE(data.has_friction);
  CHECK(data.tangent_dimension == 0);
  CHECK(data.T.rows() == 0);
  CHECK(data.T.cols() == 3);
  CHECK(data.g.size() == 0);
}

TEST_CASE("problem folder: infinite gaps and slip bounds") {
  problem const folder;
  folder.put("d.txt", "inf\n");
  folder.put("g.txt", "Infinity\n");
  auto const data = folder.read();
  CHECK(data.d[0] == std::numeric_limits<double>::infinity());
  CHECK(data.g[0] == std::numeric_limits<double>::infinity());
  folder.put("d.txt", "-2.5\n");
  folder.put("g.txt", "0\n");
  CHECK(folder.read().d[0] == -2.5);
  CHECK(folder.read().g[0] == 0);
}

TEST_CASE("problem folder: files that are missing") {
  for (std::string const name : {"K.mtx", "N.mtx", "f.txt", "d.txt"}) {
    problem const folder;
    folder.remove(name);
    CHECK(folder.refused() == name + ": got no such file, expected a readable text file");
  }
  problem const without_g;
  without_g.remove("g.txt");
  CHECK(without_g.refused() ==
        "g.txt: got no such file, expected slip bounds, since T.mtx is there");
  problem const without_T;
  without_T.remove("T.mtx");
  CHECK(without_T.refused() ==
        "T.mtx: got no such file, expected tangential displacements, since g.txt is there");
  // A dangling link is a mistake, not the absence of friction.
  without_T.remove("g.txt");
  fs::create_symlink("nowhere", without_T.folder / "T.mtx");
  fs::create_symlink("nowhere", without_T.folder / "g.txt");
  CHECK(without_T.refused() == "T.mtx: got no such file, expected a readable text file");

  temporary_folder const empty;
  std::string const files =
      ", expected a folder with K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx, g.txt";
  fs::path const none = empty / "none";
  CHECK(refusal([&] { (void)from_files::read_problem_folder(none); }) ==
        none.string() + ": got no such folder" + files);
  io_test::put(empty / "file", "1\n");
  CHECK(refusal([&] { (void)from_files::read_problem_folder(empty / "file"); }) ==
        (empty / "file").string() + ": got not a folder" + files);
}

TEST_CASE("problem folder: sizes that disagree") {
  auto const with = [](std::string_view name, std::string_view text) {
    problem const folder;
    folder.put(name, text);
    return folder.refused();
  };
  CHECK(with("K.mtx", coordinate + "2 3 1\n1 1 1\n") ==
        "K.mtx: got 2 x 3, expected a square matrix, at least 1 x 1");
  CHECK(with("K.mtx", coordinate + "0 0 0\n") ==
        "K.mtx: got 0 x 0, expected a square matrix, at least 1 x 1");
  CHECK(with("N.mtx", coordinate + "1 4 1\n1 4 1\n") ==
        "N.mtx: got 4 columns, expected 3, the number of unknowns (rows of K.mtx)");
  CHECK(with("N.mtx", coordinate + "0 3 0\n") ==
        "N.mtx: got 0 rows, expected at least one row: a contact node");
  CHECK(with("T.mtx", coordinate + "2 2 1\n1 1 1\n") ==
        "T.mtx: got 2 columns, expected 3, the number of unknowns (rows of K.mtx)");
  CHECK(with("T.mtx", coordinate + "3 3 1\n1 1 1\n") ==
        "T.mtx: got 3 rows, expected 1 (plane) or 2 (space), since N.mtx has 1");
  CHECK(with("T.mtx", coordinate + "0 3 0\n") ==
        "T.mtx: got 0 rows, expected 1 (plane) or 2 (space), since N.mtx has 1");
  CHECK(with("f.txt", "1\n2\n") ==
        "f.txt:3: got the end of the file after 2 numbers, expected 3 numbers");
  CHECK(with("f.txt", "1\n2\n3\n4\n") == "f.txt:4: got number 4, expected 3 numbers");
  CHECK(with("d.txt", "1\n2\n") == "d.txt:2: got number 2, expected 1 numbers");
  CHECK(with("g.txt", "1\n2\n") == "g.txt:2: got number 2, expected 1 numbers");
}

TEST_CASE("problem folder: values that cannot be") {
  auto const with = [](std::string_view name, std::string_view text) {
    problem const folder;
    folder.put(name, text);
    return folder.refused();
  };
  CHECK(with("g.txt", "-0.1\n") ==
        "g.txt: got -0.10000000000000001 as number 1, expected slip bounds >= 0");
  CHECK(with("g.txt", "-inf\n") == "g.txt: got -inf as number 1, expected slip bounds >= 0");
  CHECK(with("g.txt", "nan\n") == "g.txt:1: got 'nan', expected a number or inf");
  CHECK(with("d.txt", "-inf\n") == "d.txt: got -inf as number 1, expected gaps above -inf");
  CHECK(with("f.txt", "1\ninf\n2\n") == "f.txt:2: got 'inf', expected a finite number");
  CHECK(with("f.txt", "1\n2\n3") ==
        "f.txt:3: got '3' and the end of the file, expected a line feed at the end of the last "
        "line (truncated file?)");
  CHECK(with("N.mtx", coordinate + "1 3 1\n1 3 nan\n") ==
        "N.mtx:3: got 'nan', expected a finite number");
  CHECK(with("K.mtx", "not a matrix\n") ==
        "K.mtx:1: got 'not a matrix', expected a first line like '%%MatrixMarket matrix coordinate "
        "real general'");
  CHECK(with("K.mtx", coordinate + "3 3 3\n1 1 1\n2 2 -2\n3 3 1\n") ==
        "K.mtx: got K(2,2) = -2, expected a positive diagonal, since K is positive definite");
  CHECK(with("K.mtx", coordinate + "3 3 2\n1 1 1\n3 3 1\n") ==
        "K.mtx: got K(2,2) = 0, expected a positive diagonal, since K is positive definite");
}

TEST_CASE("problem folder: K must be symmetric up to rounding, in any units") {
  for (std::string const unit : {"", "e-12", "e12", "e150", "e-150"}) {
    problem const folder;
    auto const K = [&](std::string const& upper, std::string const& lower) {
      folder.put("K.mtx", coordinate + "3 3 5\n1 1 4" + unit + "\n2 2 4" + unit + "\n3 3 4" + unit +
                              "\n1 2 " + upper + unit + "\n2 1 " + lower + unit + "\n");
    };
    K("-1", "-1.00000000000001");
    auto const data = folder.read();
    CHECK(data.K.coeff(0, 1) == data.K.coeff(1, 0));
    CHECK(data.K.coeff(0, 1) == doctest::Approx(-std::stod("1" + unit)).epsilon(1e-13));
    K("-1", "-1.0000000001");
    CHECK(folder.refused().find("expected a symmetric matrix up to rounding") != std::string::npos);
  }
  problem const folder;
  folder.put("K.mtx", coordinate + "3 3 6\n1 1 4\n2 2 4\n3 3 4\n1 2 0.5\n2 1 0.25\n1 3 0.75\n");
  CHECK(folder.refused() ==
        "K.mtx: got K(3,1) = 0 and K(1,3) = 0.75, expected a symmetric matrix up to rounding (this "
        "is the worst entry)");
}
