// SPDX-License-Identifier: MIT
//
// Whole files, their lines and words.
#include <slant/io/text_scanner.hpp>

#include <sys/stat.h>
#include <bit>
#include <support/testing.hpp>
#include "io_support.hpp"

namespace text_scanner_test {

using io_test::put;
using io_test::temporary_folder;
using slant::detail::line_scanner;
using slant::detail::number_defect;
using slant::detail::parse_number;
using slant::detail::read_text_file;

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
    return SLANT_COMPLAINT(read_text_file(folder / name));
  };
  CHECK(message("none.txt") == root + "/none.txt: got no such file, expected a readable text file");
  put(folder / "empty.txt", "");
  CHECK(message("empty.txt") ==
        root + "/empty.txt: got an empty file, expected a readable text file");
  CHECK(SLANT_COMPLAINT(read_text_file(folder.path())) ==
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
  CHECK(SLANT_COMPLAINT(read_text_file(pipe)) ==
        pipe.string() + ": got a special file, expected a readable text file");
}

TEST_CASE("text file: a hole of a terabyte is refused at once") {
  temporary_folder const folder;
  put(folder / "hole.mtx", "%%MatrixMarket matrix array real general\n");
  io_test::fs::resize_file(folder / "hole.mtx", std::uintmax_t{1} << 40);
  CHECK(SLANT_COMPLAINT(read_text_file(folder / "hole.mtx")) ==
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
  CHECK(SLANT_COMPLAINT(lines.refuse("this", "that")) == "x:5: got this, expected that");
}

TEST_CASE("line scanner: the last line must be ended, no line may be endless") {
  line_scanner open("1\n2.5", "x");
  REQUIRE(open.next_line());
  CHECK(SLANT_COMPLAINT(open.next_line()) ==
        "x:2: got '2.5' and the end of the file, expected a line feed at the end of the last line "
        "(truncated file?)");
  std::string text(1024, '7');
  text += "\r\n";
  line_scanner longest(text, "x");
  REQUIRE(longest.next_line());
  CHECK(longest.word().size() == 1024);
  std::string const too_long = std::string(1025, '7') + "\n";
  line_scanner refused(too_long, "x");
  CHECK(SLANT_COMPLAINT(refused.next_line()) ==
        "x:1: got '" + std::string(40, '7') + "...', expected a line of at most 1024 characters");
}

TEST_CASE("messages stay on one line and printable") {
  CHECK(slant::detail::quoted("a\nb\x1b\xff") == "'a\\x0ab\\x1b\\xff'");
  CHECK(slant::detail::quoted(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
}

template <class S>
S parsed(std::string_view text) {
  S value = std::numeric_limits<S>::quiet_NaN();
  REQUIRE_MESSAGE(parse_number(text, value) == number_defect::none, text);
  return value;
}

number_defect defect_of(std::string_view text) {
  double value = 0;
  return parse_number(text, value);
}

template <class S>
std::string text_of(S value) {
  std::string text;
  slant::detail::append_number(text, value);
  return text;
}

TEST_CASE("number text: the spellings of decimal numbers") {
  CHECK(parsed<double>("1") == 1);
  CHECK(parsed<double>("+1.5") == 1.5);
  CHECK(parsed<double>("-.5") == -0.5);
  CHECK(parsed<double>("5.") == 5);
  CHECK(parsed<double>("1e3") == 1000);
  CHECK(parsed<double>("1E+3") == 1000);
  CHECK(parsed<double>("-12.5e-1") == -1.25);
  CHECK(parsed<double>("0000000000000000000000000000001") == 1);
  CHECK(std::signbit(parsed<double>("-0")));
}

TEST_CASE("number text: what is not a finite number") {
  for (auto text : {"",      "+",    "-",        ".",    "e5",  "1e",    "1e+",    "+-1",
                    "1.2.3", "0x10", "1d5",      "1,5",  "1 ",  " 1",    "nan",    "NaN",
                    "inf",   "-inf", "infinity", "1e5x", "--1", "1_000", "\u00a01"})
    CHECK_MESSAGE(defect_of(text) == number_defect::not_a_number, text);
  for (auto text : {"1e999", "-1e999", "1e309", "1.8e308", "1e99999999999999999999",
                    "123456789e301", "0.0001e400", "+2e308"})
    CHECK_MESSAGE(defect_of(text) == number_defect::too_large, text);
  CHECK(defect_of(std::string(400, '9')) == number_defect::too_large);
}

TEST_CASE("number text: rounded to the nearest, also near the ends of the range") {
  using limits = std::numeric_limits<double>;
  CHECK(parsed<double>("1.7976931348623157e308") == limits::max());
  CHECK(parsed<double>("2.2250738585072014e-308") == limits::min());
  CHECK(parsed<double>("4.9406564584124654e-324") == limits::denorm_min());
  CHECK(parsed<double>("1e-999") == 0);
  CHECK(parsed<double>("1e-99999999999999999999") == 0);
  CHECK(std::signbit(parsed<double>("-1e-999")));
  CHECK(parsed<double>("0e999") == 0);
  CHECK(parsed<double>("0.0e99999999999999999999") == 0);
  CHECK(parsed<double>(std::string("0.").append(400, '0').append("1e401")) == 1);
  CHECK(parsed<double>(std::string("1").append(400, '0').append("e-400")) == 1);
  CHECK(parsed<double>("9007199254740993") == 9007199254740992.0);  // a tie goes to even
  CHECK(parsed<double>("9007199254740993.0000000000000000000001") == 9007199254740994.0);
  CHECK(parsed<float>("1e-46") == 0.0f);
  CHECK(parsed<float>("16777217") == 16777216.0f);
  CHECK(parsed<long double>("1e999") > 1e300L);
  float narrow = 0;
  CHECK(parse_number("1e39", narrow) == number_defect::too_large);
}

TEST_CASE("number text: back to the same bits") {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 20000; ++i) {
    std::uint64_t const bits = random();
    auto const x = std::bit_cast<double>(bits);
    if (!std::isfinite(x)) continue;
    CHECK(std::bit_cast<std::uint64_t>(parsed<double>(text_of(x))) == bits);
    auto const narrow = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (std::isfinite(narrow)) CHECK(parsed<float>(text_of(narrow)) == narrow);
    long double const wide = 1 / static_cast<long double>(x);
    if (i < 1000 && std::isfinite(wide) && wide != 0)
      CHECK(parsed<long double>(text_of(wide)) == wide);
  }
  CHECK(text_of(0.1) == "0.1");
  CHECK(text_of(-std::numeric_limits<double>::infinity()) == "-inf");
}

}  // namespace text_scanner_test
