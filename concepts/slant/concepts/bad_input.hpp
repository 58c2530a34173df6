// SPDX-License-Identifier: MIT
//
// The one exception for data that a caller got wrong. It names the argument, its value and what was
// expected. Trouble that arises while computing is never an exception: it is a status in the
// report.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace slant {

namespace detail {

/// Text of anything that can be streamed, with enough digits to tell neighbouring doubles apart.
template <class T>
[[nodiscard]] std::string show(T const& value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

}  // namespace detail

/// Thrown at construction or at the start of a run when an argument cannot be used.
/// what() reads "radius: got -1, expected a number >= 0".
class bad_input : public std::invalid_argument {
 public:
  bad_input(std::string_view argument, std::string_view value, std::string_view expectation)
      : std::invalid_argument(std::string(argument)
                                  .append(": got ")
                                  .append(value)
                                  .append(", expected ")
                                  .append(expectation)) {}
};

}  // namespace slant
