// SPDX-License-Identifier: MIT
//
// The folder of a contact problem: what is read, and every way in which it can be wrong.
#include <from_files/problem_folder.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace problem_folder_test {

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
  [[nodiscard]] from_files::problem read() const {
    return from_files::read_problem_folder(folder.path());
  }
  /// The refusal, without the name of the folder.
  [[nodiscard]] std::string refused() const {
    std::string const message = SLANT_COMPLAINT(read());
    std::string const root = folder.path().string() + "/";
    return message.starts_with(root) ? message.substr(root.size()) : message;
  }

  temporary_folder folder{};
};

/// The refusal of the problem with one file replaced.
std::string with(std::string_view name, std::string_view text) {
  problem const folder;
  folder.put(name, text);
  return folder.refused();
}

TEST_CASE("problem folder: friction in space") {
  auto const p = problem().read();
  Eigen::Matrix3d K;
  K << 4, -1, 0, -1, 4, -1, 0, -1, 4;
  CHECK(Eigen::Matrix3d(p.K) == K);
  CHECK(Eigen::RowVector3d(p.contact.N) == Eigen::RowVector3d(0, 0, -1));
  CHECK(Eigen::Matrix<double, 2, 3>(p.contact.T) == Eigen::Matrix<double, 2, 3>::Identity());
  CHECK(p.contact.f == Vector3d(1, 2, -3));
  CHECK(p.contact.d[0] == 0.5);
  CHECK(p.contact.g[0] == 0.3);
  CHECK(p.contact.nodes() == 1);
  CHECK(p.contact.tangents() == 2);
}

TEST_CASE("problem folder: friction in the plane, and none") {
  problem const folder;
  folder.put("T.mtx", coordinate + "1 3 1\n1 1 1\n");
  CHECK(folder.read().contact.tangents() == 1);
  folder.remove("T.mtx");
  folder.remove("g.txt");
  auto const contact = folder.read().contact;
  CHECK(contact.tangents() == 0);
  CHECK(contact.T.rows() == 0);
  CHECK(contact.T.cols() == 3);
  CHECK(contact.g.size() == 0);
}

TEST_CASE("problem folder: infinite gaps and slip bounds") {
  problem const folder;
  folder.put("d.txt", "inf\n");
  folder.put("g.txt", "Infinity\n");
  auto const contact = folder.read().contact;
  CHECK(contact.d[0] == std::numeric_limits<double>::infinity());
  CHECK(contact.g[0] == std::numeric_limits<double>::infinity());
  folder.put("d.txt", "-2.5\n");
  folder.put("g.txt", "0\n");
  CHECK(folder.read().contact.d[0] == -2.5);
  CHECK(folder.read().contact.g[0] == 0);
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
      ", expected a folder with K.mtx, N.mtx, f.txt, d.txt and, for friction, T.mtx, g.txt, or "
      "with W.mtx, q.txt, "
      "mu.txt";
  fs::path const none = empty / "none";
  CHECK(SLANT_COMPLAINT(from_files::read_problem_folder(none)) ==
        none.string() + ": got no such folder" + files);
  io_test::put(empty / "file", "1\n");
  CHECK(SLANT_COMPLAINT(from_files::read_problem_folder(empty / "file")) ==
        (empty / "file").string() + ": got not a folder" + files);
}

TEST_CASE("problem folder: sizes that disagree") {
  CHECK(with("K.mtx", coordinate + "2 3 1\n1 1 1\n") ==
        "columns of K: got 3, expected as many as rows, 2");
  CHECK(with("N.mtx", coordinate + "1 4 1\n1 4 1\n") ==
        "columns of N: got 4, expected the size of f, 3");
  CHECK(with("N.mtx", coordinate + "0 3 0\n") == "N: got 0, expected at least one row");
  CHECK(with("T.mtx", coordinate + "2 2 1\n1 1 1\n") ==
        "columns of T: got 2, expected the size of f, 3");
  CHECK(with("T.mtx", coordinate + "3 3 1\n1 1 1\n") ==
        "rows of T: got 3, expected 1 (2D) or 2 (3D)");
  CHECK(with("T.mtx", coordinate + "0 3 0\n") ==
        "rows of T: got 0, expected as many as N has, or twice that");
  CHECK(with("f.txt", "1\n2\n") ==
        "f.txt:3: got the end of the file after 2 numbers, expected 3 numbers");
  CHECK(with("f.txt", "1\n2\n3\n4\n") == "f.txt:4: got number 4, expected 3 numbers");
  CHECK(with("d.txt", "1\n2\n") == "d.txt:2: got number 2, expected 1 numbers");
  CHECK(with("g.txt", "1\n2\n") == "g.txt:2: got number 2, expected 1 numbers");
}

TEST_CASE("problem folder: values that cannot be") {
  CHECK(with("g.txt", "-0.5\n") == "g[0]: got -0.5, expected a number >= 0 or +inf");
  CHECK(with("g.txt", "-inf\n") == "g[0]: got -inf, expected a number >= 0 or +inf");
  CHECK(with("g.txt", "nan\n") == "g.txt:1: got 'nan', expected a number or inf");
  CHECK(with("d.txt", "-inf\n") == "d[0]: got -inf, expected a number or +inf");
  CHECK(with("f.txt", "1\ninf\n2\n") == "f.txt:2: got 'inf', expected a finite number");
}

TEST_CASE("problem folder: friction coefficients instead of slip bounds") {
  problem const folder;
  folder.remove("g.txt");
  folder.put("F.txt", "0.3\n");
  auto const p = from_files::read_coulomb_folder(folder.folder.path(), folder.folder / "F.txt");
  CHECK(p.F.size() == 1);
  CHECK(p.F[0] == 0.3);
  CHECK(p.body.contact.g[0] == 0);
  CHECK(p.body.contact.tangents() == 2);
  folder.put("F.txt", "inf\n");
  CHECK(SLANT_COMPLAINT(
            from_files::read_coulomb_folder(folder.folder.path(), folder.folder / "F.txt"))
            .ends_with("F.txt:1: got 'inf', expected a finite number"));
}

}  // namespace problem_folder_test
