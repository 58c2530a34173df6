// SPDX-License-Identifier: MIT
//
// Reading Matrix Market files: what is accepted and what it means, and every way to be refused.
#include <slant/io/matrix_market.hpp>

#include <bit>
#include <support/testing.hpp>
#include "io_support.hpp"

namespace matrix_market_test {

using slant::parse_matrix_market;
using matrix = Eigen::SparseMatrix<double>;
using io_test::get;
using io_test::temporary_folder;

MatrixXd dense(std::string_view text) {
  return MatrixXd(parse_matrix_market(text, "A.mtx"));
}

/// The refusal of a text, without the name of the file.
std::string refused(std::string_view text) {
  std::string const message = SLANT_COMPLAINT(parse_matrix_market(text, "A.mtx"));
  return message.starts_with("A.mtx:") ? message.substr(6) : message;
}

std::string const banner = "%%MatrixMarket matrix coordinate real general\n";

TEST_CASE("matrix market: coordinate general") {
  MatrixXd expected(2, 3);
  expected << 0, 1.5, 0, -2e-3, 0, 7;
  CHECK(dense(banner + "2 3 3\n2 3 7\n1 2 1.5\n2 1 -2e-3\n") == expected);
  CHECK(dense("%%MatrixMarket MATRIX Coordinate REAL General\r\n% a comment\r\n%\r\n\r\n2 3 3\r\n"
              "\r\n 2\t3  7 \r\n1 2 +1.5\r\n2 1 -2e-3\r\n\r\n") == expected);
  CHECK(dense(banner.substr(1) + "2 3 3\n2 3 7\n1 2 1.5\n2 1 -2e-3\n") == expected);
  CHECK(dense("%%MatrixMarket matrix coordinate integer general\n1 2 1\n1 2 -3\n") ==
        Eigen::RowVector2d(0, -3));
  CHECK(dense("%%MatrixMarket matrix coordinate pattern general\n1 2 1\n1 2\n") ==
        Eigen::RowVector2d(0, 1));
}

TEST_CASE("matrix market: symmetric files hold the lower triangle") {
  Eigen::Matrix2d expected;
  expected << 1, -2, -2, 5;
  CHECK(dense("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 -2\n2 2 5\n") ==
        expected);
  CHECK(dense("%%MatrixMarket matrix array real symmetric\n2 2\n1\n-2\n5\n") == expected);
}

TEST_CASE("matrix market: arrays are stored column by column") {
  MatrixXd expected(2, 3);
  expected << 1, 3, 0, 2, 4, 6;
  std::string const text = "%%MatrixMarket matrix array real general\n2 3\n1\n2\n3\n4\n0\n6\n";
  CHECK(dense(text) == expected);
  CHECK(parse_matrix_market(text, "A.mtx").nonZeros() == 5);
  CHECK(dense("%%MatrixMarket matrix array integer general\n1 1\n-7\n")(0, 0) == -7);
}

TEST_CASE("matrix market: zeros of a coordinate file stay, columns are sorted and compressed") {
  auto const A = parse_matrix_market(banner + "3 2 4\n3 2 1\n1 2 0\n2 2 5\n3 1 4\n", "A.mtx");
  CHECK(A.nonZeros() == 4);
  CHECK(A.isCompressed());
  int last = -1;
  for (decltype(A)::InnerIterator entry(A, 1); entry; ++entry) {
    CHECK(static_cast<int>(entry.row()) > last);
    last = static_cast<int>(entry.row());
  }
}

TEST_CASE("matrix market: empty matrices") {
  CHECK(parse_matrix_market(banner + "0 0 0\n", "A.mtx").size() == 0);
  auto const A = parse_matrix_market(banner + "5 7 0\n", "A.mtx");
  CHECK(A.rows() == 5);
  CHECK(A.cols() == 7);
  CHECK(A.nonZeros() == 0);
  CHECK(parse_matrix_market("%%MatrixMarket matrix array real general\n0 3\n", "A.mtx").cols() ==
        3);
}

TEST_CASE("matrix market: other scalars and index types") {
  std::string const text = banner + "1 1 1\n1 1 0.1\n";
  CHECK(parse_matrix_market<double, std::ptrdiff_t>(text, "A.mtx").coeff(0, 0) == 0.1);
  CHECK(SLANT_COMPLAINT(parse_matrix_market<float>(banner + "1 1 1\n1 1 1e39\n", "A.mtx")) ==
        "A.mtx:3: got '1e39', expected a number within the range of the scalar type");
  CHECK(
      SLANT_COMPLAINT(parse_matrix_market<double, std::int16_t>(banner + "40000 1 0\n", "A.mtx")) ==
      "A.mtx:2: got '40000', expected a number of rows from 0 to 32766");
}

TEST_CASE("matrix market: entries and mirror images must fit the index type") {
  std::string text = "%%MatrixMarket matrix coordinate pattern symmetric\n200 200 17000\n";
  int left = 17000;
  for (int col = 1; col <= 200; ++col)
    for (int row = col; row <= 200 && left > 0; ++row, --left)
      text += std::to_string(row) + " " + std::to_string(col) + "\n";
  CHECK(parse_matrix_market(text, "A.mtx").nonZeros() > 32767);
  CHECK(SLANT_COMPLAINT(parse_matrix_market<double, std::int16_t>(text, "A.mtx"))
            .find("entries with their mirror images, expected at most 32767") != std::string::npos);
}

TEST_CASE("matrix market: from a file") {
  io_test::temporary_folder const folder;
  io_test::put(folder / "K.mtx", banner + "1 1 1\n1 1 x\n");
  CHECK(SLANT_COMPLAINT(slant::read_matrix_market(folder / "K.mtx")) ==
        (folder / "K.mtx").string() + ":3: got 'x', expected a finite number");
  io_test::put(folder / "K.mtx", banner + "1 1 1\n1 1 4.5\n");
  CHECK(slant::read_matrix_market(folder / "K.mtx").coeff(0, 0) == 4.5);
}

TEST_CASE("matrix market: bad banners") {
  std::string const like =
      ", expected a first line like '%%MatrixMarket matrix coordinate real general'";
  CHECK(refused("1 2 3\n") == "1: got '1 2 3'" + like);
  CHECK(refused("\n" + banner + "1 1 0\n") == "1: got ''" + like);
  CHECK(refused("\xef\xbb\xbf" + banner + "1 1 0\n") ==
        "1: got '\\xef\\xbb\\xbf%%MatrixMarket matrix coordinate real...'" + like);
  CHECK(refused("MatrixMarket matrix coordinate real general\n1 1 0\n") ==
        "1: got 'MatrixMarket matrix coordinate real gene...'" + like);
  CHECK(refused("%%matrixmarket matrix coordinate real general\n1 1 0\n") ==
        "1: got '%%matrixmarket matrix coordinate real ge...'" + like);
  CHECK(refused("%%MatrixMarket vector coordinate real general\n1 1 0\n") ==
        "1: got 'vector', expected the object 'matrix'");
  CHECK(refused("%%MatrixMarket matrix dense real general\n1 1\n1\n") ==
        "1: got 'dense', expected coordinate or array");
  CHECK(refused("%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 0\n") ==
        "1: got 'complex', expected real, integer or pattern (complex matrices are not supported)");
  CHECK(refused("%%MatrixMarket matrix array pattern general\n1 1\n") ==
        "1: got 'array pattern', expected real or integer in an array");
  std::string const symmetry =
      ", expected general or symmetric (skew-symmetric and hermitian are not supported)";
  CHECK(refused("%%MatrixMarket matrix coordinate real skew-symmetric\n1 1 0\n") ==
        "1: got 'skew-symmetric'" + symmetry);
  CHECK(refused("%%MatrixMarket matrix coordinate real\n1 1 0\n") == "1: got ''" + symmetry);
  CHECK(refused("%%MatrixMarket matrix coordinate real general too\n1 1 0\n") ==
        "1: got 'too', expected nothing after the symmetry");
}

TEST_CASE("matrix market: bad sizes") {
  CHECK(refused(banner) == "2: got the end of the file, expected a line with the sizes");
  CHECK(refused(banner + "% only comments\n\n") ==
        "4: got the end of the file, expected a line with the sizes");
  CHECK(refused(banner + "-1 2 0\n") ==
        "2: got '-1', expected a number of rows from 0 to 16777216");
  CHECK(refused(banner + "2 2\n") ==
        "2: got the end of the line, expected a number of entries from 0 to 4");
  CHECK(refused(banner + "1 99999999999999999999 0\n") ==
        "2: got '99999999999999999999', expected a number of columns from 0 to 16777216");
  CHECK(refused("%%MatrixMarket matrix coordinate real symmetric\n2 3 0\n") ==
        "2: got 2 rows and 3 columns, expected a square matrix, since it is symmetric");
}

TEST_CASE("matrix market: sizes that the file cannot back") {
  // 12 bytes can hold two entries at most, whatever the size line says.
  CHECK(refused(banner + "1000 1000 1000000\n1 1 1\n2 2 2\n") ==
        "2: got 1000000 entries, expected at most 2, all that the remaining 12 bytes can hold "
        "(truncated file?)");
  CHECK(refused("%%MatrixMarket matrix array real general\n4000000 4000000\n1\n") ==
        "2: got 16000000000000 entries, expected at most 1, all that the remaining 2 bytes can "
        "hold (truncated file?)");
  CHECK(refused("%%MatrixMarket matrix coordinate pattern general\n9 9 3\n1 1\n2 2\n") ==
        "2: got 3 entries, expected at most 2, all that the remaining 8 bytes can hold "
        "(truncated file?)");
  CHECK(refused(banner + "2 2 5\n1 1 1\n1 2 1\n2 1 1\n2 2 1\n2 2 1\n") ==
        "2: got '5', expected a number of entries from 0 to 4");
  CHECK(refused("%%MatrixMarket matrix coordinate real symmetric\n2 2 4\n1 1 1\n2 1 1\n2 2 1\n2 2 "
                "1\n") == "2: got '4', expected a number of entries from 0 to 3");
  std::string const wide = banner + "1 20000000 0\n";
  CHECK(parse_matrix_market(wide, "A.mtx", {.unbacked_dimension = 20000000}).cols() == 20000000);
  // More than would fit any integer, with an index type that could hold each size.
  CHECK(SLANT_COMPLAINT(parse_matrix_market<double, std::ptrdiff_t>(
            banner + "4000000000000000000 4000000000000000000 9000000000000000000\n", "A.mtx",
            {.unbacked_dimension = std::numeric_limits<std::ptrdiff_t>::max()})) ==
        "A.mtx:2: got 9000000000000000000 entries, expected at most 0, all that the "
        "remaining 0 bytes can hold (truncated file?)");
}

TEST_CASE("matrix market: too few or too many entries") {
  CHECK(refused(banner + "3 3 3\n1 1 1.25000\n2 2 2.50000\n") ==
        "5: got the end of the file after 2 entries, expected 3 entries");
  CHECK(refused(banner + "3 3 2\n1 1 1\n2 2 2\n3 3 3\n") ==
        "5: got '3 3 3', expected the end of the file after 2 entries");
  CHECK(
      refused(banner + "3 3 2\n1 1 1\n2 2 2.5") ==
      "4: got '2 2 2.5' and the end of the file, expected a line feed at the end of the last line "
      "(truncated file?)");
  CHECK(refused("%%MatrixMarket matrix array real general\n2 2\n1.5\n2.5\n3.5\n") ==
        "6: got the end of the file after 3 entries, expected 4 entries");
  CHECK(refused("%%MatrixMarket matrix array real general\n1 2\n1\n2\n3\n") ==
        "5: got '3', expected the end of the file after 2 entries");
  CHECK(refused(banner + "1 1 1\n1 1 1\n% the end\n") ==
        "4: got '% the end', expected the end of the file after 1 entries");
}

TEST_CASE("matrix market: bad entries") {
  auto const entry = [](std::string const& line) {
    return refused(banner + "2 3 1\n" + line + "\n\n\n\n\n");
  };
  CHECK(entry("0 1 1") == "3: got '0', expected a row from 1 to 2");
  CHECK(entry("3 1 1") == "3: got '3', expected a row from 1 to 2");
  CHECK(entry("1 0 1") == "3: got '0', expected a column from 1 to 3");
  CHECK(entry("1 4 1") == "3: got '4', expected a column from 1 to 3");
  CHECK(entry("1 4294967297 1") == "3: got '4294967297', expected a column from 1 to 3");
  CHECK(entry("1 1.5 1") == "3: got '1.5', expected a column from 1 to 3");
  CHECK(entry("1 2") == "3: got the end of the line, expected a finite number");
  CHECK(entry("1") == "3: got the end of the line, expected a column from 1 to 3");
  CHECK(entry("1 2 3 4") == "3: got '4', expected nothing after the entry");
  CHECK(entry("1 2 abc") == "3: got 'abc', expected a finite number");
  CHECK(entry("1 2 1e999") ==
        "3: got '1e999', expected a number within the range of the scalar type");
  CHECK(entry("% 1 2") == "3: got '%', expected a row from 1 to 2");
  CHECK(entry("1 1 1\r\r") == "3: got '1\\x0d', expected a finite number");
  CHECK(refused(banner + "1 1 1\n1 1 " + std::string(1000000, ' ') + "1\n") ==
        "3: got '1 1 " + std::string(36, ' ') + "...', expected a line of at most 1024 characters");
  CHECK(refused("%%MatrixMarket matrix coordinate integer general\n1 1 1\n1 1 3.5\n") ==
        "3: got '3.5', expected a whole number, since the field is integer");
  CHECK(refused("%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1 1\n") ==
        "3: got '1', expected nothing after the entry");
  CHECK(refused("%%MatrixMarket matrix array real general\n1 2\n1 2\n3\n") ==
        "3: got '2', expected one number per line in an array");
}

TEST_CASE("matrix market: entries given twice, entries above the diagonal") {
  CHECK(refused(banner + "3 3 4\n1 1 1\n2 3 2\n\n3 2 2\n2 3 2\n") ==
        "7: got row 2, column 3 again, expected each entry once (first on line 4)");
  CHECK(refused("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n2 1 1\n1 2 1\n") ==
        "4: got row 1, column 2, expected only entries on or below the diagonal, since it is "
        "symmetric");
  CHECK(refused("%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n2 1 1\n3 3 1\n2 1 1\n") ==
        "5: got row 2, column 1 again, expected each entry once (first on line 3)");
}

std::optional<matrix> read_or_refuse(std::string_view text) {
  try {
    return slant::parse_matrix_market(text, "A.mtx", {.unbacked_dimension = 1000});
  } catch (slant::bad_input const&) {
    return std::nullopt;
  }
}

bool equal(matrix const& a, matrix const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && MatrixXd(a) == MatrixXd(b);
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

template <class Matrix>
Matrix random_matrix(int rows, int cols, int entries, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int k = 0; k < entries; ++k)
    triplets.emplace_back(static_cast<int>(random() % static_cast<unsigned>(rows)),
                          static_cast<int>(random() % static_cast<unsigned>(cols)),
                          1 / static_cast<double>(random()));
  Matrix A(rows, cols);
  A.setFromTriplets(triplets.begin(), triplets.end(), [](double, double b) { return b; });
  return A;
}

/// Same pattern, same bits.
bool identical(Eigen::SparseMatrix<double> const& a, Eigen::SparseMatrix<double> const& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  for (int col = 0; col < a.cols(); ++col) {
    Eigen::SparseMatrix<double>::InnerIterator x(a, col), y(b, col);
    for (; x && y; ++x, ++y)
      if (x.row() != y.row() ||
          std::bit_cast<std::uint64_t>(x.value()) != std::bit_cast<std::uint64_t>(y.value()))
        return false;
    if (x || y) return false;
  }
  return true;
}

TEST_CASE("write matrix market: the text") {
  temporary_folder const folder;
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(0, 0) = 0.1;
  A.insert(1, 0) = -3;
  A.insert(0, 1) = -3;
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(get(folder / "A.mtx") ==
        "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 0.1\n2 1 -3\n1 2 -3\n");
  slant::write_matrix_market(folder / "A.mtx", A, slant::matrix_market_symmetry::symmetric);
  CHECK(get(folder / "A.mtx") ==
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 0.1\n2 1 -3\n");
}

TEST_CASE("write matrix market: general matrices come back bit by bit") {
  temporary_folder const folder;
  using column_major = Eigen::SparseMatrix<double>;
  using row_major = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  auto const A = random_matrix<column_major>(70, 90, 2000, 1);
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(identical(slant::read_matrix_market(folder / "A.mtx"), A));
  auto const R = random_matrix<row_major>(30, 20, 200, 2);
  slant::write_matrix_market(folder / "R.mtx", R);
  CHECK(identical(slant::read_matrix_market(folder / "R.mtx"), column_major(R)));
  column_major const empty(3, 5);
  slant::write_matrix_market(folder / "E.mtx", empty);
  CHECK(identical(slant::read_matrix_market(folder / "E.mtx"), empty));
  slant::write_matrix_market(folder / "H.mtx", A.topRows(0));
  CHECK(slant::read_matrix_market(folder / "H.mtx").rows() == 0);
}

TEST_CASE("write matrix market: symmetric matrices come back bit by bit") {
  temporary_folder const folder;
  auto const lower = random_matrix<Eigen::SparseMatrix<double>>(60, 60, 900, 3);
  Eigen::SparseMatrix<double> const A = lower.selfadjointView<Eigen::Lower>();
  slant::write_matrix_market(folder / "A.mtx", A, slant::matrix_market_symmetry::symmetric);
  CHECK(identical(slant::read_matrix_market(folder / "A.mtx"), A));
}

TEST_CASE("write matrix market: other scalars") {
  temporary_folder const folder;
  Eigen::SparseMatrix<long double> A(1, 1);
  A.insert(0, 0) = 1 / 3.0L;
  slant::write_matrix_market(folder / "A.mtx", A);
  CHECK(slant::read_matrix_market<long double>(folder / "A.mtx").coeff(0, 0) == 1 / 3.0L);
  Eigen::SparseMatrix<float> B(1, 1);
  B.insert(0, 0) = 0.1f;
  slant::write_matrix_market(folder / "B.mtx", B);
  CHECK(slant::read_matrix_market<float>(folder / "B.mtx").coeff(0, 0) == 0.1f);
}

TEST_CASE("write matrix market: what is not written, and that nothing is left of it") {
  temporary_folder const folder;
  std::string const name = (folder / "A.mtx").string();
  Eigen::SparseMatrix<double> A(2, 2);
  A.insert(1, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(SLANT_COMPLAINT(slant::write_matrix_market(folder / "A.mtx", A)) ==
        name + ": got nan in row 2, column 1, expected finite entries");
  A.coeffRef(1, 0) = 2.5;
  A.insert(0, 1) = 2;
  auto const symmetric = slant::matrix_market_symmetry::symmetric;
  CHECK(SLANT_COMPLAINT(slant::write_matrix_market(folder / "A.mtx", A, symmetric)) ==
        name +
            ": got 2.5 in row 2, column 1 and 2 in its mirror image, expected equal entries, since "
            "it is to be stored as symmetric");
  Eigen::SparseMatrix<double> const wide(2, 3);
  CHECK(SLANT_COMPLAINT(slant::write_matrix_market(folder / "A.mtx", wide, symmetric)) ==
        name +
            ": got 2 rows and 3 columns, expected a square matrix, since it is to be stored as "
            "symmetric");
  CHECK(folder.entries() == 0);
}

}  // namespace matrix_market_test
