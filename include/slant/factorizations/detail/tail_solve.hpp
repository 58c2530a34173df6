// SPDX-License-Identifier: MIT
//
// Solves with L_tt L_ttᵀ, the trailing part of a supernodal factor, that cost little more than
// reading it.
//
// Intuition. Columns of one supernode share their rows. Eight of them at a time make a panel,
//
//     [ D ]   8 × 8, lower triangular; kept is D⁻¹
//     [ R ]   all rows below
//
// and each sweep reads every panel once: x_8 ← D⁻¹x_8, x_rows ← x_rows − R x_8 forward,
// x_8 ← D⁻ᵀ(x_8 − Rᵀx_rows) backward. The unknowns of a supernode, its own and those below, are
// gathered into a buffer and scattered again, so that the loops run over neighbours.
//
// Storage: shape(), and panel(supernode, c), that of the columns c, c + 1, … of the supernode.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/panel_kernels.hpp>
#include <slant/factorizations/detail/panel_kernels_of_four.hpp>
#include <slant/factorizations/detail/tail_shape.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace slant::detail {

/// Right-hand sides of a tail, which become the solutions, and the buffer of the sweeps.
template <class T>
struct tail_vectors {
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> x;       ///< shape.size() rows
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> buffer;  ///< shape.height() rows

  tail_vectors(index size, index height, index right_hand_sides)
      : x(size, right_hand_sides), buffer(height, right_hand_sides) {}
  tail_vectors(tail_shape const& shape, index right_hand_sides)
      : tail_vectors(shape.size(), shape.height(), right_hand_sides) {}
};

template <class T>
struct tail_panel {
  T const* inverse;        ///< D⁻¹, 8 × 8 by columns; the identity where there is no column
  panel_columns<T> below;  ///< R; what stands where there is no column does not matter, if finite
};

/// The sweeps; as a type only to have its parts beside each other.
template <class T, class Storage>
class tail_sweeps {
  using supernode = tail_shape::supernode;
  using column = Eigen::Array<T, panel_width, 1>;

 public:
  explicit tail_sweeps(Storage const& storage) : storage_(storage), shape_(storage.shape()) {}

  /// v.x ← (L_tt L_ttᵀ)⁻¹ v.x, where only zeros stand before `first`: there nothing is computed.
  void solve_in_place(tail_vectors<T>& v, index first) const {
    auto const& all = shape_.supernodes();
    auto const begin = std::partition_point(
        all.begin(), all.end(), [&](auto const& s) { return s.first + s.columns <= first; });
    auto const skipped = [&](auto const& s) {  // panels
      return std::max(index(0), first - s->first) / panel_width;
    };
    for (auto s = begin; s != all.end(); ++s) {
      gather(*s, v);
      for (index p = skipped(s); p < s->panel_count(); ++p) forward(*s, p * panel_width, v);
      scatter(*s, s->height(), v);
    }
    for (auto s = all.end(); s != begin;) {
      --s;
      gather(*s, v);
      for (index p = s->panel_count(); p-- > skipped(s);) backward(*s, p * panel_width, v);
      scatter(*s, s->columns, v);
    }
  }

 private:
  void gather(supernode const& s, tail_vectors<T>& v) const {
    int const* const rows = shape_.rows(s);
    for (index k = 0; k < v.x.cols(); ++k) {
      T const* const x = v.x.data() + k * v.x.rows();
      T* y = v.buffer.data() + k * v.buffer.rows();
      y = std::copy(x + s.first, x + s.first + s.columns, y);
      for (index i = 0; i < s.below; ++i) y[i] = x[rows[i]];
    }
  }

  /// The first `count` of the unknowns of s.
  void scatter(supernode const& s, index count, tail_vectors<T>& v) const {
    int const* const rows = shape_.rows(s);
    for (index k = 0; k < v.x.cols(); ++k) {
      T* const x = v.x.data() + k * v.x.rows();
      T const* const y = v.buffer.data() + k * v.buffer.rows();
      std::copy(y, y + s.columns, x + s.first);
      for (index i = s.columns; i < count; ++i) x[rows[i - s.columns]] = y[i];
    }
  }

  void forward(supernode const& s, index c, tail_vectors<T>& v) const {
    tail_panel<T> const panel = storage_.panel(s, c);
    index const width = std::min(panel_width, s.columns - c);
    index const below = s.height() - c - width;
    by_groups(c, v, [&](T* y, index stride, index together) {
      column p[group_size];
      bool zero = true;
      for (index l = 0; l < together; ++l) {
        T* const d = y + l * stride;
        p[l].setZero();
        for (index j = 0; j < width; ++j) {
          zero = zero && d[j] == T(0);
          p[l] += d[j] * Eigen::Map<column const>(panel.inverse + j * panel_width);
        }
        for (index j = 0; j < width; ++j) d[j] = p[l][j];
      }
      if (zero) return;
      if (together == group_size) {
        subtract_panel_from_four(long_vectors_, panel.below, p[0].data(), y + width, stride, below);
      } else {
        subtract_panel(long_vectors_, panel.below, p[0].data(), y + width, below);
      }
    });
  }

  void backward(supernode const& s, index c, tail_vectors<T>& v) const {
    tail_panel<T> const panel = storage_.panel(s, c);
    index const width = std::min(panel_width, s.columns - c);
    index const below = s.height() - c - width;
    by_groups(c, v, [&](T* y, index stride, index together) {
      column products[group_size];
      if (together == group_size) {
        panel_products_of_four(long_vectors_, panel.below, y + width, stride, below,
                               products[0].data());
      } else {
        panel_products(long_vectors_, panel.below, y + width, below, products[0].data());
      }
      for (index l = 0; l < together; ++l) {
        T* const d = y + l * stride;
        column p = column::Zero();
        for (index j = 0; j < width; ++j) p[j] = d[j] - products[l][j];
        for (index j = 0; j < width; ++j) {
          d[j] = (p * Eigen::Map<column const>(panel.inverse + j * panel_width)).sum();
        }
      }
    });
  }

  /// step(y, stride, together) for the right-hand sides, four of them together or one: y is the
  /// entry c of the first.
  template <class Step>
  static void by_groups(index c, tail_vectors<T>& v, Step const& step) {
    index const stride = v.buffer.rows();
    for (index k = 0; k < v.x.cols();) {
      index const together = k + group_size <= v.x.cols() ? group_size : 1;
      step(v.buffer.data() + k * stride + c, stride, together);
      k += together;
    }
  }
  static constexpr index group_size = 4;

  Storage const& storage_;
  tail_shape const& shape_;
  bool long_vectors_ = has_long_vectors();
};

/// v.x ← (L_tt L_ttᵀ)⁻¹ v.x with the entries in `storage`. Where only zeros stand before `first`,
/// the solution is computed from there on only.
template <class T, class Storage>
void solve_in_place(Storage const& storage, tail_vectors<T>& v, index first = 0) {
  tail_sweeps<T, Storage>(storage).solve_in_place(v, first);
}

}  // namespace slant::detail
