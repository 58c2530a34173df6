// SPDX-License-Identifier: MIT
//
// Damaged Matrix Market files, cut off at every byte. A reader may refuse them; it may not read
// anything else than what the file says. Changes of any kind are for tests/fuzz.
#include <doctest/doctest.h>

#include <initializer_list>
#include <optional>
#include <slant/io/matrix_market.hpp>
#include <string_view>

namespace matrix_market_damage_test {

using matrix = Eigen::SparseMatrix<double>;

std::optional<matrix> read_or_refuse(std::string_view text) {
  try {
    return slant::parse_matrix_market(text, "A.mtx", {.unbacked_dimension = 1000});
  } catch (slant::bad_input const&) {
    return std::nullopt;
  }
}

bool equal(matrix const& a, matrix const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && Eigen::MatrixXd(a) == Eigen::MatrixXd(b);
}

std::initializer_list<std::string_view> const files{
    "%%MatrixMarket matrix coordinate real general\n% comment\n4 3 5\n1 1 1.25\n2 2 -2.5e-7\n"
    "4 3 11\n3 1 0.333333\n4 1 22\n",
    "%%MatrixMarket matrix coordinate real symmetric\r\n3 3 4\r\n1 1 10.5\r\n2 1 -1.5\r\n"
    "3 3 12\r\n2 2 1e10\r\n",
    "%%MatrixMarket matrix coordinate integer general\n12 11 3\n12 11 12\n1 11 345\n11 1 -17\n",
    "%%MatrixMarket matrix coordinate pattern general\n22 21 3\n22 21\n1 21\n21 11\n\n\n",
    "%%MatrixMarket matrix array real general\n3 2\n1.5\n2.25\n-31\n4e2\n15\n66\n",
    "%%MatrixMarket matrix array integer symmetric\n2 2\n15\n-22\n36\n"};

TEST_CASE("damaged matrix market: every prefix is refused or means the same") {
  for (std::string_view const file : files) {
    auto const whole = read_or_refuse(file);
    REQUIRE_MESSAGE(whole, file);
    std::size_t const last = file.find_last_not_of("\r\n") + 1;
    for (std::size_t length = 0; length < file.size(); ++length) {
      auto const part = read_or_refuse(file.substr(0, length));
      if (part) {
        CHECK_MESSAGE(length > last, "accepted the first ", length, " bytes of\n", file);
        CHECK(equal(*part, *whole));
      }
    }
  }
}

}  // namespace matrix_market_damage_test
