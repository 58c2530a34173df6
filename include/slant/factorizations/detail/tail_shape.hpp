// SPDX-License-Identifier: MIT
//
// The structure of L_tt, the trailing part of a supernodal Cholesky factor: the columns that some
// unknowns reach in the elimination tree. Its entries: tail_columns.hpp where they were computed,
// tail_panels.hpp packed and rounded; sweeps with either: tail_solve.hpp.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/panel_kernels.hpp>

#include <algorithm>
#include <vector>

namespace slant::detail {

/// Supernodes in order of elimination.
class tail_shape {
 public:
  struct supernode {
    index first;    ///< number of its first column
    index columns;  ///< number of columns
    index below;    ///< rows below its last column
    index rows;     ///< where these begin in rows()
    index panels;   ///< panels of the supernodes before

    [[nodiscard]] index height() const { return columns + below; }
    /// Panels of eight columns; the last may have less.
    [[nodiscard]] index panel_count() const { return (columns + panel_width - 1) / panel_width; }
  };

  /// Adds the next supernode, with the rows below it (numbers of columns that are still to come).
  template <class Rows>
  void add(index columns, Rows const& below) {
    supernode const s{size_, columns, static_cast<index>(below.size()),
                      static_cast<index>(rows_.size()), panels_};
    supernodes_.push_back(s);
    rows_.insert(rows_.end(), below.begin(), below.end());
    size_ += columns;
    panels_ += s.panel_count();
    entries_ += columns * (columns + 1) / 2 + columns * s.below;
    height_ = std::max(height_, s.height());
  }

  [[nodiscard]] std::vector<supernode> const& supernodes() const noexcept { return supernodes_; }
  /// The columns whose rows lie below s.
  [[nodiscard]] int const* rows(supernode const& s) const { return rows_.data() + s.rows; }
  /// Number of columns.
  [[nodiscard]] index size() const noexcept { return size_; }
  /// Number of panels of all supernodes.
  [[nodiscard]] index panels() const noexcept { return panels_; }
  /// Number of entries of L_tt.
  [[nodiscard]] index entries() const noexcept { return entries_; }
  /// The largest height of a supernode.
  [[nodiscard]] index height() const noexcept { return height_; }

 private:
  std::vector<supernode> supernodes_;
  std::vector<int> rows_;
  index size_ = 0, panels_ = 0, entries_ = 0, height_ = 0;
};

}  // namespace slant::detail
