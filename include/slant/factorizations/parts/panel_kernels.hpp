// SPDX-License-Identifier: MIT
//
// The two loops in which sweeps with a factor spend their time: eight columns R, side by side, and
// rows y beside them,
//
//     y ← y − R p        forward,          Rᵀy        backward,
//
// and both in one, for products with symmetric matrices. For one or four right-hand sides.
//
// Each is written once with the vectors of the compiler, 16 or 32 bytes long, and compiled for
// both; which one runs is asked of the processor. Compilers that are told nothing of it would use
// the short ones only, and a factor that lies in the cache would be read at half the speed.
#pragma once

#include <slant/base/long_arrays.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace slant::detail {

/// Columns of a panel.
inline constexpr index panel_width = 8;
/// Rows of a panel that are stored together, 32 bytes of a column.
template <class T>
inline constexpr index tile_rows = 32 / static_cast<index>(sizeof(T));

/// Eight columns: row i of tile t in column j is column[j][t · step + i]. In a matrix stored by
/// columns a tile is just the next rows.
template <class T>
struct panel_columns {
  std::array<T const*, static_cast<std::size_t>(panel_width)> column;
  index step;
};
/// Column j begins at first + j · apart.
template <class T>
[[nodiscard]] panel_columns<T> panel_from(T const* first, index apart, index step) {
  panel_columns<T> r{{}, step};
  for (auto& c : r.column) c = first + (&c - r.column.data()) * apart;
  return r;
}

template <class T, int Bytes>
struct panel_loops {
  static constexpr index lanes = Bytes / static_cast<index>(sizeof(T));
  static_assert(tile_rows<T> % lanes == 0);
  typedef T vector __attribute__((vector_size(Bytes), aligned(sizeof(T)), may_alias));

  template <std::size_t... J>
  [[gnu::always_inline]] static inline void subtract(panel_columns<T> const& r, T const* p, T* y,
                                                     index rows, std::index_sequence<J...>) {
    vector const factor[] = {(p[J] - vector{})...};
    T const* const column[] = {r.column[J]...};
    index place = 0;
    for (; rows >= tile_rows<T>; rows -= tile_rows<T>) {
      for (index i = 0; i < tile_rows<T>; i += lanes, y += lanes) {
        vector v = *reinterpret_cast<vector const*>(y);
        ((v -= factor[J] * *reinterpret_cast<vector const*>(column[J] + place + i)), ...);
        *reinterpret_cast<vector*>(y) = v;
      }
      place += r.step;
    }
    for (index i = 0; i < rows; ++i) ((y[i] -= p[J] * column[J][place + i]), ...);
  }

  template <std::size_t... J>
  [[gnu::always_inline]] static inline void products(panel_columns<T> const& r, T const* y,
                                                     index rows, T* result,
                                                     std::index_sequence<J...>) {
    vector sum[] = {(static_cast<void>(J), vector{})...};
    T const* const column[] = {r.column[J]...};
    index place = 0;
    for (; rows >= tile_rows<T>; rows -= tile_rows<T>) {
      for (index i = 0; i < tile_rows<T>; i += lanes, y += lanes) {
        vector const v = *reinterpret_cast<vector const*>(y);
        ((sum[J] += v * *reinterpret_cast<vector const*>(column[J] + place + i)), ...);
      }
      place += r.step;
    }
    ((result[J] = 0), ...);
    for (index i = 0; i < lanes; ++i) ((result[J] += sum[J][i]), ...);
    for (index i = 0; i < rows; ++i) {
      ((result[J] += y[i] * column[J][place + i]), ...);
    }
  }

  /// Both at once, of rows x and y: y ← y − R p, result ← Rᵀx.
  template <std::size_t... J>
  [[gnu::always_inline]] static inline void both(panel_columns<T> const& r, T const* p, T const* x,
                                                 T* y, index rows, T* result,
                                                 std::index_sequence<J...>) {
    vector const factor[] = {(p[J] - vector{})...};
    vector sum[] = {(static_cast<void>(J), vector{})...};
    T const* const column[] = {r.column[J]...};
    index place = 0;
    for (; rows >= tile_rows<T>; rows -= tile_rows<T>) {
      for (index i = 0; i < tile_rows<T>; i += lanes, x += lanes, y += lanes) {
        vector const w = *reinterpret_cast<vector const*>(x);
        vector const entries[] = {*reinterpret_cast<vector const*>(column[J] + place + i)...};
        vector v = *reinterpret_cast<vector const*>(y);
        ((sum[J] += w * entries[J]), ...);
        ((v -= factor[J] * entries[J]), ...);
        *reinterpret_cast<vector*>(y) = v;
      }
      place += r.step;
    }
    ((result[J] = 0), ...);
    for (index i = 0; i < lanes; ++i) ((result[J] += sum[J][i]), ...);
    for (index i = 0; i < rows; ++i) {
      ((result[J] += x[i] * column[J][place + i]), ...);
      ((y[i] -= p[J] * column[J][place + i]), ...);
    }
  }
};

using panel_sequence = std::make_index_sequence<static_cast<std::size_t>(panel_width)>;

#if defined(__x86_64__) && defined(__GNUC__)

/// Whether this processor has vectors of 32 bytes.
[[nodiscard]] inline bool has_long_vectors() {
  static bool const has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

[[gnu::target("avx2,fma")]] void run_long(auto loop) {
  loop.template operator()<32>();
}

#else

[[nodiscard]] inline bool has_long_vectors() {
  return false;
}

void run_long(auto) {}

#endif

/// loop<bytes>(), which must be inlined, with vectors of 32 or of 16 bytes.
void run_panel_loop(bool long_vectors, auto loop) {
  if (long_vectors) {
    run_long(loop);
  } else {
    loop.template operator()<16>();
  }
}

/// y ← y − R p; p: panel_width numbers, y: so many rows.
template <class T>
void subtract_panel(bool long_vectors, panel_columns<T> const& r, T const* p, T* y, index rows) {
  run_panel_loop(
      long_vectors, [ =, &r ]<int Bytes>() __attribute__((always_inline)) {
        panel_loops<T, Bytes>::subtract(r, p, y, rows, panel_sequence{});
      });
}

/// result ← Rᵀy; result: panel_width numbers.
template <class T>
void panel_products(bool long_vectors, panel_columns<T> const& r, T const* y, index rows,
                    T* result) {
  run_panel_loop(
      long_vectors, [ =, &r ]<int Bytes>() __attribute__((always_inline)) {
        panel_loops<T, Bytes>::products(r, y, rows, result, panel_sequence{});
      });
}

/// y ← y − R p and result ← Rᵀx; p, result: panel_width numbers, x, y: so many rows.
template <class T>
void subtract_panel_and_products(bool long_vectors, panel_columns<T> const& r, T const* p,
                                 T const* x, T* y, index rows, T* result) {
  run_panel_loop(
      long_vectors, [ =, &r ]<int Bytes>() __attribute__((always_inline)) {
        panel_loops<T, Bytes>::both(r, p, x, y, rows, result, panel_sequence{});
      });
}

// --- four at a time ------------------------------------------------------------------------------
//
// The same loops for four right-hand sides at a time: a panel is loaded once for
// all of them, and what limits is no longer the cache but the arithmetic.

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

/// subtract_panel for four right-hand sides, y to y + 3 stride; p: panel_width numbers for each.
template <class T>
void subtract_panel_from_four(bool long_vectors, panel_columns<T> const& r, T const* p, T* y,
                              index stride, index rows) {
  run_panel_loop(
      long_vectors, [ =, &r ]<int Bytes>() __attribute__((always_inline)) {
        panel_loops_of_four<T, Bytes>::subtract(r, p, y, stride, rows, panel_sequence{});
      });
}

/// panel_products for four right-hand sides, y to y + 3 stride; result: panel_width numbers each.
template <class T>
void panel_products_of_four(bool long_vectors, panel_columns<T> const& r, T const* y, index stride,
                            index rows, T* result) {
  run_panel_loop(
      long_vectors, [ =, &r ]<int Bytes>() __attribute__((always_inline)) {
        panel_loops_of_four<T, Bytes>::products(r, y, stride, rows, result);
      });
}

/// The value in a shorter precision. What is smaller than any entry that matters becomes zero,
/// because processors are slow with numbers below the smallest normal one; what is too large the
/// largest number.
template <class T, class U>
[[nodiscard]] T rounded_entry(U const& value) {
  U const least = U(std::numeric_limits<T>::min()) / U(std::numeric_limits<T>::epsilon());
  U const most = U(std::numeric_limits<T>::max());
  U const v = std::clamp(value, -most, most);
  return v < least && -v < least ? T(0) : static_cast<T>(v);
}

// --- packed symmetric ----------------------------------------------------------------------------
//
// A dense symmetric matrix of which each entry is kept, and read from memory, once. The lower
// triangle is packed in panels of eight columns, as in tail.hpp,
//
//     [ D ]   8 × 8, symmetric, all of it
//     [ R ]   all rows below
//
// and a product takes from a panel what it needs of both triangles, y_8 ← y_8 + D x_8 + Rᵀx_rows
// and y_rows ← y_rows + R x_8, while the panel is in the cache.

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
      auto const r = panel_from(panel + square, tile, tile_size);
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
