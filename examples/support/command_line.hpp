// SPDX-License-Identifier: MIT
//
// How every example program meets the shell: what it cannot use is named in one line on standard
// error, and the exit status tells this from a computation that did not succeed.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <slant/concepts/bad_input.hpp>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

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

/// The whole text as a number, or as it is; errc::result_out_of_range for a number that T cannot
/// hold.
template <class T>
[[nodiscard]] std::errc parse(std::string const& text, T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
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

/// A check of an option: its text is a T for which `holds`; otherwise the program says
/// "--tolerance: got 2, expected a relative accuracy in [0, 1)".
template <class T, class Condition>
[[nodiscard]] CLI::Validator expects(std::string expectation, Condition holds) {
  auto const check = [expectation = std::move(expectation), holds](std::string& text) {
    T value{};
    auto const error = detail::parse(text, value);
    if (error == std::errc{} && holds(value)) return std::string{};
    std::string said = "got " + (text.empty() ? "nothing" : text) + ", expected " + expectation;
    if (error == std::errc::result_out_of_range) said += ", " + detail::range<T>();
    return said;
  };
  return CLI::Validator(check, "", "");
}

/// A relative accuracy, as the stopping rules take it.
[[nodiscard]] inline CLI::Validator expects_tolerance() {
  return expects<double>("a relative accuracy in [0, 1)", [](double t) { return t >= 0 && t < 1; });
}

/// A whole number that is at least `least`.
[[nodiscard]] inline CLI::Validator expects_at_least(long long least) {
  return expects<long long>("a whole number >= " + std::to_string(least),
                            [least](long long n) { return n >= least; });
}

/// A name that is not empty.
[[nodiscard]] inline CLI::Validator expects_name() {
  return expects<std::string>("a name", [](std::string const& name) { return !name.empty(); });
}

/// Creates a folder that results go to, with those above it. Throws slant::bad_input naming the
/// option.
inline void make_folder(std::string_view option, std::filesystem::path const& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw slant::bad_input(option, slant::detail::printable(folder) + " (" + error.message() + ")",
                           "a folder that exists or can be created");
}

namespace detail {

inline int refuse(std::string_view program, std::string_view message) {
  std::string const line = slant::detail::printable(message, false);
  std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(program.size()), program.data(),
               line.c_str());
  return refused;
}

/// What CLI11 says, in the words of this project.
inline std::string explanation(CLI::App const& app, CLI::ParseError const& failure) {
  std::string said = failure.what();
  if (auto const extra = app.remaining();
      dynamic_cast<CLI::ExtrasError const*>(&failure) && !extra.empty())
    return "argument: got " + extra.back() + ", expected one of those that --help lists";
  if (dynamic_cast<CLI::ArgumentMismatch const*>(&failure)) {
    std::string const option = said.substr(0, said.find(':'));
    if (auto const* const found = app.get_option_no_throw(option))
      return option + ": got " +
             (found->count() == 0 ? "nothing" : std::to_string(found->count()) + " values") +
             ", expected one";
  }
  return said;
}

}  // namespace detail

/// Throws slant::bad_input unless all that was printed has arrived.
inline void require_printed() {
  std::cout.flush();
  if (!std::cout.good() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw slant::bad_input("standard output", "an error", "room for the result");
}

/// Parses the command line and calls body() → exit_status. Whatever either of them throws becomes
/// one line on standard error and the status `refused`.
template <class Body>
[[nodiscard]] int run_program(CLI::App& app, int argc, char const* const* argv, Body const& body) {
  std::string const name = app.get_name();
  try {
    app.parse(argc, argv);
    int const status = body();
    require_printed();
    return status;
  } catch (CLI::ParseError const& failure) {
    if (failure.get_exit_code() == 0) return app.exit(failure);  // --help
    return detail::refuse(name, detail::explanation(app, failure));
  } catch (std::bad_alloc const&) {
    return detail::refuse(name, "memory: got too little, expected enough for this problem");
  } catch (std::exception const& failure) {
    return detail::refuse(name, failure.what());
  }
}

}  // namespace examples
