// SPDX-License-Identifier: MIT
//
// Numbers from text and back, exactly: the nearest number of the type on the way in, the shortest
// text that reads back to the same bits on the way out. Both independent of the locale.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <slant/concepts/scalar.hpp>
#include <string>
#include <string_view>
#include <system_error>

namespace slant::detail {

enum class number_defect : unsigned char { none, not_a_number, too_large };

/// The parts of  [+-] digits [. digits] [e [+-] digits].
struct decimal_text {
  std::string_view sign{}, whole{}, fraction{}, exponent{};
  bool valid = false;
  bool integer = false;  ///< no point, no exponent
};

/// Splits a number into its parts. Stricter than from_chars, which would also take "inf", "nan" and
/// "1e" (as 1 followed by rubbish), and than strtod, which takes hexadecimals.
[[nodiscard]] inline decimal_text split_decimal(std::string_view text) {
  auto const take = [&](auto accept) {
    std::size_t n = 0;
    while (n < text.size() && accept(text[n])) ++n;
    std::string_view const part = text.substr(0, n);
    text.remove_prefix(n);
    return part;
  };
  auto const take_one = [&](std::string_view characters) {
    bool const found = !text.empty() && characters.find(text.front()) != std::string_view::npos;
    std::string_view const part = text.substr(0, found ? 1 : 0);
    text.remove_prefix(part.size());
    return part;
  };
  auto const is_digit = [](char c) { return '0' <= c && c <= '9'; };

  decimal_text parts;
  parts.sign = take_one("+-");
  parts.whole = take(is_digit);
  bool const point = !take_one(".").empty();
  if (point) parts.fraction = take(is_digit);
  bool const has_exponent = !take_one("eE").empty();
  bool exponent_valid = true;
  if (has_exponent) {
    std::string_view const from = text;
    take_one("+-");
    exponent_valid = !take(is_digit).empty();
    parts.exponent = from.substr(0, from.size() - text.size());
  }
  parts.valid = text.empty() && exponent_valid && (!parts.whole.empty() || !parts.fraction.empty());
  parts.integer = parts.valid && !point && !has_exponent;
  return parts;
}

/// Whether a number that does not fit is too large, as opposed to too small: the sign of the
/// position of its first digit other than 0, plus the exponent.
[[nodiscard]] inline bool is_huge(decimal_text const& parts) {
  std::string const digits = std::string(parts.whole).append(parts.fraction);
  std::size_t const leading = digits.find_first_not_of('0');
  if (leading == std::string::npos) return false;
  std::string_view exponent = parts.exponent;
  if (!exponent.empty() && exponent.front() == '+') exponent.remove_prefix(1);
  long long e = 0;
  if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), e).ec ==
      std::errc::result_out_of_range)
    return exponent.front() != '-';
  return static_cast<double>(parts.whole.size()) - static_cast<double>(leading) +
             static_cast<double>(e) >
         0;
}

/// Reads a finite number, rounded to the nearest S. What is too small for S becomes zero, as in
/// arithmetic (for long double that includes subnormal numbers); what is too large is a defect.
template <std::floating_point S>
[[nodiscard]] number_defect parse_number(std::string_view text, S& value) {
  decimal_text const parts = split_decimal(text);
  if (!parts.valid) return number_defect::not_a_number;
  if (parts.sign == "+") text.remove_prefix(1);  // from_chars knows no plus sign
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    if (is_huge(parts)) return number_defect::too_large;
    value = std::copysign(S(0), parts.sign == "-" ? S(-1) : S(1));
    return number_defect::none;
  }
  if (error != std::errc{} || end != text.data() + text.size()) return number_defect::not_a_number;
  return std::isfinite(value) ? number_defect::none : number_defect::too_large;
}

/// What was expected instead, for a message.
[[nodiscard, gnu::cold]] inline std::string_view expectation_of(number_defect defect) {
  return defect == number_defect::too_large ? "a number within the range of the scalar type"
                                            : "a finite number";
}

/// Appends a number: the shortest text that reads back to the same bits (at most 17 digits for a
/// double), "inf" or "-inf" for infinities.
template <class T>
void append_number(std::string& text, T value) {
  std::array<char, 64> buffer;
  auto const [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), end);
}

}  // namespace slant::detail
