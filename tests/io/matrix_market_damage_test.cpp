// SPDX-License-Identifier: MIT
//
// Damaged Matrix Market files: cut off at every byte, and with random bytes changed. A reader may
// refuse them; it may not read anything else than what the file says, or break.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <random>
#include <slant/io/matrix_market.hpp>
#include <string>
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

/// The sizes that a text declares, read by other means than the reader's.
bool within_declared_sizes(std::string const& text, matrix const& A) {
  std::size_t begin = text.find('\n') + 1;
  while (text[begin] == '%' || text.find_first_not_of(" \t\r", begin) == text.find('\n', begin))
    begin = text.find('\n', begin) + 1;
  long rows = -1, cols = -1;
  std::size_t read = 0;
  rows = std::stol(text.substr(begin), &read);
  cols = std::stol(text.substr(begin + read));
  return A.rows() == rows && A.cols() == cols;
}

bool all_finite_and_inside(matrix const& A) {
  for (Eigen::Index col = 0; col < A.outerSize(); ++col)
    for (matrix::InnerIterator entry(A, col); entry; ++entry)
      if (!std::isfinite(entry.value()) || entry.row() < 0 || entry.row() >= A.rows()) return false;
  return A.nonZeros() <= A.rows() * A.cols();
}

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

TEST_CASE("damaged matrix market: random changes are refused or read as they stand") {
  std::mt19937 random(1994);
  auto const below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  constexpr std::string_view likely = "0123456789+-.eE \t\r\n%nif\0\x80\xff";
  int accepted = 0, refused = 0;
  for (std::string_view const file : files)
    for (int trial = 0; trial < 3000; ++trial) {
      std::string text(file);
      for (std::size_t changes = 1 + below(3); changes > 0 && !text.empty(); --changes) {
        // Mostly behind the banner, of which hardly a byte can be changed without a refusal.
        std::size_t const banner = std::min(text.find('\n'), text.size() - 1);
        std::size_t const at =
            below(8) == 0 ? below(text.size()) : banner + below(text.size() - banner);
        char const c = below(4) == 0 ? static_cast<char>(below(256)) : likely[below(likely.size())];
        switch (below(5)) {
          case 0:
            text.erase(at, 1 + below(4));
            break;
          case 1:
            text.insert(at, 1, c);
            break;
          case 2: {  // a piece of the file once more
            std::size_t const from = below(text.size());
            std::size_t const length = 1 + below(12);
            text.insert(at, text.substr(from, length));
            break;
          }
          default:
            text[at] = c;
        }
      }
      if (auto const A = read_or_refuse(text)) {
        ++accepted;
        CHECK_MESSAGE(within_declared_sizes(text, *A), text);
        CHECK_MESSAGE(all_finite_and_inside(*A), text);
      } else {
        ++refused;
      }
    }
  // Changing a digit of a number gives another legal file, so both must occur.
  CHECK(accepted > 1000);
  CHECK(refused > 5000);
}

}  // namespace matrix_market_damage_test
