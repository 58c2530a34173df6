// SPDX-License-Identifier: MIT
//
// Where files that tests read and programs that they run are. Paths of the checkout are compiled into
// folders.cpp alone, so that another checkout finds the other objects in the compiler's cache.
#pragma once

#include <filesystem>
#include <string_view>

namespace test {

/// A file or folder of the checkout.
[[nodiscard]] std::filesystem::path source(std::string_view name);

/// A file or folder of tests/data.
[[nodiscard]] std::filesystem::path data(std::string_view name);

/// An example program.
[[nodiscard]] std::filesystem::path program(std::string_view name);

}  // namespace test
