// SPDX-License-Identifier: MIT
//
// What the tests of this room share: a folder that disappears again, and files in it.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace io_test {

namespace fs = std::filesystem;

/// A new empty folder among the temporary files of the system, removed at the end of the scope.
class temporary_folder {
 public:
  temporary_folder() {
    static std::atomic<int> counter{0};
    do {
      path_ = fs::temp_directory_path() /
              ("slant-io-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    } while (!fs::create_directory(path_));
  }
  temporary_folder(temporary_folder const&) = delete;
  temporary_folder& operator=(temporary_folder const&) = delete;
  ~temporary_folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  [[nodiscard]] fs::path const& path() const { return path_; }
  [[nodiscard]] fs::path operator/(std::string_view name) const { return path_ / name; }

  /// Number of directory entries, hidden ones included.
  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
  }

 private:
  fs::path path_;
};

inline void put(fs::path const& file, std::string_view text) {
  std::ofstream(file, std::ios::binary) << text;
}

[[nodiscard]] inline std::string get(fs::path const& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace io_test
