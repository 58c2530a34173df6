// SPDX-License-Identifier: MIT
//
// A dense symmetric matrix of which each entry is kept, and read from memory, once. The lower
// triangle is packed in panels of eight columns, as in tail.hpp,
//
//     [ D ]   8 × 8, symmetric, all of it
//     [ R ]   all rows below
//
// and a product takes from a panel what it needs of both triangles, y_8 ← y_8 + D x_8 + Rᵀx_rows
// and y_rows ← y_rows + R x_8, while the panel is in the cache.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace slant::detail {

/// Symmetric n × n with entries of type T.
template <class T>
class packed_symmetric {
 public:
  /// Zero.
  explicit packed_symmetric(index n) : n_(n) {
    index size = 0;
    for (index c = 0; c < n; c += panel_width) {
      places_.push_back(size);
      size += square + tiles(n - c - std::min(panel_width, n - c)) * tile_size;
    }
    values_.resize(size);
    prefer_large_pages(values_.data(), size);
    values_.setZero();
  }

  [[nodiscard]] index size() const noexcept { return n_; }
  /// Bytes of the entries, padding included.
  [[nodiscard]] index bytes() const noexcept {
    return values_.size() * static_cast<index>(sizeof(T));
  }

  /// Entry (i, j), i >= j.
  [[nodiscard]] T const& operator()(index i, index j) const { return values_[place(i, j)]; }
  /// Entries (i, j) and (j, i), i >= j, become v.
  void set(index i, index j, T const& v) {
    values_[place(i, j)] = v;
    if (i / panel_width == j / panel_width) {
      index const first = j - j % panel_width;
      values_[place(first, first) + (i - first) * panel_width + (j - first)] = v;
    }
  }

  /// y ← S x; n entries each, which do not overlap.
  void multiply(T const* x, T* y) const {
    std::fill(y, y + n_, T(0));
    for (index c = 0; c < n_; c += panel_width) {
      T const* const panel = values_.data() + places_[static_cast<std::size_t>(c / panel_width)];
      index const width = std::min(panel_width, n_ - c);
      index const below = n_ - c - width;
      panel_columns<T> r{{}, tile_size};
      for (auto& column : r.column) {
        column = panel + square + (&column - r.column.data()) * tile;
      }
      T minus_x[panel_width] = {};
      for (index j = 0; j < width; ++j) minus_x[j] = -x[c + j];
      T sum[panel_width];
      subtract_panel_and_products(long_vectors_, r, minus_x, x + c + width, y + c + width, below,
                                  sum);
      for (index j = 0; j < width; ++j) {
        for (index i = 0; i < panel_width; ++i) sum[i] += x[c + j] * panel[j * panel_width + i];
      }
      for (index j = 0; j < width; ++j) y[c + j] += sum[j];
    }
  }

  /// The same in floats, made when first asked for.
  [[nodiscard]] std::shared_ptr<packed_symmetric<float> const> rounded() const {
    std::call_once(once_, [this] {
      auto result = std::make_shared<packed_symmetric<float>>(n_);
      for (index j = 0; j < n_; ++j) {
        for (index i = j; i < n_; ++i) result->set(i, j, rounded_entry<float>((*this)(i, j)));
      }
      rounded_ = std::move(result);
    });
    return rounded_;
  }

 private:
  static constexpr index tile = tile_rows<T>;
  static constexpr index tile_size = tile * panel_width;
  static constexpr index square = panel_width * panel_width;

  static index tiles(index rows) { return (rows + tile - 1) / tile; }
  [[nodiscard]] index place(index i, index j) const {
    index const column = j % panel_width;
    index const row = i - (j - column);
    index const panel = places_[static_cast<std::size_t>(j / panel_width)];
    if (row < panel_width) return panel + column * panel_width + row;
    index const below = row - panel_width;
    return panel + square + below / tile * tile_size + column * tile + below % tile;
  }

  index n_;
  std::vector<index> places_;  // of each panel among the values
  Eigen::Array<T, Eigen::Dynamic, 1> values_;
  bool long_vectors_ = has_long_vectors();
  mutable std::once_flag once_;
  mutable std::shared_ptr<packed_symmetric<float> const> rounded_;
};

}  // namespace slant::detail
