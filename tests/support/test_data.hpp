// SPDX-License-Identifier: MIT
//
// Files that tests read.
#pragma once

#include <filesystem>
#include <string_view>

#ifndef SLANT_TEST_DATA
#define SLANT_TEST_DATA "tests/data"
#endif

namespace test {

/// A file or folder of tests/data.
[[nodiscard]] inline std::filesystem::path data(std::string_view name) {
  return std::filesystem::path(SLANT_TEST_DATA) / name;
}

}  // namespace test
