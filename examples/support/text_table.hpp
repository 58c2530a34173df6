// SPDX-License-Identifier: MIT
//
// Tables as text, printed row by row while the rows are computed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace examples {

/// Columns under their names, all right-aligned.
class text_table {
 public:
  /// Columns are as wide as their names, and `least` characters at least.
  explicit text_table(std::vector<std::string> names, std::size_t least = 7)
      : names_(std::move(names)) {
    for (auto const& name : names_) widths_.push_back(std::max(columns_of(name), least));
  }

  void print_head() const { print_row(names_); }
  /// One line; a cell that is too long pushes the rest to the right.
  void print_row(std::vector<std::string> const& cells) const {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::size_t const width = i < widths_.size() ? widths_[i] : 0;
      std::size_t const taken = columns_of(cells[i]);
      line.append(i == 0 ? 0 : 2, ' ');
      line.append(width > taken ? width - taken : 0, ' ');
      line += cells[i];
    }
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  }

 private:
  /// Characters of a UTF-8 text: its bytes that do not continue one.
  static std::size_t columns_of(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
  }

  std::vector<std::string> names_;
  std::vector<std::size_t> widths_;
};

}  // namespace examples
