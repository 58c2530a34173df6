// SPDX-License-Identifier: MIT
//
// Numbers from text and back.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <slant/io/text_scanner.hpp>
#include <string>

namespace number_text_test {

using slant::detail::number_defect;
using slant::detail::parse_number;

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
  for (auto text : {"",
                    "+",
                    "-",
                    ".",
                    "e5",
                    "1e",
                    "1e+",
                    "+-1",
                    "1.2.3",
                    "0x10",
                    "1d5",
                    "1,5",
                    "1 ",
                    " 1",
                    "nan",
                    "NaN",
                    "inf",
                    "-inf",
                    "infinity",
                    "1e5x",
                    "--1",
                    "1_000",
                    "\xc2\xa0"
                    "1"})
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

}  // namespace number_text_test
