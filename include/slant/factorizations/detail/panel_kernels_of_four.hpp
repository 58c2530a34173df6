// SPDX-License-Identifier: MIT
//
// The loops of panel_kernels.hpp for four right-hand sides at a time: a panel is loaded once for
// all of them, and what limits is no longer the cache but the arithmetic.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/panel_kernels.hpp>

#include <cstddef>
#include <utility>

namespace slant::detail {

template <class T, int Bytes>
struct panel_loops_of_four {
  static constexpr index lanes = panel_loops<T, Bytes>::lanes;
  using vector = typename panel_loops<T, Bytes>::vector;

  /// `subtract`; each right-hand side is `stride` behind the one before.
  template <std::size_t... J>
  [[gnu::always_inline]] static inline void subtract(panel_columns<T> const& r, T const* p, T* y,
                                                     index stride, index rows,
                                                     std::index_sequence<J...>) {
    T const* const column[] = {r.column[J]...};
    index place = 0;
    for (; rows >= tile_rows<T>; rows -= tile_rows<T>) {
      for (index i = 0; i < tile_rows<T>; i += lanes, y += lanes) {
        vector const entries[] = {*reinterpret_cast<vector const*>(column[J] + place + i)...};
        for (index k = 0; k < 4; ++k) {
          vector v = *reinterpret_cast<vector const*>(y + k * stride);
          ((v -= p[k * panel_width + index(J)] * entries[J]), ...);
          *reinterpret_cast<vector*>(y + k * stride) = v;
        }
      }
      place += r.step;
    }
    for (index i = 0; i < rows; ++i) {
      for (index k = 0; k < 4; ++k) {
        ((y[k * stride + i] -= p[k * panel_width + index(J)] * column[J][place + i]), ...);
      }
    }
  }
  /// `products` of four columns for two right-hand sides: as many sums as there are registers for.
  template <std::size_t... J>
  [[gnu::always_inline]] static inline void products_of_two(T const* const* column, index step,
                                                            T const* y, index stride, index rows,
                                                            T* result, std::index_sequence<J...>) {
    T* const second = result + panel_width;
    vector sum[] = {(static_cast<void>(J), vector{})...};
    vector other[] = {(static_cast<void>(J), vector{})...};
    index place = 0;
    for (; rows >= tile_rows<T>; rows -= tile_rows<T>) {
      for (index i = 0; i < tile_rows<T>; i += lanes, y += lanes) {
        vector const entries[] = {*reinterpret_cast<vector const*>(column[J] + place + i)...};
        vector const v = *reinterpret_cast<vector const*>(y);
        vector const w = *reinterpret_cast<vector const*>(y + stride);
        ((sum[J] += v * entries[J]), ...);
        ((other[J] += w * entries[J]), ...);
      }
      place += step;
    }
    ((result[J] = second[J] = 0), ...);
    for (index i = 0; i < lanes; ++i) {
      ((result[J] += sum[J][i], second[J] += other[J][i]), ...);
    }
    for (index i = 0; i < rows; ++i) {
      ((result[J] += y[i] * column[J][place + i]), ...);
      ((second[J] += y[stride + i] * column[J][place + i]), ...);
    }
  }
  [[gnu::always_inline]] static inline void products(panel_columns<T> const& r, T const* y,
                                                     index stride, index rows, T* result) {
    for (index k = 0; k < 4; k += 2) {
      for (index j = 0; j < panel_width; j += 4) {
        products_of_two(r.column.data() + j, r.step, y + k * stride, stride, rows,
                        result + k * panel_width + j, std::make_index_sequence<4>{});
      }
    }
  }
};

#if defined(__x86_64__) && defined(__GNUC__)

template <class T>
[[gnu::target("avx2,fma")]] void subtract_from_four_long(panel_columns<T> const& r, T const* p,
                                                         T* y, index stride, index rows) {
  panel_loops_of_four<T, 32>::subtract(r, p, y, stride, rows, panel_sequence{});
}
template <class T>
[[gnu::target("avx2,fma")]] void products_of_four_long(panel_columns<T> const& r, T const* y,
                                                       index stride, index rows, T* result) {
  panel_loops_of_four<T, 32>::products(r, y, stride, rows, result);
}

#else

template <class T>
void subtract_from_four_long(panel_columns<T> const&, T const*, T*, index, index) {}
template <class T>
void products_of_four_long(panel_columns<T> const&, T const*, index, index, T*) {}

#endif

/// subtract_panel for four right-hand sides, y to y + 3 stride; p: panel_width numbers for each.
template <class T>
void subtract_panel_from_four(bool long_vectors, panel_columns<T> const& r, T const* p, T* y,
                              index stride, index rows) {
  if (long_vectors) {
    subtract_from_four_long(r, p, y, stride, rows);
  } else {
    panel_loops_of_four<T, 16>::subtract(r, p, y, stride, rows, panel_sequence{});
  }
}

/// panel_products for four right-hand sides, y to y + 3 stride; result: panel_width numbers each.
template <class T>
void panel_products_of_four(bool long_vectors, panel_columns<T> const& r, T const* y, index stride,
                            index rows, T* result) {
  if (long_vectors) {
    products_of_four_long(r, y, stride, rows, result);
  } else {
    panel_loops_of_four<T, 16>::products(r, y, stride, rows, result);
  }
}

}  // namespace slant::detail
