// SPDX-License-Identifier: MIT
//
// What the text readers share: a whole file in memory, its lines and their blank-separated words,
// and refusals that say where.
//
// Why the whole file at once: its size is then a hard bound on how many numbers it can hold, known
// before anything is allocated for them.
// Why every line must end in a line feed: without one, 1.25 cut down to 1.2 by a full disk or a
// broken transfer cannot be told from a whole number.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace slant::detail {

/// Text as it can stand in a one-line message: control characters as \xNN, and, if ascii_only,
/// everything beyond 7 bits too.
[[nodiscard, gnu::cold]] inline std::string printable(std::string_view text, bool ascii_only) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (char const c : text) {
    auto const byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || (ascii_only && byte > 0x7f))
      result.append("\\x").append(1, digits[byte / 16]).append(1, digits[byte % 16]);
    else
      result += c;
  }
  return result;
}

/// A piece of a file for a message: quoted, printable, at most 40 characters of it.
[[nodiscard, gnu::cold]] inline std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  bool const cut = text.size() > longest;
  return "'" + printable(text.substr(0, longest), true) + (cut ? "...'" : "'");
}

[[nodiscard, gnu::cold]] inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// A path for a message.
[[nodiscard, gnu::cold]] inline std::string printable(std::filesystem::path const& path) {
  return printable(path.string(), false);
}

/// The content of a regular file. Throws bad_input for anything that is missing, not a regular file
/// (reading a pipe could wait for ever), unreadable, empty, larger than memory or not text.
[[nodiscard]] inline std::string read_text_file(std::filesystem::path const& path) {
  namespace fs = std::filesystem;
  auto const refuse = [&](std::string_view value) {
    throw bad_input(printable(path), value, "a readable text file");
  };
  std::error_code error;
  fs::file_status const status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse("no such file");
  if (error) refuse(error.message());
  if (status.type() == fs::file_type::directory) refuse("a directory");
  if (status.type() != fs::file_type::regular) refuse("a special file");

  std::ifstream in(path, std::ios::binary);
  if (!in) refuse(std::generic_category().message(errno));
  std::string text;
  try {
    // The size is believed up to a point: a file may claim a terabyte and be one huge hole, which
    // the first zero byte gives away.
    constexpr std::size_t chunk = std::size_t{1} << 22;
    constexpr std::uintmax_t believed = std::uintmax_t{1} << 28;
    text.reserve(static_cast<std::size_t>(std::min(fs::file_size(path), believed)) + chunk);
    while (in) {
      std::size_t const before = text.size();
      text.resize(before + chunk);
      in.read(text.data() + before, static_cast<std::streamsize>(chunk));
      text.resize(before + static_cast<std::size_t>(in.gcount()));
      if (text.find('\0', before) != std::string::npos) refuse("binary data (a zero byte)");
    }
  } catch (std::bad_alloc const&) {
    refuse("more bytes than fit into memory");
  } catch (std::length_error const&) {
    refuse("more bytes than fit into memory");
  } catch (fs::filesystem_error const& failure) {
    refuse(failure.code().message());
  }
  if (in.bad()) refuse("an error while reading");
  if (text.empty()) refuse("an empty file");
  return text;
}

/// Walks through text line by line and, within a line, word by word. Lines end in LF or CR LF;
/// words are separated by spaces and tabs.
class line_scanner {
 public:
  /// Of the Matrix Market format; far more than any number needs.
  static constexpr std::size_t longest_line = 1024;

  /// The text must outlive the scanner; file names it in messages.
  line_scanner(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  /// Moves on to the next line; false at the end. Throws bad_input for a line that is too long or
  /// is not ended by a line feed.
  bool next_line() {
    ++number_;
    if (rest_.empty()) return false;
    std::size_t const end = rest_.substr(0, longest_line + 2).find('\n');
    if (end == std::string_view::npos) {
      if (rest_.size() > longest_line) refuse_length(rest_);
      refuse(quoted(rest_) + " and the end of the file",
             "a line feed at the end of the last line (truncated file?)");
    }
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    if (line_.size() > longest_line) refuse_length(line_);
    words_ = line_;
    return true;
  }

  /// The next word of this line; empty at its end.
  std::string_view word() {
    std::size_t const begin = std::min(words_.find_first_not_of(" \t"), words_.size());
    words_.remove_prefix(begin);
    std::string_view const found = words_.substr(0, words_.find_first_of(" \t"));
    words_.remove_prefix(found.size());
    return found;
  }

  /// Throws bad_input if this line has another word.
  void expect_end_of_line(std::string_view expectation) {
    if (std::string_view const extra = word(); !extra.empty()) refuse(quoted(extra), expectation);
  }

  [[nodiscard]] bool is_blank() const {
    return line_.find_first_not_of(" \t") == std::string_view::npos;
  }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] index line_number() const { return number_; }
  /// Bytes after this line.
  [[nodiscard]] index bytes_left() const { return static_cast<index>(rest_.size()); }

  /// Throws bad_input naming file and line.
  [[noreturn]] void refuse(std::string_view value, std::string_view expectation) const {
    throw bad_input(file_ + ":" + show(number_), value, expectation);
  }

 private:
  [[noreturn]] void refuse_length(std::string_view text) const {
    refuse(quoted(text), "a line of at most " + show(longest_line) + " characters");
  }

  std::string_view rest_;
  std::string_view line_{};
  std::string_view words_{};
  std::string file_;
  index number_ = 0;
};

// --- number text ---------------------------------------------------------------------------------
//
// Numbers from text and back, exactly: the nearest number of the type on the way in, the shortest
// text that reads back to the same bits on the way out. Both independent of the locale.

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
