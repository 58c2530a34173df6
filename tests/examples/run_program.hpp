// SPDX-License-Identifier: MIT
//
// Runs one of the example programs through the shell and keeps what it says.
#pragma once

#include <sys/wait.h>
#include <cstdlib>
#include <fem/plots/gnuplot.hpp>
#include <io/io_support.hpp>
#include <support/folders.hpp>
#include <support/testing.hpp>

namespace examples_test {

using test::contains;

struct program_result {
  int status;  ///< exit status; 128 + n if signal n ended it
  std::string out;
  std::string err;
};

/// A word that the shell takes as it is.
[[nodiscard]] inline std::string word(std::string_view text) {
  return fem::detail::shell_word(text);
}

/// The path of a program, as a shell word.
[[nodiscard]] inline std::string program(std::string_view name) {
  return word(test::program(name).string());
}

/// Runs a shell command. Its output passes through pipes, so that limits on files do not touch it.
[[nodiscard]] inline program_result run_command(std::string const& command) {
  io_test::temporary_folder const folder;
  auto const file = [&](char const* name) { return word((folder / name).string()); };
  std::string const whole = "{ { { " + command + " ; } </dev/null; echo $? >" + file("status") +
                            "; } 2>&3 | cat >" + file("out") + "; } 3>&1 | cat >" + file("err");
  int const shell = std::system(whole.c_str());
  std::string const status = io_test::get(folder / "status");
  bool const ran = WIFEXITED(shell) && WEXITSTATUS(shell) == 0 && !status.empty();
  return {ran ? std::stoi(status) : -1, io_test::get(folder / "out"), io_test::get(folder / "err")};
}

/// Runs a program with arguments that are already shell words.
[[nodiscard]] inline program_result run(std::string_view name, std::string const& arguments) {
  return run_command(program(name) + " " + arguments);
}

/// Programs draw pictures where gnuplot is installed.
[[nodiscard]] inline bool has_gnuplot() {
  return std::system("command -v gnuplot >/dev/null 2>&1") == 0;
}

/// Exactly one line, complete, with something on it.
[[nodiscard]] inline bool is_one_line(std::string_view text) {
  return text.size() > 1 && text.back() == '\n' && std::count(text.begin(), text.end(), '\n') == 1;
}

/// Bad input: exit status 2, and one line of standard error, with these words, that is all.
inline void check_refused(program_result const& ran, std::string const& expected) {
  CAPTURE(expected);
  CAPTURE(ran.err);
  CHECK(ran.status == 2);
  CHECK(ran.out == "");
  CHECK(is_one_line(ran.err));
  CHECK(contains(ran.err, expected));
}

inline void check_refused(std::string_view name, std::string const& options,
                          std::string const& expected) {
  check_refused(run(name, options), expected);
}

/// What a program prints that does what it should, without a complaint and, as there is no terminal,
/// without progress on standard error.
[[nodiscard]] inline std::string output_of(std::string_view name, std::string const& options) {
  auto const ran = run(name, options);
  CAPTURE(ran.out);
  CHECK(ran.status == 0);
  CHECK(ran.err == "");
  return ran.out;
}

/// Not converged is not success: exit status 1, and this on standard output.
inline void check_failed(std::string_view name, std::string const& options, std::string_view part) {
  auto const ran = run(name, options);
  CHECK(ran.status == 1);
  CHECK(contains(ran.out, part));
}

}  // namespace examples_test
