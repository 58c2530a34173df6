// SPDX-License-Identifier: MIT
//
// Whole files, their lines and words.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <slant/io/text_scanner.hpp>
#include <string>

#include "io_support.hpp"
#include "support/message.hpp"

namespace text_scanner_test {

using io_test::put;
using io_test::temporary_folder;
using slant::detail::line_scanner;
using slant::detail::read_text_file;
using test::complaint;

TEST_CASE("text file: content as it is") {
  temporary_folder const folder;
  std::string text = "first\r\n\tsecond \xc3\xa9\n";
  put(folder / "a.txt", text);
  CHECK(read_text_file(folder / "a.txt") == text);
  text.assign(std::size_t{9} << 20, 'x');  // more than two chunks
  put(folder / "b.txt", text);
  CHECK(read_text_file(folder / "b.txt") == text);
}

TEST_CASE("text file: what cannot be read is named") {
  temporary_folder const folder;
  std::string const root = folder.path().string();
  auto const message = [&](std::string const& name) {
    return complaint([&] { (void)read_text_file(folder / name); });
  };
  CHECK(message("none.txt") == root + "/none.txt: got no such file, expected a readable text file");
  put(folder / "empty.txt", "");
  CHECK(message("empty.txt") ==
        root + "/empty.txt: got an empty file, expected a readable text file");
  CHECK(complaint([&] { (void)read_text_file(folder.path()); }) ==
        root + ": got a directory, expected a readable text file");
  CHECK(message("empty.txt/inside") ==
        root + "/empty.txt/inside: got no such file, expected a readable text file");
  io_test::fs::create_symlink(folder / "loop", folder / "loop");
  CHECK(message("loop") ==
        root + "/loop: got Too many levels of symbolic links, expected a readable text file");
  CHECK(message("two\nlines") ==
        root + "/two\\x0alines: got no such file, expected a readable text file");
  put(folder / "zero.txt", std::string("1 2\n\0 3\n", 8));
  CHECK(message("zero.txt") ==
        root + "/zero.txt: got binary data (a zero byte), expected a readable text file");
}

TEST_CASE("text file: a pipe is not waited for") {
  temporary_folder const folder;
  io_test::fs::path const pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(complaint([&] { (void)read_text_file(pipe); }) ==
        pipe.string() + ": got a special file, expected a readable text file");
}

TEST_CASE("text file: a hole of a terabyte is refused at once") {
  temporary_folder const folder;
  put(folder / "hole.mtx", "%%MatrixMarket matrix array real general\n");
  io_test::fs::resize_file(folder / "hole.mtx", std::uintmax_t{1} << 40);
  CHECK(complaint([&] { (void)read_text_file(folder / "hole.mtx"); }) ==
        (folder / "hole.mtx").string() +
            ": got binary data (a zero byte), expected a readable text file");
}

TEST_CASE("line scanner: lines, words and their numbers") {
  line_scanner lines("a  b\tc\r\n\n  \n d\n", "x");
  REQUIRE(lines.next_line());
  CHECK(lines.word() == "a");
  CHECK(lines.word() == "b");
  CHECK(lines.word() == "c");
  CHECK(lines.word().empty());
  CHECK(lines.word().empty());
  REQUIRE(lines.next_line());
  CHECK(lines.is_blank());
  REQUIRE(lines.next_line());
  CHECK(lines.is_blank());
  CHECK(lines.word().empty());
  REQUIRE(lines.next_line());
  CHECK(lines.line_number() == 4);
  CHECK(lines.bytes_left() == 0);
  CHECK(lines.word() == "d");
  CHECK_FALSE(lines.next_line());
  CHECK(complaint([&] { lines.refuse("this", "that"); }) == "x:5: got this, expected that");
}

TEST_CASE("line scanner: the last line must be ended, no line may be endless") {
  line_scanner open("1\n2.5", "x");
  REQUIRE(open.next_line());
  CHECK(complaint([&] { open.next_line(); }) ==
        "x:2: got '2.5' and the end of the file, expected a line feed at the end of the last line "
        "(truncated file?)");
  std::string text(1024, '7');
  text += "\r\n";
  line_scanner longest(text, "x");
  REQUIRE(longest.next_line());
  CHECK(longest.word().size() == 1024);
  std::string const too_long = std::string(1025, '7') + "\n";
  line_scanner refused(too_long, "x");
  CHECK(complaint([&] { refused.next_line(); }) ==
        "x:1: got '" + std::string(40, '7') + "...', expected a line of at most 1024 characters");
}

TEST_CASE("messages stay on one line and printable") {
  CHECK(slant::detail::quoted("a\nb\x1b\xff") == "'a\\x0ab\\x1b\\xff'");
  CHECK(slant::detail::quoted(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
}

}  // namespace text_scanner_test
