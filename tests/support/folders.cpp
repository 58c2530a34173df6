// SPDX-License-Identifier: MIT
#include "folders.hpp"

std::filesystem::path test::data(std::string_view name) {
  return std::filesystem::path(SLANT_TEST_DATA) / name;
}

std::filesystem::path test::program(std::string_view name) {
  return std::filesystem::path(SLANT_PROGRAMS) / name;
}
