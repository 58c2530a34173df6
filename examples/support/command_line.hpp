// SPDX-License-Identifier: MIT
//
// How every example program meets the shell: what it cannot use is named in one line on standard
// error, and the exit status tells this from a computation that did not succeed. CLI11 stands behind
// it, compiled once in command_line.cpp: it takes longer than most programs.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace examples {

/// Exit statuses of the programs.
enum exit_status : int {
  succeeded = 0,
  not_converged = 1,  ///< the computation ran and its result is not what was asked for
  refused = 2         ///< input that cannot be used, or output that cannot be written
};

/// For the help text.
inline constexpr std::string_view exit_status_help =
    "Exit status: 0 converged; 1 not converged; 2 input that cannot be used or output that cannot "
    "be written, named in one line on standard error.";

namespace detail {

/// The whole text as a number, or as text or path it is; errc::result_out_of_range for a number that
/// T cannot hold.
template <class T>
[[nodiscard]] std::errc parse(std::string const& text, T& value) {
  if constexpr (!std::is_arithmetic_v<T>) {
    value = text;
    return {};
  } else {
    // Not CLI11's own conversion, which takes what overflows for the largest number.
    char const* begin = text.data();
    char const* const end = begin + text.size();
    if (text.starts_with('+') && !text.starts_with("+-")) ++begin;  // not known to from_chars
    auto const [rest, error] = std::from_chars(begin, end, value);
    return rest == end ? error : std::errc::invalid_argument;
  }
}

/// What a T can hold.
template <class T>
[[nodiscard]] std::string range() {
  if constexpr (std::is_integral_v<T>) {
    return "at most " + std::to_string(std::numeric_limits<T>::max());
  } else {
    return "within the range of double precision";
  }
}

}  // namespace detail

/// What is wrong with the text of an option, or nothing.
using check = std::function<std::string(std::string const&)>;

/// Its text is a T for which `holds`; otherwise the program says "--tolerance: got 2, expected a
/// relative accuracy in [0, 1)".
template <class T, class Condition>
[[nodiscard]] check expects(std::string expectation, Condition holds) {
  return [expectation = std::move(expectation), holds](std::string const& text) {
    T value{};
    auto const error = detail::parse(text, value);
    if (error == std::errc{} && holds(value)) return std::string{};
    std::string said = "got " + (text.empty() ? "nothing" : text) + ", expected " + expectation;
    if (error == std::errc::result_out_of_range) said += ", " + detail::range<T>();
    return said;
  };
}

/// A relative accuracy, as the stopping rules take it.
[[nodiscard]] inline check expects_tolerance() {
  return expects<double>("a relative accuracy in [0, 1)", [](double t) { return t >= 0 && t < 1; });
}

/// A whole number that is at least `least`.
[[nodiscard]] inline check expects_at_least(long long least) {
  return expects<long long>("a whole number >= " + std::to_string(least),
                            [least](long long n) { return n >= least; });
}

/// A name that is not empty.
[[nodiscard]] inline check expects_name() {
  return expects<std::string>("a name", [](std::string const& name) { return !name.empty(); });
}

/// One of these words: "expected press, pull or lift".
[[nodiscard]] check expects_one_of(std::vector<std::string> words);

/// Creates a folder that results go to, with those above it. Throws slant::bad_input naming the
/// option.
void make_folder(std::string_view option, std::filesystem::path const& folder);

/// Throws slant::bad_input unless all that was printed has arrived.
void require_printed();

/// The options of a program, and its run.
class command_line {
 public:
  command_line(std::string const& about, std::string const& name,
               std::string_view footer = exit_status_help);
  ~command_line();
  command_line(command_line const&) = delete;
  command_line& operator=(command_line const&) = delete;

  /// `value`, a number, text or path, becomes what the option `name` says if that is `allowed`; its
  /// value now is shown as the default.
  template <class T>
  void option(std::string const& name, T& value, std::string const& help,
              check const& allowed = {}) {
    add({name, help, type_name<T>(), shown(value), allowed, 1, 1},
        [&value](texts const& all) { return detail::parse(all[0], value) == std::errc{}; });
  }
  /// The same where the default is none.
  template <class T>
  void option(std::string const& name, std::optional<T>& value, std::string const& help,
              check const& allowed) {
    add({name, help, type_name<T>(), "", allowed, 1, 1}, [&value](texts const& all) {
      return detail::parse(all[0], value.emplace()) == std::errc{};
    });
  }
  /// `least` to `most` values; −1: any number.
  template <class T>
  void option(std::string const& name, std::vector<T>& values, std::string const& help,
              check const& allowed, int least = 1, int most = -1) {
    std::string text;
    for (T const& value : values) text += (text.empty() ? "" : " ") + shown(value);
    add({name, help, type_name<T>(), text, allowed, least, most}, [&values](texts const& all) {
      values.resize(all.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (detail::parse(all[i], values[i]) != std::errc{}) return false;
      }
      return true;
    });
  }
  /// `value` becomes true if the program is called with `name`.
  void flag(std::string const& name, bool& value, std::string const& help);

  /// Parses the command line and calls body() → exit_status. Whatever either of them throws becomes
  /// one line on standard error and the status `refused`.
  [[nodiscard]] int run(int argc, char const* const* argv, std::function<int()> const& body);

 private:
  using texts = std::vector<std::string>;
  struct description {
    std::string name, help, type, shown;
    check allowed;
    int least, most;
  };
  struct parser;

  void add(description const& option, std::function<bool(texts const&)> store);

  template <class T>
  static std::string type_name() {
    return std::is_floating_point_v<T> ? "FLOAT" : std::is_integral_v<T> ? "INT" : "TEXT";
  }
  /// NaN stands for no default.
  template <class T>
  static std::string shown(T const& value) {
    if constexpr (std::is_same_v<T, std::filesystem::path>) {
      return value.string();
    } else {
      if constexpr (std::is_floating_point_v<T>) {
        if (std::isnan(value)) return "";
      }
      std::ostringstream text;
      text << value;
      return text.str();
    }
  }

  std::unique_ptr<parser> parser_;
};

}  // namespace examples
