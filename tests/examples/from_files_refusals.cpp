// SPDX-License-Identifier: MIT
//
// from_files on input that cannot be used: exit status 2, nothing on standard output, one line on
// standard error that says what is wrong, and no file written.
#include "problem_files.hpp"

namespace from_files_refusals {
namespace {

namespace fs = std::filesystem;
using namespace examples_test;

/// The small brick with one file replaced.
void check_file(std::string const& name, std::string const& text, std::string const& expected) {
  auto const files = small_brick();
  files.put(name, text);
  check_refusal(files, "", expected);
}

std::string numbers(int count, std::string const& number) {
  std::string text;
  for (int i = 0; i < count; ++i) text += number + "\n";
  return text;
}

/// The entries of 0.125 I of size 36.
std::string diagonal() {
  std::string text;
  for (int i = 1; i <= 36; ++i) {
    auto const place = std::to_string(i);
    text.append(place).append(" ").append(place).append(" 0.125\n");
  }
  return text;
}

}  // namespace

// What readers refuse is for tests/io and tests/from_files; here, that the program passes it on. The
// small brick has 36 unknowns and 6 contact nodes.
TEST_CASE("from_files refuses files that are damaged or do not fit together") {
  check_file("N.mtx", coordinate + "6 35 1\n1 1 1\n",
             "columns of N: got 35, expected the size of f, 36");
  check_file("f.txt", numbers(35, "1") + "nan\n", "f.txt:36: got 'nan', expected a finite number");
  check_file("g.txt", numbers(3, "1") + "-0.25\n1\n1\n",
             "g[3]: got -0.25, expected a number >= 0 or +inf");
  // Sizes that would need terabytes, and letters for a terminal.
  check_file("K.mtx", coordinate + "2000000000 2000000000 4000000000\n1 1 1\n", "K.mtx:2: got");
  check_file("K.mtx", "\x1b[2J evil\n", "K.mtx:1: got '\\x1b[2J evil'");
  auto const files = small_brick();
  files.put("N.mtx", coordinate + "6 36 1\n1 1 1\n");
  files.put("d.txt", numbers(4, "0") + "-0.25\n0\n");
  check_refusal(files, "", "d[4]: got -0.25, expected a number >= 0, since row 4 of N is zero");
}

TEST_CASE("from_files refuses K that is not symmetric or not definite") {
  check_file("K.mtx", coordinate + "2 2 3\n1 1 1\n2 2 1\n1 2 0.5\n", "f.txt:3: got number 3");
  problem_files const files;
  files.put("N.mtx", coordinate + "1 2 1\n1 1 1\n");
  files.put("f.txt", "1\n1\n");
  files.put("d.txt", "0\n");
  auto const with_K = [&](std::string const& K, std::string const& expected) {
    files.put("K.mtx", K);
    check_refusal(files, "", expected);
  };
  std::string const symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  with_K(coordinate + "2 2 3\n1 1 1\n2 2 1\n1 2 0.5\n", "expected a symmetric matrix");
  // The eigenvalues are 3 and −1; the second pivot is 1 − 2²/1 = −3.
  with_K(symmetric + "2 2 3\n1 1 1\n2 1 2\n2 2 1\n", "K: got pivot 1 (row ");
  // Singular: refused where a method is named that takes no such matrix.
  auto const singular = [&](std::string const& K, std::string const& expected) {
    files.put("K.mtx", K);
    check_refusal(files, "--method kprgp", expected);
  };
  singular(symmetric + "2 2 3\n1 1 1\n2 1 1\n2 2 1\n",
           "= 0, zero up to rounding: body 0 (unknowns 0 to 1) has 1 free motion, expected a "
           "symmetric positive definite matrix, with supports that hold every body");
  singular(symmetric + "2 2 1\n1 1 1\n", "= 0, zero up to rounding: body 1 (unknown 1) has 1 ");
  with_K(symmetric + "2 2 2\n1 1 1\n2 2 -1\n", ") = -1, expected a symmetric positive definite");
}

TEST_CASE("from_files refuses files that are missing or no text") {
  auto const files = small_brick();
  files.remove("K.mtx");
  check_refusal(files, "", "K.mtx: got no such file");
  std::filesystem::create_directory(files.input() / "K.mtx");
  check_refusal(files, "", "K.mtx: got a directory, expected a readable text file");
  check_file("d.txt", std::string(6, '\0'), "d.txt: got binary data");
  check_refusal(run("from_files", "/no/such/folder"),
                "/no/such/folder: got no such folder, expected a folder with K.mtx");
  // A name with a line feed still makes one line.
  check_refusal(run("from_files", "'no\nsuch\nfolder'"), "no\\x0asuch\\x0afolder");
}

TEST_CASE("from_files refuses options that make no sense") {
  auto const files = small_brick();
  auto const with = [&](std::string const& options, std::string const& expected) {
    check_refusal(files, options, expected);
  };
  for (std::string const value : {"1", "-1e-3", "nan", "inf", "abc", "''"})
    with("--tolerance=" + value, "expected a relative accuracy in [0, 1)");
  for (std::string const value : {"-1", "1.5", "many", "+-1", "+"})
    with("--max-iterations=" + value, "expected a whole number >= 0");
  with("--max-iterations 99999999999999999999",
       "got 99999999999999999999, expected a whole number >= 0, at most 9223372036854775807");
  with("--tolerance 1e-4000", "expected a relative accuracy in [0, 1), within the range of double");
  with("--method newton",
       "--method: got newton, expected one of symmetric_newton, interior_point, ");
  with("--start somewhere",
       "--start: got somewhere, expected automatic, zero, qpc or interior_point");
  with("--no-such-option", "argument: got --no-such-option, expected one of those that --help");
  with("another_folder", "argument: got another_folder, expected one of those that --help lists");
  with("--tolerance 1e-3 --tolerance 1e-4", "--tolerance: got 2 values, expected one");
  with("--method kprgp --method kprgp", "--method: got 2 values, expected one");
  check_refusal(run("from_files", ""), "DIR: got nothing, expected the folder");
  check_refusal(run("from_files", ". --tolerance"), "--tolerance: got nothing, expected one");
}

TEST_CASE("from_files refuses an output that cannot be written") {
  auto const files = small_brick();
  std::string const input = word(files.input().string());
  auto const with = [&](std::string const& output, std::string const& expected) {
    check_refusal(run("from_files", input + " --output " + output), expected);
  };
  io_test::temporary_folder const folder;
  io_test::put(folder / "file", "content\n");
  with(word((folder / "file").string()), "--output: got ");
  with(word((folder / "file/below").string()), "--output: got ");
  with("/dev/null", "--output: got /dev/null (Not a directory)");
  with("''", "--output: got nothing, expected a name");
  CHECK(io_test::get(folder / "file") == "content\n");

  // One of the two cannot be written: then neither is.
  std::filesystem::create_directories(files.output() / "lambda.txt");
  check_refusal(files.solve(), "lambda.txt: got a directory, expected a file name");
  CHECK(files.files_written() == 1);
}

TEST_CASE("from_files on a full disk leaves the earlier results as they were") {
  problem_files const files(fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift}));
  std::filesystem::create_directories(files.output());
  io_test::put(files.output() / "u.txt", "earlier\n");
  // One block of 512 or 1024 bytes per file: u.txt needs more than 3000. The signal is ignored, as
  // then the write fails the way it does on a full disk.
  auto const ran =
      run_command("ulimit -f 1; trap '' XFSZ; " + program("from_files") + " " +
                  word(files.input().string()) + " --output " + word(files.output().string()));
  check_refusal(ran, "writing " + (files.output() / "u.txt").string());
  CHECK(files.files_written() == 1);
  CHECK(io_test::get(files.output() / "u.txt") == "earlier\n");
}

TEST_CASE("from_files: refused is refused, no file or folder comes of it") {
  auto const files = small_brick();
  auto const with_output = [&](fs::path const& output, std::string const& rest) {
    return run_command(program("from_files") + " " + word(files.input().string()) + " --output " +
                       word(output.string()) + rest);
  };
  fs::path const deep = files.output() / "new/folder/";
  SUBCASE("the report has no room") {
    check_refusal(with_output(deep, " >/dev/full"), "standard output: got an error");
    CHECK(!fs::exists(files.output()));
  }
  SUBCASE("the report has no room, and there are earlier results") {
    fs::create_directories(files.output());
    io_test::put(files.output() / "u.txt", "earlier\n");
    check_refusal(with_output(files.output(), " >/dev/full"), "standard output: got an error");
    CHECK(files.files_written() == 1);
    CHECK(io_test::get(files.output() / "u.txt") == "earlier\n");
  }
  SUBCASE("K^-1 f overflows") {
    files.put("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n36 36 36\n" + diagonal());
    files.put("f.txt", numbers(36, "1e308"));
    check_refusal(with_output(deep, ""),
                  "f: got a load under which u[0] of K u = f is inf, expected");
    CHECK(!fs::exists(files.output()));
    fs::create_directories(files.output());
    check_refusal(with_output(deep, ""), "expected");
    CHECK(fs::exists(files.output()));
    CHECK(files.files_written() == 0);
  }
  SUBCASE("the folder can be created in part only") {
    check_refusal(with_output(deep / std::string(300, 'x'), ""), "--output: got ");
    CHECK(!fs::exists(files.output()));
  }
}

}  // namespace from_files_refusals
