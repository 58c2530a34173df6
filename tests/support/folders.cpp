// SPDX-License-Identifier: MIT
#include "folders.hpp"

std::filesystem::path test::source(std::string_view name) {
  return std::filesystem::path(SLANT_SOURCE) / name;
}

std::filesystem::path test::data(std::string_view name) {
  return test::source("tests/data") / name;
}

std::filesystem::path test::program(std::string_view name) {
  return std::filesystem::path(SLANT_PROGRAMS) / name;
}
