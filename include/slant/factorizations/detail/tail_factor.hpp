// SPDX-License-Identifier: MIT
//
// The trailing part L_tt of a supernodal Cholesky factor, the columns that some unknowns reach in the
// elimination tree, packed for solves with L_tt L_ttᵀ that cost little more than reading it.
//
// Intuition. Columns of one supernode share their rows. Eight of them at a time make a panel,
//
//     [ D ]   8 × 8, lower triangular; kept is D⁻¹
//     [ R ]   all rows below, stored row by row
//
// and each sweep reads every panel once, front to back: x_8 ← D⁻¹x_8, x_rows ← x_rows − R x_8 forward,
// x_8 ← D⁻ᵀ(x_8 − Rᵀx_rows) backward. Rows outside of the supernode are gathered into a buffer before
// and scattered after its panels, so that the loops run over neighbours.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace slant::detail {

/// Where the entries of L_tt are: its supernodes, in order of elimination.
class tail_shape {
 public:
  static constexpr index width = 8;  ///< columns of a panel

  struct supernode {
    index first;    ///< number of its first column
    index columns;  ///< number of columns
    index below;    ///< rows below its last column
    index rows;     ///< where these begin in rows()
    index values;   ///< where its panels begin among the values
  };

  /// Adds the next supernode, with the rows below it (numbers of columns that are still to come).
  template <class Rows>
  void add(index columns, Rows const& below) {
    supernodes_.push_back({size_, columns, static_cast<index>(below.size()),
                           static_cast<index>(rows_.size()), values_});
    rows_.insert(rows_.end(), below.begin(), below.end());
    size_ += columns;
    most_below_ = std::max(most_below_, static_cast<index>(below.size()));
    for (index c = 0; c < columns; c += width) {
      values_ += width * width + width * rows_of_panel(supernodes_.back(), c);
    }
  }

  /// Rows below the triangle of the panel that begins with column c of a supernode.
  [[nodiscard]] static index rows_of_panel(supernode const& s, index c) {
    return s.columns - std::min(s.columns, c + width) + s.below;
  }
  [[nodiscard]] std::vector<supernode> const& supernodes() const noexcept { return supernodes_; }
  [[nodiscard]] int const* rows(supernode const& s) const { return rows_.data() + s.rows; }
  /// Number of columns.
  [[nodiscard]] index size() const noexcept { return size_; }
  /// Number of values, padding included.
  [[nodiscard]] index values() const noexcept { return values_; }
  /// The largest number of rows below a supernode.
  [[nodiscard]] index most_below() const noexcept { return most_below_; }

 private:
  std::vector<supernode> supernodes_;
  std::vector<int> rows_;
  index size_ = 0, values_ = 0, most_below_ = 0;
};

/// Right-hand sides of a tail, which become the solutions, and the buffer of the sweeps.
template <class T>
struct tail_vectors {
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> x;       ///< shape.size() rows
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> buffer;  ///< shape.most_below() rows

  tail_vectors(tail_shape const& shape, index right_hand_sides)
      : x(shape.size(), right_hand_sides), buffer(shape.most_below(), right_hand_sides) {}
};

/// L_tt with entries of type T.
template <class T>
class tail_factor {
  static constexpr index width = tail_shape::width;
  using row = Eigen::Map<Eigen::Matrix<T, width, 1> const>;
  using square = Eigen::Matrix<T, width, width, Eigen::RowMajor>;

 public:
  /// entry(s, r, c): the entry of L in supernode number s, column c, row r ≥ c of it; rows count on
  /// below the columns.
  template <class Entry>
  tail_factor(std::shared_ptr<tail_shape const> shape, Entry entry)
      : shape_(std::move(shape)), values_(shape_->values()) {
    T* place = values_.data();
    for (std::size_t k = 0; k < shape_->supernodes().size(); ++k) {
      auto const& s = shape_->supernodes()[k];
      for (index c = 0; c < s.columns; c += width) {
        index const w = std::min(width, s.columns - c);
        square d = square::Identity();
        for (index i = 0; i < w; ++i)
          for (index j = 0; j <= i; ++j) d(i, j) = entry(k, c + i, c + j);
        square const inverse = d.template triangularView<Eigen::Lower>().solve(square::Identity());
        Eigen::Map<square>{place} = inverse;
        place += width * width;
        for (index r = c + w; r < s.columns + s.below; ++r, place += width) {
          for (index j = 0; j < w; ++j) place[j] = entry(k, r, c + j);
          std::fill(place + w, place + width, T(0));
        }
      }
    }
  }
  /// The same, rounded to T. What is smaller than any entry that matters becomes zero, because
  /// processors are slow with numbers below the smallest normal one.
  template <class U>
  explicit tail_factor(tail_factor<U> const& other)
      : shape_(other.shape()), values_(other.values().template cast<T>()) {
    T const least = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
    values_ = (values_.abs() < least).select(T(0), values_);
  }

  [[nodiscard]] std::shared_ptr<tail_shape const> const& shape() const noexcept { return shape_; }
  [[nodiscard]] Eigen::Array<T, Eigen::Dynamic, 1> const& values() const noexcept {
    return values_;
  }

  /// v.x ← (L_tt L_ttᵀ)⁻¹ v.x.
  void solve_in_place(tail_vectors<T>& v) const {
    auto const& all = shape_->supernodes();
    for (auto s = all.begin(); s != all.end(); ++s) forward(*s, v);
    for (auto s = all.rbegin(); s != all.rend(); ++s) backward(*s, v);
  }

 private:
  void gather(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    int const* rows = shape_->rows(s);
    for (index j = 0; j < v.x.cols(); ++j)
      for (index i = 0; i < s.below; ++i) v.buffer(i, j) = v.x(rows[i], j);
  }

  void forward(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    gather(s, v);
    T const* panel = values_.data() + s.values;
    for (index c = 0; c < s.columns; c += width) {
      index const w = std::min(width, s.columns - c);
      for (index j = 0; j < v.x.cols(); ++j) {
        T* const x = v.x.data() + j * v.x.rows() + s.first;
        Eigen::Matrix<T, width, 1> const p = times_inverse(panel, x + c, w);
        std::copy(p.data(), p.data() + w, x + c);
        T const* r = panel + width * width;
        for (index i = c + w; i < s.columns; ++i, r += width) x[i] -= row(r).dot(p);
        T* const y = v.buffer.data() + j * v.buffer.rows();
        for (index i = 0; i < s.below; ++i, r += width) y[i] -= row(r).dot(p);
      }
      panel += width * (width + tail_shape::rows_of_panel(s, c));
    }
    int const* rows = shape_->rows(s);
    for (index j = 0; j < v.x.cols(); ++j)
      for (index i = 0; i < s.below; ++i) v.x(rows[i], j) = v.buffer(i, j);
  }

  void backward(tail_shape::supernode const& s, tail_vectors<T>& v) const {
    gather(s, v);
    T const* panel = end_of(s);
    for (index c = (s.columns - 1) / width * width; c >= 0; c -= width) {
      panel -= width * (width + tail_shape::rows_of_panel(s, c));
      index const w = std::min(width, s.columns - c);
      for (index j = 0; j < v.x.cols(); ++j) {
        T* const x = v.x.data() + j * v.x.rows() + s.first;
        T const* r = panel + width * width;
        Eigen::Matrix<T, width, 1> p = Eigen::Matrix<T, width, 1>::Zero();
        for (index i = c + w; i < s.columns; ++i, r += width) p += x[i] * row(r);
        T const* const y = v.buffer.data() + j * v.buffer.rows();
        for (index i = 0; i < s.below; ++i, r += width) p += y[i] * row(r);
        for (index i = 0; i < width; ++i) p[i] = i < w ? x[c + i] - p[i] : T(0);
        Eigen::Matrix<T, width, 1> const q =
            Eigen::Map<square const>(panel).transpose().lazyProduct(p);
        std::copy(q.data(), q.data() + w, x + c);
      }
    }
  }

  [[nodiscard]] T const* end_of(tail_shape::supernode const& s) const {
    auto const& last = shape_->supernodes().back();
    return values_.data() + (&s == &last ? shape_->values() : (&s + 1)->values);
  }

  static Eigen::Matrix<T, width, 1> times_inverse(T const* panel, T const* x, index w) {
    Eigen::Matrix<T, width, 1> p = Eigen::Matrix<T, width, 1>::Zero();
    std::copy(x, x + w, p.data());
    return Eigen::Map<square const>(panel).lazyProduct(p);
  }

  std::shared_ptr<tail_shape const> shape_;
  Eigen::Array<T, Eigen::Dynamic, 1> values_;
};

}  // namespace slant::detail
