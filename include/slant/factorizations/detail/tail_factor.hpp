// SPDX-License-Identifier: MIT
//
// The trailing part L_tt of a supernodal Cholesky factor, the columns that some unknowns reach in
// the elimination tree, packed for solves with L_tt L_ttᵀ that cost little more than reading it.
//
// Intuition. Columns of one supernode share their rows. Eight of them at a time make a panel,
//
//     [ D ]   8 × 8, lower triangular; kept is D⁻¹
//     [ R ]   all rows below, in tiles of as many rows as a register of 16 bytes holds numbers
//
// and each sweep reads every panel once, front to back: x_8 ← D⁻¹x_8, x_rows ← x_rows − R x_8
// forward, x_8 ← D⁻ᵀ(x_8 − Rᵀx_rows) backward. The unknowns of a supernode, its own and those
// below, are gathered into a buffer and scattered again, so that the loops run over neighbours;
// columns are padded to whole panels and rows to whole tiles, so that no loop has a remainder.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/large_pages.hpp>
#include <slant/factorizations/detail/tail_shape.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

namespace slant::detail {

/// Right-hand sides of a tail, which become the solutions, and the buffer of the sweeps.
template <class T>
struct tail_vectors {
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> x;       ///< shape.size() rows
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> buffer;  ///< shape.buffer() rows

  tail_vectors(tail_shape const& shape, index right_hand_sides)
      : x(shape.size(), right_hand_sides), buffer(shape.buffer(), right_hand_sides) {}
};

/// L_tt with entries of type T, float or double.
template <class T>
class tail_factor {
  static constexpr index width = tail_shape::width;
  static constexpr index tile = 16 / static_cast<index>(sizeof(T));
  static_assert(tail_shape::row_padding % tile == 0);
  using packet = Eigen::Array<T, tile, 1>;
  using column = Eigen::Array<T, width, 1>;
  using square = Eigen::Matrix<T, width, width>;

 public:
  /// entry(s, r, c): the entry of L in supernode number s, column c, row r ≥ c of it; rows count on
  /// below the columns.
  template <class Entry>
  tail_factor(std::shared_ptr<tail_shape const> shape, Entry entry)
      : shape_(std::move(shape)), values_(shape_->values()) {
    T* place = values_.data();
    prefer_large_pages(place, values_.size());
    for (std::size_t k = 0; k < shape_->supernodes().size(); ++k) {
      auto const& s = shape_->supernodes()[k];
      auto const value = [&](index r, index c) {  // in padded numbers
        index const first_below = s.padded_columns();
        bool const padding =
            c >= s.columns || (r >= s.columns && r < first_below) || r >= first_below + s.below;
        if (padding) return T(r == c ? 1 : 0);
        return T(entry(k, r < s.columns ? r : r - first_below + s.columns, c));
      };
      for (index c = 0; c < s.padded_columns(); c += width) {
        square d = square::Zero();
        for (index j = 0; j < width; ++j)
          for (index i = j; i < width; ++i) d(i, j) = value(c + i, c + j);
        Eigen::Map<square>{place} =
            d.template triangularView<Eigen::Lower>().solve(square::Identity());
        place += width * width;
        for (index r = c + width; r < s.height(); r += tile)
          for (index j = 0; j < width; ++j)
            for (index i = 0; i < tile; ++i) *place++ = value(r + i, c + j);
      }
    }
  }
  /// The same, rounded to T. What is smaller than any entry that matters becomes zero, because
  /// processors are slow with numbers below the smallest normal one.
  template <class U>
  explicit tail_factor(tail_factor<U> const& other) : shape_(other.shape()) {
    values_.resize(other.values().size());
    U const least = U(std::numeric_limits<T>::min()) / U(std::numeric_limits<T>::epsilon());
    U const most = U(std::numeric_limits<T>::max());
    constexpr index old_tile = 16 / static_cast<index>(sizeof(U));
    T* place = values_.data();
    prefer_large_pages(place, values_.size());
    U const* from = other.values().data();
    auto const copy = [&](index offset) {
      U const v = std::clamp(from[offset], -most, most);
      *place++ = v < least && -v < least ? T(0) : static_cast<T>(v);
    };
    for (auto const& s : shape_->supernodes()) {
      for (index c = 0; c < s.padded_columns(); c += width) {
        for (index i = 0; i < width * width; ++i) copy(i);
        from += width * width;
        index const rows = s.height() - c - width;
        for (index r = 0; r < rows; r += tile)
          for (index j = 0; j < width; ++j)
            for (index i = r; i < r + tile; ++i) {
              copy((i / old_tile * width + j) * old_tile + i % old_tile);
            }
        from += rows * width;
      }
    }
  }

  [[nodiscard]] std::shared_ptr<tail_shape const> const& shape() const noexcept { return shape_; }
  [[nodiscard]] Eigen::Array<T, Eigen::Dynamic, 1> const& values() const noexcept {
    return values_;
  }

  /// The same in floats, made when first asked for.
  [[nodiscard]] std::shared_ptr<tail_factor<float> const> rounded() const
    requires std::same_as<T, double>
  {
    std::call_once(once_, [this] { rounded_ = std::make_shared<tail_factor<float>>(*this); });
    return rounded_;
  }

  /// v.x ← (L_tt L_ttᵀ)⁻¹ v.x.
  void solve_in_place(tail_vectors<T>& v) const {
    auto const& all = shape_->supernodes();
    for (auto s = all.begin(); s != all.end(); ++s) {
      gather(*s, v);
      forward(*s, v);
      scatter(*s, v, true);
    }
    for (auto s = all.rbegin(); s != all.rend(); ++s) {
      gather(*s, v);
      backward(*s, v);
      scatter(*s, v, false);
    }
  }

 private:
  void gather(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    int const* const rows = shape_->rows(s);
    for (index k = 0; k < v.x.cols(); ++k) {
      T const* const x = v.x.data() + k * v.x.rows();
      T* y = v.buffer.data() + k * v.buffer.rows();
      std::copy(x + s.first, x + s.first + s.columns, y);
      std::fill(y + s.columns, y + s.padded_columns(), T(0));
      y += s.padded_columns();
      for (index i = 0; i < s.below; ++i) y[i] = x[rows[i]];
      std::fill(y + s.below, y + (s.height() - s.padded_columns()), T(0));
    }
  }

  void scatter(tail_shape::supernode const& s, tail_vectors<T>& v, bool below) const {
    int const* const rows = shape_->rows(s);
    for (index k = 0; k < v.x.cols(); ++k) {
      T* const x = v.x.data() + k * v.x.rows();
      T const* y = v.buffer.data() + k * v.buffer.rows();
      std::copy(y, y + s.columns, x + s.first);
      y += s.padded_columns();
      for (index i = 0; below && i < s.below; ++i) x[rows[i]] = y[i];
    }
  }

  void forward(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    T const* panel = values_.data() + s.values;
    for (index c = 0; c < s.padded_columns(); c += width) {
      for (index k = 0; k < v.x.cols(); ++k) {
        T* const y = v.buffer.data() + k * v.buffer.rows();
        column p = column::Zero();
        for (index j = 0; j < width; ++j) p += y[c + j] * at<column>(panel + j * width);
        Eigen::Map<column>{y + c} = p;
        subtract(panel + width * width, p, y + c + width, y + s.height(),
                 std::make_index_sequence<width>{});
      }
      panel += width * (s.height() - c);
    }
  }

  void backward(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    T const* panel = values_.data() + s.values + s.values_count();
    for (index c = s.padded_columns() - width; c >= 0; c -= width) {
      panel -= width * (s.height() - c);
      for (index k = 0; k < v.x.cols(); ++k) {
        T* const y = v.buffer.data() + k * v.buffer.rows();
        column p = Eigen::Map<column>{y + c};
        p -= products(panel + width * width, y + c + width, y + s.height(),
                      std::make_index_sequence<width>{});
        for (index j = 0; j < width; ++j) y[c + j] = (p * at<column>(panel + j * width)).sum();
      }
    }
  }

  template <class V>
  static Eigen::Map<V const, Eigen::Aligned16> at(T const* place) {
    return Eigen::Map<V const, Eigen::Aligned16>(place);
  }

  /// y ← y − R p.
  template <std::size_t... J>
  static void subtract(T const* r, column const& p, T* y, T const* end, std::index_sequence<J...>) {
    std::array<packet, width> const factor{packet::Constant(p[J])...};
    for (; y != end; y += tile, r += tile * width) {
      packet rows = Eigen::Map<packet const>(y);
      ((rows -= at<packet>(r + index(J) * tile) * factor[J]), ...);
      Eigen::Map<packet>{y} = rows;
    }
  }
  /// Rᵀy.
  template <std::size_t... J>
  static column products(T const* r, T const* y, T const* end, std::index_sequence<J...>) {
    std::array<packet, width> sums{(static_cast<void>(J), packet(packet::Zero()))...};
    for (; y != end; y += tile, r += tile * width) {
      packet const rows = Eigen::Map<packet const>(y);
      ((sums[J] += at<packet>(r + index(J) * tile) * rows), ...);
    }
    column p;
    ((p[index(J)] = sums[J].sum()), ...);
    return p;
  }

  std::shared_ptr<tail_shape const> shape_;
  Eigen::Array<T, Eigen::Dynamic, 1> values_;
  mutable std::once_flag once_;
  mutable std::shared_ptr<tail_factor<float> const> rounded_;
};

}  // namespace slant::detail
