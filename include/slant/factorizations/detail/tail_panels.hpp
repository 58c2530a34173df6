// SPDX-License-Identifier: MIT
//
// L_tt (tail_shape.hpp) packed and rounded: each panel as D⁻¹ and the rows below in tiles of
// 32 bytes of each column, one after the other, so that a sweep reads one long stream. Columns are
// padded to whole panels and rows to whole tiles.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/large_pages.hpp>
#include <slant/factorizations/detail/panel_kernels.hpp>
#include <slant/factorizations/detail/rounded_entry.hpp>
#include <slant/factorizations/detail/tail_solve.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <vector>

namespace slant::detail {

/// L_tt with entries of type T.
template <class T>
class tail_panels {
 public:
  /// From entries elsewhere, in another precision (rounded_entry.hpp).
  template <class Storage>
  explicit tail_panels(Storage const& from) : shape_(from.shared_shape()) {
    index size = 0;
    for (auto const& s : shape_->supernodes()) {
      for (index c = 0; c < s.columns; c += panel_width) {
        places_.push_back(size);
        size += square + tiles(s, c) * tile_size;
      }
    }
    values_.resize(size);
    prefer_large_pages(values_.data(), size);
    T* place = values_.data();
    for (auto const& s : shape_->supernodes()) {
      for (index c = 0; c < s.columns; c += panel_width) {
        index const width = std::min(panel_width, s.columns - c);
        auto const panel = from.panel(s, c);
        place = std::transform(panel.inverse, panel.inverse + square, place,
                               [](auto const& v) { return rounded_entry<T>(v); });
        for (index row = 0; row < tiles(s, c) * tile; row += tile) {
          index const rows = std::min(tile, s.height() - c - width - row);
          for (index j = 0; j < panel_width; ++j, place += tile) {
            auto const* const entries = panel.below.column[static_cast<std::size_t>(j)] + row;
            index const count = j < width ? rows : 0;
            std::transform(entries, entries + count, place,
                           [](auto const& v) { return rounded_entry<T>(v); });
            std::fill(place + count, place + tile, T(0));
          }
        }
      }
    }
  }

  [[nodiscard]] tail_shape const& shape() const noexcept { return *shape_; }
  /// Bytes of the entries, padding included.
  [[nodiscard]] index bytes() const noexcept {
    return values_.size() * static_cast<index>(sizeof(T));
  }

  [[nodiscard]] tail_panel<T> panel(tail_shape::supernode const& s, index c) const {
    auto const number = static_cast<std::size_t>(s.panels + c / panel_width);
    T const* const place = values_.data() + places_[number];
    tail_panel<T> result{place, {{}, tile_size}};
    for (auto& column : result.below.column) {
      column = place + square + (&column - result.below.column.data()) * tile;
    }
    return result;
  }

 private:
  static constexpr index tile = tile_rows<T>;
  static constexpr index tile_size = tile * panel_width;
  static constexpr index square = panel_width * panel_width;

  /// Tiles below the panel that begins at column c of s.
  static index tiles(tail_shape::supernode const& s, index c) {
    return (s.height() - std::min(c + panel_width, s.columns) + tile - 1) / tile;
  }

  std::shared_ptr<tail_shape const> shape_;
  std::vector<index> places_;  // of each panel among the values
  Eigen::Array<T, Eigen::Dynamic, 1> values_;
};

}  // namespace slant::detail
