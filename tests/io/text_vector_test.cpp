// SPDX-License-Identifier: MIT
//
// Vectors as text.
#include <slant/io/text_vector.hpp>

#include <support/testing.hpp>
#include "io_support.hpp"

namespace text_vector_test {

using io_test::temporary_folder;
using slant::parse_text_vector;
using slant::text_vector_options;

/// The refusal of a text, without the name of the file.
std::string refused(std::string_view text, text_vector_options const& options = {}) {
  std::string const message = SLANT_COMPLAINT(parse_text_vector(text, "f.txt", options));
  return message.starts_with("f.txt:") ? message.substr(6) : message;
}

TEST_CASE("text vector: what is read") {
  CHECK(parse_text_vector("1\n-2.5\n+3e2\n", "f.txt") == Vector3d(1, -2.5, 300));
  CHECK(parse_text_vector("# load\r\n 1 \r\n#\n\t2\r\n\r\n\r\n# end\n", "f.txt") == Vector2d(1, 2));
  CHECK(parse_text_vector("\n\n", "f.txt").size() == 0);
  CHECK(parse_text_vector("7\n", "f.txt", {.size = 1})[0] == 7);
  CHECK(parse_text_vector<float>("0.1\n", "f.txt")[0] == 0.1f);
}

TEST_CASE("text vector: infinity only where it is asked for") {
  auto const g = parse_text_vector("inf\n+Inf\n-INF\nInfinity\n1\n", "g.txt",
                                   {.size = 5, .allow_infinity = true});
  CHECK(g[0] == infinity);
  CHECK(g[1] == infinity);
  CHECK(g[2] == -infinity);
  CHECK(g[3] == infinity);
  CHECK(g[4] == 1);
  CHECK(refused("1\ninf\n") == "2: got 'inf', expected a finite number");
  text_vector_options const allowed{.allow_infinity = true};
  CHECK(refused("infin\n", allowed) == "1: got 'infin', expected a number or inf");
  CHECK(refused("nan\n", allowed) == "1: got 'nan', expected a number or inf");
  CHECK(refused("1e999\n", allowed) ==
        "1: got '1e999', expected a number within the range of the scalar type");
}

TEST_CASE("text vector: what is refused") {
  CHECK(refused("1\n2 3\n") == "2: got '3', expected one number per line");
  CHECK(refused("1 # one\n") == "1: got '#', expected one number per line");
  CHECK(refused("one\n") == "1: got 'one', expected a finite number");
  CHECK(refused("1\n\n2\n") ==
        "3: got '2' after the blank line 2, expected blank lines only at the end");
  CHECK(refused("1\n2.5") ==
        "2: got '2.5' and the end of the file, expected a line feed at the end of the last line "
        "(truncated file?)");
  CHECK(refused("1\n2\n3\n", {.size = 4}) ==
        "4: got the end of the file after 3 numbers, expected 4 numbers");
  CHECK(refused("1\n2\n3\n", {.size = 2}) == "3: got number 3, expected 2 numbers");
  CHECK(refused("\n", {.size = 1}) ==
        "2: got the end of the file after 0 numbers, expected 1 numbers");
}

TEST_CASE("text vector: every prefix is refused when the size is known") {
  std::string_view const file = "# three\n1.25\n-31\n4.5e7\n";
  REQUIRE(parse_text_vector(file, "f.txt", {.size = 3}) == Vector3d(1.25, -31, 4.5e7));
  for (std::size_t length = 0; length < file.size(); ++length)
    CHECK(refused(file.substr(0, length), {.size = 3}) != "nothing thrown");
}

TEST_CASE("text vector: files") {
  temporary_folder const folder;
  io_test::put(folder / "f.txt", "1\nx\n");
  CHECK(SLANT_COMPLAINT(slant::read_text_vector(folder / "f.txt")) ==
        (folder / "f.txt").string() + ":2: got 'x', expected a finite number");
}

TEST_CASE("text vector: the same bits come back") {
  temporary_folder const folder;
  using limits = std::numeric_limits<double>;
  VectorXd const x{{1 / 3.0, limits::denorm_min(), limits::max(), -0.0}};
  slant::write_text_vector(folder / "x.txt", x);
  VectorXd const y = slant::read_text_vector(folder / "x.txt", {.size = 4});
  CHECK(y == x);
  CHECK(std::signbit(y[3]));

  Eigen::Matrix<long double, 2, 1> const wide(1 / 3.0L, -2e-4000L);
  slant::write_text_vector(folder / "w.txt", wide);
  CHECK(slant::read_text_vector<long double>(folder / "w.txt") == wide);

  slant::write_text_vector(folder / "e.txt", VectorXd());
  CHECK(io_test::get(folder / "e.txt").empty());

  Vector2d const open(infinity, -infinity);
  slant::write_text_vector(folder / "g.txt", open, {.allow_infinity = true});
  CHECK(io_test::get(folder / "g.txt") == "inf\n-inf\n");
  CHECK(slant::read_text_vector(folder / "g.txt", {.allow_infinity = true}) == open);
}

TEST_CASE("text vector: what is not written, and that nothing is left of it") {
  temporary_folder const folder;
  std::string const name = (folder / "x.txt").string();
  Vector2d const nan(1, std::numeric_limits<double>::quiet_NaN());
  CHECK(
      SLANT_COMPLAINT(slant::write_text_vector(folder / "x.txt", nan, {.allow_infinity = true})) ==
      name + ": got nan in component 1, expected finite numbers");
  Vector2d const inf(infinity, 1);
  CHECK(SLANT_COMPLAINT(slant::write_text_vector(folder / "x.txt", inf)) ==
        name + ": got inf in component 0, expected finite numbers");
  CHECK(folder.entries() == 0);
}

}  // namespace text_vector_test
