// SPDX-License-Identifier: MIT
//
// The structure of L_tt, the trailing part of a supernodal Cholesky factor: the columns that some
// unknowns reach in the elimination tree. Its entries: tail_columns where they were computed,
// tail_panels packed and rounded; sweeps with either: tail_sweeps.
#pragma once

#include <slant/base/long_arrays.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
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
  void add(index columns, auto const& below) {
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

// --- solve ---------------------------------------------------------------------------------------
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

/// Right-hand sides of a tail, which become the solutions, and the buffer of the sweeps.
template <class T>
struct tail_vectors {
  Eigen::MatrixX<T> x;       ///< shape.size() rows
  Eigen::MatrixX<T> buffer;  ///< shape.height() rows

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
  static void by_groups(index c, tail_vectors<T>& v, auto const& step) {
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

// --- panels --------------------------------------------------------------------------------------

/// L_tt packed and rounded to T: each panel as D⁻¹ and the rows below in tiles of 32 bytes of each
/// column, one after the other, so that a sweep reads one long stream. Columns are padded to whole
/// panels and rows to whole tiles.
template <class T>
class tail_panels {
 public:
  /// From entries elsewhere, in another precision (panel_kernels.hpp).
  explicit tail_panels(auto const& from) : shape_(from.shared_shape()) {
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
    return {place, panel_from(place + square, tile, tile_size)};
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

// --- columns -------------------------------------------------------------------------------------

/// L_tt where the factorisation has left it, in doubles: each supernode a dense matrix stored by
/// columns. Nothing is copied; added are the inverses D⁻¹ of the 8 × 8 blocks on the diagonal.
class tail_columns {
  using square = Eigen::Matrix<double, panel_width, panel_width>;

 public:
  struct matrix {
    double const* first;  ///< the entry on the diagonal of its first column
    index height;         ///< from one column to the next
  };

  /// One matrix for each supernode; `owner` keeps them alive.
  tail_columns(std::shared_ptr<tail_shape const> shape, std::vector<matrix> const& matrices,
               std::shared_ptr<void const> owner)
      : shape_(std::move(shape)), owner_(std::move(owner)) {
    inverses_.reserve(static_cast<std::size_t>(shape_->panels()));
    panels_.reserve(inverses_.capacity());
    auto m = matrices.begin();
    for (auto const& s : shape_->supernodes()) {
      for (index c = 0; c < s.columns; c += panel_width) {
        index const width = std::min(panel_width, s.columns - c);
        matrix const panel{m->first + c * m->height + c, m->height};
        square d = square::Identity();
        for (index j = 0; j < width; ++j) {
          for (index i = j; i < width; ++i) d(i, j) = panel.first[j * panel.height + i];
        }
        panels_.push_back(panel);
        inverses_.push_back(d.triangularView<Eigen::Lower>().solve(square::Identity()));
      }
      ++m;
    }
  }

  [[nodiscard]] tail_shape const& shape() const noexcept { return *shape_; }
  [[nodiscard]] std::shared_ptr<tail_shape const> const& shared_shape() const noexcept {
    return shape_;
  }
  /// Bytes of the entries.
  [[nodiscard]] index bytes() const noexcept {
    return shape_->entries() * static_cast<index>(sizeof(double));
  }

  [[nodiscard]] tail_panel<double> panel(tail_shape::supernode const& s, index c) const {
    auto const number = static_cast<std::size_t>(s.panels + c / panel_width);
    matrix const& m = panels_[number];
    index const width = std::min(panel_width, s.columns - c);
    tail_panel<double> result{inverses_[number].data(), {{}, tile_rows<double>}};
    index j = 0;  // where columns are missing the last one is read again, times zero
    for (auto& column : result.below.column) {
      column = m.first + std::min(j++, width - 1) * m.height + width;
    }
    return result;
  }

  /// The same in floats, made when first asked for.
  [[nodiscard]] std::shared_ptr<tail_panels<float> const> rounded() const {
    std::call_once(once_, [this] { rounded_ = std::make_shared<tail_panels<float>>(*this); });
    return rounded_;
  }

 private:
  std::shared_ptr<tail_shape const> shape_;
  std::shared_ptr<void const> owner_;
  std::vector<matrix> panels_;
  std::vector<square> inverses_;
  mutable std::once_flag once_;
  mutable std::shared_ptr<tail_panels<float> const> rounded_;
};

// --- inverse -------------------------------------------------------------------------------------
//
// Part of (L_tt L_ttᵀ)⁻¹ formed: the rows and columns of some of its unknowns. A product with it
// reads n²/2 entries once, where the sweeps read those of L_tt twice, and pays for the forming
// after some hundred products.
//
// Each column is a solve with a unit vector e_j, and only what stands from j on in it is needed:
// the panels before take no part in either sweep, which leaves a third of the work.

/// Rows and columns `unknowns` (numbers of columns of L_tt, ascending) of the inverse, with the
/// entries of L_tt in `storage`.
[[nodiscard]] std::shared_ptr<packed_symmetric<double> const> tail_inverse(
    auto const& storage, std::vector<int> const& unknowns) {
  constexpr index together = 32;  // a panel is read once for so many columns
  auto const n = static_cast<index>(unknowns.size());
  auto const unknown = [&](index i) { return index(unknowns[static_cast<std::size_t>(i)]); };
  auto result = std::make_shared<packed_symmetric<double>>(n);
  tail_vectors<double> v(storage.shape(), together);
  for (index first = 0; first < n; first += together) {
    index const end = std::min(first + together, n);
    v.x.setZero();
    for (index j = first; j < end; ++j) v.x(unknown(j), j - first) = 1;
    solve_in_place(storage, v, unknown(first));
    for (index j = first; j < end; ++j) {
      for (index i = j; i < n; ++i) result->set(i, j, v.x(unknown(i), j - first));
    }
  }
  return result;
}

/// Whether S⁻¹, formed, is still positive definite when its entries are rounded to T, which those
/// of a factor always mean. `stiffness`: K_ii of its unknowns, in its unit. With D = diag(S⁻¹) and
/// M = D^-½ S⁻¹ D^-½, in any units of the unknowns,
///
///     λ_min(M)⁻¹ ≤ tr M⁻¹ = Σ (S⁻¹)_ii S_ii ≤ Σ (S⁻¹)_ii K_ii.
///
/// Rounding changes each entry of M by at most half an ε of it, one independently of the other; the
/// norm of such a matrix is about twice that of its longest row.
template <class T>
[[nodiscard]] bool stays_definite(packed_symmetric<double> const& inverse,
                                  std::vector<double> const& stiffness) {
  double trace = 0, largest = 0;
  std::vector<double> squares(stiffness.size(), 1);  // of the rows of M
  for (index j = 0; j < inverse.size(); ++j) {
    double const d = inverse(j, j);
    trace += d * stiffness[static_cast<std::size_t>(j)];
    largest = std::max(largest, d);
    for (index i = j + 1; i < inverse.size(); ++i) {
      double const m = inverse(i, j) / std::sqrt(inverse(i, i) * d);
      squares[static_cast<std::size_t>(i)] += m * m;
      squares[static_cast<std::size_t>(j)] += m * m;
    }
  }
  if (squares.empty()) return true;
  constexpr double ε = std::numeric_limits<T>::epsilon();
  double const row = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  return largest < ε * std::numeric_limits<T>::max() && ε * row * trace < 0.5;
}

}  // namespace slant::detail
