// SPDX-License-Identifier: MIT
//
// Pictures through gnuplot. The script, data included, stays beside the picture, so that a reader
// can change and repeat it. A missing gnuplot is not an error of the computation: it is a message.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace fem {

/// Whether the picture exists now; if not, why.
struct plot_result {
  bool written = false;
  std::string message;  ///< one line for the reader, in both cases
};

namespace detail {

/// A word of a shell command, or a gnuplot string when `quote_inside` is two single quotes.
[[nodiscard]] inline std::string single_quoted(std::string_view text,
                                               std::string_view quote_inside) {
  std::string result = "'";
  for (char c : text) {
    if (c == '\'')
      result += quote_inside;
    else
      result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

[[nodiscard]] inline std::string shell_word(std::string_view text) {
  return single_quoted(text, "'\\''");
}

}  // namespace detail

/// Text as a gnuplot string constant.
[[nodiscard]] inline std::string gnuplot_string(std::string_view text) {
  return detail::single_quoted(text, "''");
}

/// Size of a picture in pixels.
struct picture_size {
  int width;
  int height;
};

/// Opening lines of a script that draws `picture` as a PNG.
[[nodiscard]] inline std::string gnuplot_preamble(std::filesystem::path const& picture,
                                                  picture_size size) {
  return "set encoding utf8\nset terminal pngcairo size " + std::to_string(size.width) + "," +
         std::to_string(size.height) + " font 'Sans,13' background rgb 'white'\nset output " +
         gnuplot_string(picture.filename().string()) + "\n";
}

/// Saves the script beside the picture with the extension .gp and runs it there. `program` is the
/// gnuplot to call. Never throws for anything that happens outside: the result says what did.
[[nodiscard]] inline plot_result run_gnuplot(std::filesystem::path const& picture,
                                             std::string const& script,
                                             std::string const& program = "gnuplot") {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::remove(picture, ignored);  // an old picture must not pass for the new one

  fs::path source = picture;
  source.replace_extension(".gp");
  {
    std::ofstream file(source, std::ios::binary);
    file << script;
    if (!file.flush()) return {false, "no picture: cannot write " + source.string()};
  }
  fs::path const folder = picture.has_parent_path() ? picture.parent_path() : fs::path(".");
  std::string const word = detail::shell_word(program);
  if (std::system(("command -v " + word + " >/dev/null 2>&1").c_str()) != 0)
    return {false, "no picture: " + program +
                       " was not found (Debian package gnuplot-nox); it would draw " +
                       source.string()};
  std::string const command = "cd -- " + detail::shell_word(folder.string()) + " && " + word + " " +
                              detail::shell_word("./" + source.filename().string());
  int const status = std::system(command.c_str());
  if (status != 0 || !fs::exists(picture, ignored)) {
    fs::remove(picture, ignored);
    int const code = WIFEXITED(status) ? WEXITSTATUS(status) : status;
    return {false, "no picture: " + program + " failed on " + source.string() + " with status " +
                       std::to_string(code)};
  }
  return {true, "wrote " + picture.string()};
}

}  // namespace fem
