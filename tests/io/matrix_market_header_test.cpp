// SPDX-License-Identifier: MIT
#include <slant/io/matrix_market.hpp>

#include <doctest/doctest.h>

#include <string>

namespace matrix_market_header_test {

using slant::detail::matrix_market_header;

/// The header of a file whose text goes on with `rest` bytes of entries.
matrix_market_header parse(std::string text, std::size_t rest = 0,
                           slant::matrix_market_options const& options = {}) {
  text += std::string(rest, '\n');
  slant::detail::line_scanner lines(text, "m.mtx");
  auto header = slant::detail::parse_banner(lines);
  slant::detail::parse_sizes<int>(lines, header, options);
  return header;
}

std::string complaint(std::string const& text, std::size_t rest = 0) {
  try {
    static_cast<void>(parse(text, rest));
  } catch (slant::bad_input const& e) {
    return e.what();
  }
  return "";
}

TEST_CASE("what the banner says, in any letter case") {
  auto const a = parse("%%MatrixMarket MATRIX Coordinate Integer SYMMETRIC\n% note\n\n3 3 2\n", 20);
  CHECK((a.symmetric && a.integer && !a.array && !a.pattern));
  CHECK((a.rows == 3 && a.cols == 3 && a.entries == 2));
  auto const b = parse("%%MatrixMarket matrix array real general\n2 5\n", 100);
  CHECK((b.array && !b.symmetric));
  CHECK(b.entries == 10);
  CHECK(parse("%%MatrixMarket matrix array real symmetric\n4 4\n", 100).entries == 10);
  CHECK(parse("%%MatrixMarket matrix coordinate pattern general\n0 7 0\n").pattern);
}

TEST_CASE("sizes that the bytes of the file cannot back are refused") {
  std::string const coordinate = "%%MatrixMarket matrix coordinate real general\n";
  CHECK(complaint(coordinate + "3 3 2\n", 12) == "");
  CHECK(complaint(coordinate + "3 3 2\n", 11).find("truncated file?") != std::string::npos);
  CHECK(complaint(coordinate + "3 3 10\n", 1000).find("from 0 to 9") != std::string::npos);
  CHECK(complaint(coordinate + "2147483647 1 1\n", 100) != "");
  CHECK(complaint(coordinate + "99999999999999999999 1 1\n", 100) != "");
  CHECK(complaint("%%MatrixMarket matrix array real general\n2000000 2000000\n", 100) != "");
  CHECK(parse(coordinate + "1000000 1 0\n").rows == 1000000);
  CHECK_THROWS_AS(
      static_cast<void>(parse(coordinate + "1000000 1 0\n", 0, {.unbacked_dimension = 9})),
      slant::bad_input);
}

TEST_CASE("each word of the header is checked, and the line is named") {
  CHECK(complaint("%%MatrixMarket vector coordinate real general\n1 1 0\n").find("m.mtx:1:") !=
        std::string::npos);
  CHECK(complaint("%%MatrixMarket matrix coordinate complex general\n1 1 0\n")
            .find("complex matrices are not supported") != std::string::npos);
  CHECK(complaint("%%MatrixMarket matrix coordinate real hermitian\n1 1 0\n") != "");
  CHECK(complaint("%%MatrixMarket matrix array pattern general\n1 1\n") != "");
  CHECK(complaint("%%MatrixMarket matrix coordinate real general extra\n1 1 0\n") != "");
  CHECK(complaint("%%MatrixMarket matrix coordinate real symmetric\n2 3 0\n")
            .find("a square matrix") != std::string::npos);
  CHECK(complaint("%%MatrixMarket matrix coordinate real general\n1 1 0 7\n") != "");
  CHECK(complaint("%%MatrixMarket matrix coordinate real general\n-1 1 0\n") != "");
  CHECK(complaint("%%MatrixMarket matrix coordinate real general\n1.5 1 0\n") != "");
  CHECK(complaint("%%MatrixMarket matrix coordinate real general\n% only a note\n") != "");
  CHECK(complaint("") != "");
}

}  // namespace matrix_market_header_test
