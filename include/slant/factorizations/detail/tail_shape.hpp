// SPDX-License-Identifier: MIT
//
// Where the entries of the packed trailing part of a factor are (tail_factor.hpp).
#pragma once

#include <slant/concepts/scalar.hpp>

#include <algorithm>
#include <vector>

namespace slant::detail {

/// Supernodes in order of elimination.
class tail_shape {
 public:
  static constexpr index width = 8;        ///< columns of a panel
  static constexpr index row_padding = 4;  ///< rows below are padded to a multiple of this

  struct supernode {
    index first;    ///< number of its first column
    index columns;  ///< number of columns
    index below;    ///< rows below its last column
    index rows;     ///< where these begin in rows()
    index values;   ///< where its panels begin among the values

    [[nodiscard]] index padded_columns() const { return (columns + width - 1) / width * width; }
    /// Rows, padding included.
    [[nodiscard]] index height() const {
      return padded_columns() + (below + row_padding - 1) / row_padding * row_padding;
    }
    /// Number of values: panels of 8, 16, … rows less than the first.
    [[nodiscard]] index values_count() const {
      index const panels = padded_columns() / width;
      return width * (panels * height() - width * (panels * (panels - 1) / 2));
    }
  };

  /// Adds the next supernode, with the rows below it (numbers of columns that are still to come).
  template <class Rows>
  void add(index columns, Rows const& below) {
    supernodes_.push_back({size_, columns, static_cast<index>(below.size()),
                           static_cast<index>(rows_.size()), values_});
    rows_.insert(rows_.end(), below.begin(), below.end());
    size_ += columns;
    values_ += supernodes_.back().values_count();
    buffer_ = std::max(buffer_, supernodes_.back().height());
  }

  [[nodiscard]] std::vector<supernode> const& supernodes() const noexcept { return supernodes_; }
  /// The columns whose rows lie below s.
  [[nodiscard]] int const* rows(supernode const& s) const { return rows_.data() + s.rows; }
  /// Number of columns.
  [[nodiscard]] index size() const noexcept { return size_; }
  /// Number of values, padding included.
  [[nodiscard]] index values() const noexcept { return values_; }
  /// The largest height of a supernode.
  [[nodiscard]] index buffer() const noexcept { return buffer_; }

 private:
  std::vector<supernode> supernodes_;
  std::vector<int> rows_;
  index size_ = 0, values_ = 0, buffer_ = 0;
};

}  // namespace slant::detail
