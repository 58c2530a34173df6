// SPDX-License-Identifier: MIT
//
// The one exception for data that a caller got wrong. It names the argument, its value and what was
// expected. Trouble that arises while computing is never an exception: it is a status in the
// report.
#pragma once

#include <charconv>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace slant {

namespace detail {

/// Text of anything that can be streamed; of a floating-point number the shortest that means it.
template <class T>
[[nodiscard, gnu::cold]] std::string show(T const& value) {
  if constexpr (std::is_floating_point_v<T>) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
  } else {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  }
}

}  // namespace detail

/// Thrown at construction or at the start of a run when an argument cannot be used.
/// what() reads "radius: got -1, expected a number >= 0".
class bad_input : public std::invalid_argument {
 public:
  [[gnu::cold]] bad_input(std::string_view argument, std::string_view value,
                          std::string_view expectation)
      : std::invalid_argument(std::string(argument)
                                  .append(": got ")
                                  .append(value)
                                  .append(", expected ")
                                  .append(expectation)),
        name_length_(argument.size()) {}

  /// The same complaint about entry i of an array of such arguments: "radius[3]: got -1, …".
  [[nodiscard, gnu::cold]] bad_input at(std::ptrdiff_t i) const {
    std::string_view const text = what();
    std::string changed(text.substr(0, name_length_));
    changed.append("[").append(detail::show(i)).append("]");
    std::size_t const length = changed.size();
    changed.append(text.substr(name_length_));
    return {changed, length};
  }

 private:
  bad_input(std::string const& text, std::size_t name_length)
      : std::invalid_argument(text), name_length_(name_length) {}

  std::size_t name_length_;
};

}  // namespace slant
