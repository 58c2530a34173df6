// SPDX-License-Identifier: MIT
//
// diag(A₁, …, A_p) with as many blocks as there are when the program runs, all of one type: the
// bodies or subdomains of a problem. Blocks of different types, known when it is compiled, are
// block_diagonal. With OpenMP, blocks are applied in parallel, with the same bits for any number of
// threads (detail/parallel_for.hpp). Closure: the laws of the blocks.
#pragma once

#include <slant/operators/adjoint.hpp>
#include <slant/operators/as_operator.hpp>
#include <slant/operators/detail/block_part.hpp>
#include <slant/operators/detail/closure.hpp>
#include <slant/operators/detail/parallel_for.hpp>

#include <utility>
#include <vector>

namespace slant {

/// y = diag(A₁, …, A_p) x; owns the blocks.
template <class A>
class diagonal_blocks_operator {
 public:
  static constexpr law_set laws = detail::block_diagonal_laws({laws_of<A>});

  explicit diagonal_blocks_operator(std::vector<A> blocks) : blocks_(std::move(blocks)) {
    row_begin_.push_back(0);
    col_begin_.push_back(0);
    for (A const& block : blocks_) {
      row_begin_.push_back(row_begin_.back() + index(block.rows()));
      col_begin_.push_back(col_begin_.back() + index(block.cols()));
    }
  }

  [[nodiscard]] index rows() const { return row_begin_.back(); }
  [[nodiscard]] index cols() const { return col_begin_.back(); }
  /// Number of blocks p.
  [[nodiscard]] index block_count() const { return static_cast<index>(blocks_.size()); }
  [[nodiscard]] A const& block(index i) const { return blocks_[static_cast<std::size_t>(i)]; }
  /// First row of block i; rows() for i = p.
  [[nodiscard]] index row_begin(index i) const { return row_begin_[static_cast<std::size_t>(i)]; }
  /// First column of block i; cols() for i = p.
  [[nodiscard]] index col_begin(index i) const { return col_begin_[static_cast<std::size_t>(i)]; }

  template <class X>
    requires detail::block_part<A, X>
  [[nodiscard]] auto workspace(X const& x) const {
    return workspaces(blocks_, x, [](A const& block) -> A const& { return block; });
  }
  template <class X, class Y, class W>
    requires detail::block_part<A, X>
  void apply(X const& x, Y& y, W& w) const {
    detail::parallel_for(block_count(), rows() + cols(), [&](index i) {
      detail::apply_part<true>(block(i), scalar_t<X>(1), x, col_begin(i), y, row_begin(i),
                               w[static_cast<std::size_t>(i)]);
    });
  }

  template <class X>
    requires detail::block_part<adjoint_operator<A const&>, X>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return workspaces(blocks_, x, transposed);
  }
  template <class X, class Y, class W>
    requires detail::block_part<adjoint_operator<A const&>, X>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    detail::parallel_for(block_count(), rows() + cols(), [&](index i) {
      detail::apply_part<true>(transposed(block(i)), scalar_t<X>(1), x, row_begin(i), y,
                               col_begin(i), w[static_cast<std::size_t>(i)]);
    });
  }

 private:
  static adjoint_operator<A const&> transposed(A const& block) {
    return adjoint_operator<A const&>(held<A const&>(block));
  }

  /// One workspace for each block, in its order.
  template <class X, class F>
  [[nodiscard]] static auto workspaces(std::vector<A> const& blocks, X const& x, F oriented) {
    std::vector<decltype(detail::part_workspace<true>(oriented(blocks.front()), x))> w;
    w.reserve(blocks.size());
    for (A const& block : blocks) w.push_back(detail::part_workspace<true>(oriented(block), x));
    return w;
  }

  std::vector<A> blocks_;
  std::vector<index> row_begin_;
  std::vector<index> col_begin_;
};

/// diag(A₁, …, A_p).
template <operand A>
  requires(!eigen_matrix<A>)
[[nodiscard]] auto diagonal_blocks(std::vector<A> blocks) {
  return diagonal_blocks_operator<A>(std::move(blocks));
}

}  // namespace slant
