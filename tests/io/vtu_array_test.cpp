// SPDX-License-Identifier: MIT
#include <slant/io/vtu.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "io_support.hpp"

namespace vtu_array_test {

using slant::vtu_encoding;

TEST_CASE("base64 as in the examples of RFC 4648") {
  CHECK(slant::detail::base64("") == "");
  CHECK(slant::detail::base64("f") == "Zg==");
  CHECK(slant::detail::base64("fo") == "Zm8=");
  CHECK(slant::detail::base64("foo") == "Zm9v");
  CHECK(slant::detail::base64("foob") == "Zm9vYg==");
  CHECK(slant::detail::base64("fooba") == "Zm9vYmE=");
  CHECK(slant::detail::base64("foobar") == "Zm9vYmFy");
  CHECK(slant::detail::base64(std::string("\0\xff", 2)) == "AP8=");
}

TEST_CASE("numbers as text, in the types that VTK knows") {
  auto const doubles =
      slant::detail::vtu_scalars("p", Eigen::Vector3d(1, -0.5, 0.1), 3, vtu_encoding::ascii);
  CHECK(doubles.text == "1 -0.5 0.1");
  CHECK(std::string(doubles.type) == "Float64");
  CHECK(doubles.count == 3);
  auto const floats =
      slant::detail::vtu_scalars("p", Eigen::Vector2f(1, 0.1f), 2, vtu_encoding::ascii);
  CHECK(floats.text == "1 0.1");
  CHECK(std::string(floats.type) == "Float32");
  auto const integers =
      slant::detail::vtu_scalars("p", Eigen::Vector2i(7, -8), 2, vtu_encoding::ascii);
  CHECK(integers.text == "7 -8");
  CHECK(std::string(integers.type) == "Int64");
}

TEST_CASE("vectors of the plane get a third component") {
  Eigen::Matrix2d const v{{1, 3}, {2, 4}};
  CHECK(slant::detail::vtu_vectors("u", v, 2, vtu_encoding::ascii).text == "1 2 0 3 4 0");
}

TEST_CASE("bytes stand behind their length") {
  auto const a = slant::detail::vtu_scalars("p", Eigen::Vector2i(1, 2), 2, vtu_encoding::base64);
  CHECK(std::string(a.format) == "binary");
  CHECK(a.text == "EAAAAAAAAAABAAAAAAAAAAIAAAAAAAAA");
}

TEST_CASE("data that do not fit are named") {
  using slant::bad_input;
  Eigen::Vector2d const v(1, std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH_AS(
      static_cast<void>(slant::detail::vtu_scalars("p", v, 2, vtu_encoding::ascii)),
      "p: got inf at 1, expected finite numbers", bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::detail::vtu_scalars("p", v, 3, vtu_encoding::ascii)),
                  bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::detail::vtu_vectors("p", Eigen::MatrixXd(4, 1), 1,
                                                               vtu_encoding::ascii)),
                  bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::detail::vtu_scalars("", v, 2, vtu_encoding::ascii)),
                  bad_input);
}

}  // namespace vtu_array_test
