// SPDX-License-Identifier: MIT
//
// The Jacobian J = ∇f(x)ᵀ of the smooth inequalities f(x) ≤ 0 of a product of blocks, as an
// operator: one row per inequality. It owns its entries and shares the layout, so that it can be
// renewed in place.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Core>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::detail {

// --- inequality layout ---------------------------------------------------------------------------
//
// Where the gradients of the smooth inequalities of a product of blocks stand in the matrix
// J = ∇f(x)ᵀ, one row per inequality. Equal blocks that follow one another form a run, which a few
// numbers describe: no list of components is read when J or Jᵀ is applied.

/// `blocks` equal blocks. Component j of block i is entry first + i·step + j·stride of the vector.
struct inequality_run {
  index blocks;
  index dimension;
  index inequalities;  ///< per block
  index first;
  index step;
  index stride;
  index row;       ///< first row of J
  index gradient;  ///< first of the entries of J, `dimension` per row
  index hessian;   ///< first of the entries of the Hessians, dimension² per block
};

/// Number of smooth inequalities of a block; 0 also of one without an inequality form, which
/// slant::inequalities refuses in words.
template <class Block>
inline constexpr int inequalities_of = [] {
  if constexpr (has_inequality_form<Block, point_t<Block>>) {
    return int(Block::inequalities);
  } else {
    return 0;
  }
}();

/// f(block, place, n, k, row) for every block with inequalities: its dimension and their number as
/// constants, and the row of the first of them.
template <class Set, class F>
void visit_inequalities(Set const& set, F const& f) {
  index row = 0;
  slant::visit_blocks(set, [&](auto const& block, auto const& place) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    constexpr int k = inequalities_of<block_type>;
    if constexpr (k > 0) {
      constexpr int n = static_dimension_of<block_type>;
      f(block, place, std::integral_constant<int, n>{}, std::integral_constant<int, k>{}, row);
      row += k;
    }
  });
}

/// The runs of a set, in the order of its blocks.
class inequality_layout {
 public:
  template <class Set>
  explicit inequality_layout(Set const& set) : cols_(slant::dimension_of(set)) {
    visit_inequalities(set, [this](auto const&, auto const& place, auto n, auto k, index) {
      append(n, k, place.component(0), n > 1 ? place.component(1) - place.component(0) : 1);
    });
  }

  /// Number of inequalities.
  [[nodiscard]] index rows() const noexcept { return rows_; }
  /// Number of components of the set.
  [[nodiscard]] index cols() const noexcept { return cols_; }
  [[nodiscard]] index gradients() const noexcept { return gradients_; }
  [[nodiscard]] index hessians() const noexcept { return hessians_; }
  [[nodiscard]] std::vector<inequality_run> const& runs() const noexcept { return runs_; }

 private:
  void append(index n, index k, index first, index stride) {
    if (runs_.empty() || !continues(runs_.back(), n, k, first, stride)) {
      runs_.push_back({0, n, k, first, n * stride, stride, rows_, gradients_, hessians_});
    }
    ++runs_.back().blocks;
    rows_ += k;
    gradients_ += k * n;
    hessians_ += n * n;
  }
  /// The second block of a run sets its step.
  static bool continues(inequality_run& run, index n, index k, index first, index stride) {
    if (run.dimension != n || run.inequalities != k || run.stride != stride) return false;
    if (run.blocks == 1) run.step = first - run.first;
    return first == run.first + run.blocks * run.step;
  }

  index rows_ = 0;
  index cols_;
  index gradients_ = 0;
  index hessians_ = 0;
  std::vector<inequality_run> runs_;
};

/// f(0), …, f(n − 1), written out where n is a constant: compilers that optimise for size as well
/// do not unroll a loop of two.
template <class N, class F>
void repeat(N n, F const& f) {
  if constexpr (std::is_same_v<N, index>) {
    for (index j = 0; j < n; ++j) f(j);
  } else {
    [&]<index... J>(std::integer_sequence<index, J...>) {
      (f(std::integral_constant<index, J>{}), ...);
    }(std::make_integer_sequence<index, N::value>{});
  }
}

/// f(x, y) for each of several right-hand sides x and results y.
template <class X, class Y, class F>
void by_columns(X const& x, Y& y, F const& f) {
  if constexpr (X::ColsAtCompileTime == 1 && Y::ColsAtCompileTime == 1) {
    f(x, y);
  } else {
    for (index j = 0; j < index(x.cols()); ++j) {
      auto const from = x.col(j);
      auto to = y.col(j);
      f(from, to);
    }
  }
}

template <class N>
inline constexpr bool is_one = std::is_same_v<N, std::integral_constant<index, 1>>;

/// f(dimension, inequalities, stride, step), as constants where the blocks are of the usual kinds
/// and lie one behind the other, so that the loops over them are unrolled.
template <class F>
void with_block_size(inequality_run const& run, F const& f) {
  using one = std::integral_constant<index, 1>;
  using two = std::integral_constant<index, 2>;
  bool const dense = run.stride == 1 && run.step == run.dimension;
  if (dense && run.dimension == 1 && run.inequalities == 1) {
    f(one{}, one{}, one{}, one{});
  } else if (dense && run.dimension == 2 && run.inequalities == 1) {
    f(two{}, one{}, one{}, two{});
  } else if (dense && run.dimension == 1 && run.inequalities == 2) {
    f(one{}, two{}, one{}, one{});
  } else {
    f(run.dimension, run.inequalities, run.stride, run.step);
  }
}

}  // namespace slant::detail

namespace slant {

/// y = J x. Made by the slanting function `inequalities`.
template <class S>
class inequality_jacobian {
 public:
  using scalar = S;
  static constexpr law_set laws{};

  explicit inequality_jacobian(std::shared_ptr<detail::inequality_layout const> layout)
      : layout_(std::move(layout)), gradients_(layout_->gradients()) {}

  [[nodiscard]] index rows() const noexcept { return layout_->rows(); }
  [[nodiscard]] index cols() const noexcept { return layout_->cols(); }

  /// c J at x.
  template <class Set, class X>
  void renew(Set const& set, X const& x, S const& c = S(1)) {
    index at = 0;
    detail::visit_inequalities(
        set, [&](auto const& block, auto const& place, auto n, auto k, index) {
          Eigen::Matrix<S, n, k> const g = block.inequality_gradient(place.value(x));
          for (int i = 0; i < k; ++i) {
            for (int j = 0; j < n; ++j) gradients_[at++] = c * g.coeff(j, i);
          }
        });
  }

  /// Row i times factors(i): other units of the inequalities.
  template <class F>
  void scale_rows(F const& factors) {
    auto const& c = slant::local(factors);
    for (auto const& run : layout_->runs()) {
      index at = run.gradient;
      for (index row = run.row; row < run.row + run.blocks * run.inequalities; ++row) {
        gradients_.segment(at, run.dimension) *= c.coeff(row);
        at += run.dimension;
      }
    }
  }

  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y), [&](auto const& from, auto& to) {
      each(from, to, [](auto&& target, auto const& sum) { target = sum; });
    });
  }
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y), [&](auto const& from, auto& to) {
      each(from, to, [&α](auto&& target, auto const& sum) { target += α * sum; });
    });
  }
  template <class X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    vectors::set_zero(y);
    apply_adjoint_add(S(1), x, y);
  }
  template <class X, class Y>
  void apply_adjoint_add(S const& α, X const& z, Y& y) const {
    detail::by_columns(slant::local(z), slant::local(y), [&](auto const& from, auto& to) {
      visit([&](index row, index component, S const& entry) {
        to.coeffRef(component) += α * (entry * from.coeff(row));
      });
    });
  }

  /// f(row, column, entry) for every entry that can differ from zero.
  template <class F>
  void visit(F const& f) const {
    for (auto const& run : layout_->runs()) {
      S const* entry = gradients_.data() + run.gradient;
      for (index i = 0; i < run.blocks; ++i) {
        for (index r = 0; r < run.inequalities; ++r) {
          for (index j = 0; j < run.dimension; ++j) {
            f(run.row + i * run.inequalities + r, run.first + i * run.step + j * run.stride,
              *entry++);
          }
        }
      }
    }
  }

  [[nodiscard]] detail::inequality_layout const& layout() const noexcept { return *layout_; }
  /// The entries of J, in the order of the layout.
  [[nodiscard]] auto const& entries() const noexcept { return gradients_; }

 private:
  /// put(y_row, (J x)_row), rows of blocks of one number all at once.
  template <class X, class Y, class Put>
  void each(X const& x, Y& y, Put const& put) const {
    for (auto const& run : layout_->runs()) {
      detail::with_block_size(run, [&](auto n, auto k, auto stride, auto step) {
        if constexpr (detail::is_one<decltype(n)> && detail::is_one<decltype(k)>) {
          put(y.segment(run.row, run.blocks), gradients_.segment(run.gradient, run.blocks)
                                                  .cwiseProduct(x.segment(run.first, run.blocks)));
        } else {
          S const* const g = gradients_.data() + run.gradient;
          for (index i = 0; i < run.blocks; ++i) {
            for (index r = 0; r < k; ++r) {
              index const own = (i * k + r) * n;
              S sum = g[own] * x.coeff(run.first + i * step);
              for (index j = 1; j < n; ++j) {
                sum += g[own + j] * x.coeff(run.first + i * step + j * stride);
              }
              put(y.coeffRef(run.row + i * k + r), sum);
            }
          }
        }
      });
    }
  }

  std::shared_ptr<detail::inequality_layout const> layout_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> gradients_;
};

}  // namespace slant
