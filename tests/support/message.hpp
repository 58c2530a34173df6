// SPDX-License-Identifier: MIT
//
// What an exception says, for tests of messages.
#pragma once

#include <slant/concepts/bad_input.hpp>

#include <string>
#include <string_view>

namespace test {

/// The complaint of f about its input, or "nothing thrown".
template <class F>
std::string complaint(F f) {
  try {
    f();
  } catch (slant::bad_input const& e) {
    return e.what();
  }
  return "nothing thrown";
}

/// The complaint of one expression.
#define SLANT_COMPLAINT(...) test::complaint([&] { static_cast<void>(__VA_ARGS__); })

[[nodiscard]] inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace test
