// SPDX-License-Identifier: MIT
//
// Lists of methods that can be asked for by name. The first of a list is recommended, and taken
// unless another is asked for.
#pragma once

#include <cstdio>
#include <slant/concepts/bad_input.hpp>
#include <string>
#include <string_view>

namespace from_files {

/// The method of that name; the recommended one for an empty name. Throws slant::bad_input that
/// lists the known names, followed by `where`.
template <class List>
[[nodiscard]] auto const& method_named(List const& list, std::string_view name,
                                       std::string_view where = "") {
  if (name.empty()) return list.front();
  std::string known;
  for (auto const& method : list) {
    if (method.name == name) return method;
    known.append(known.empty() ? "" : ", ").append(method.name);
  }
  throw slant::bad_input("--method", name, "one of " + known.append(where));
}

/// A line for each of them.
template <class List>
void print_methods(List const& list) {
  for (auto const& method : list) {
    std::printf("%-20s %s%s\n", method.name.data(), method.sentence.data(),
                method.name == list.front().name ? " (recommended)" : "");
  }
}

}  // namespace from_files
