// SPDX-License-Identifier: MIT
//
// L_tt (tail_shape.hpp) where the factorisation has left it: each supernode a dense matrix stored
// by columns. Nothing is copied; added are the inverses D⁻¹ of the 8 × 8 blocks on the diagonal.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/detail/panel_kernels.hpp>
#include <slant/factorizations/detail/tail_panels.hpp>
#include <slant/factorizations/detail/tail_solve.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace slant::detail {

/// Entries of the supernodes of a tail_shape, in doubles.
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

}  // namespace slant::detail
