// SPDX-License-Identifier: MIT
//
// Any text as a vector: it is refused by bad_input in one printable line, or gives the numbers that
// strtod finds in its words. A text cut anywhere is refused or gives a vector that the whole one
// begins with. The first byte chooses the options.
#include "bytes.hpp"

#include <slant/io/text_vector.hpp>

namespace {

using vector = Eigen::VectorXd;

bool parse(std::string_view text, slant::text_vector_options const& options, vector& x) {
  try {
    x = slant::parse_text_vector(text, "x.txt", options);
    return true;
  } catch (slant::bad_input const& refusal) {
    fuzz::demand_message(refusal.what());
    return false;
  }
}

/// The words of a text that was accepted, read by the C library.
void compare(std::string_view text, vector const& x) {
  slant::index found = 0;
  while (!text.empty()) {
    std::string line(text.substr(0, text.find('\n')));
    text.remove_prefix(line.size() + 1);
    std::size_t const first = line.find_first_not_of(" \t\r");
    if (first == line.npos || line[first] == '#') continue;
    double const value = std::strtod(line.c_str() + first, nullptr);
    fuzz::demand(
        found < x.size() && x[found] == value && std::signbit(x[found]) == std::signbit(value),
        "the number that strtod finds");
    ++found;
  }
  fuzz::demand(found == x.size(), "one number a line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  int const choice = data[0];
  std::string_view const text(reinterpret_cast<char const*>(data) + 1, size - 1);
  slant::text_vector_options options{.allow_infinity = choice % 2 == 1};
  if (choice >= 128) options.size = choice % 16 / 2;
  vector x, part, again;
  if (!parse(text, options, x)) return 0;
  compare(text, x);
  if (options.size) fuzz::demand(x.size() == *options.size, "as many numbers as asked for");
  if (!options.allow_infinity) fuzz::demand(x.allFinite(), "finite numbers");

  std::string written;
  for (double const value : x) {
    slant::detail::append_number(written, value);
    written += '\n';
  }
  fuzz::demand(parse(written, options, again) && again == x, "the vector is read again");

  options.size.reset();
  std::size_t const cut =
      text.empty() ? 0 : (static_cast<std::size_t>(choice) * 7919) % text.size();
  if (parse(text.substr(0, cut), options, part))
    fuzz::demand(part.size() <= x.size() && part == x.head(part.size()),
                 "a cut text is refused or gives the first numbers");
  return 0;
}
