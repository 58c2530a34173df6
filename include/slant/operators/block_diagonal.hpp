// SPDX-License-Identifier: MIT
//
// diag(A₁, A₂, …). Closure: every law that all blocks have. Blocks are independent of each other,
// so diagonal and inverse exist where the blocks have them.
#pragma once

#include <slant/base/parallel_for.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/matrix.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

/// y = diag(A₁, A₂, …) x. Each A is `Operator const&` (referenced) or an operator type (owned).
template <class... A>
class block_diagonal_operator {
  static constexpr std::size_t n = sizeof...(A);
  static constexpr std::make_index_sequence<n> blocks{};

  template <bool Adjoint, class B>
  using oriented = expr::oriented_t<Adjoint, std::remove_cvref_t<B>>;

  template <bool Adjoint, std::size_t I>
  [[nodiscard]] decltype(auto) part() const {
    return expr::oriented<Adjoint>(boost::hana::at_c<I>(parts_).get());
  }

 public:
  static constexpr law_set laws = detail::block_diagonal_laws({laws_of<A>...});
  static constexpr bool full_row_rank = (declares_full_row_rank<std::remove_cvref_t<A>> && ...);

  explicit block_diagonal_operator(held<A>... parts) : parts_(std::move(parts)...) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((row_begin_[I + 1] = row_begin_[I] + part<false, I>().rows(),
        col_begin_[I + 1] = col_begin_[I] + part<false, I>().cols()),
       ...);
    }(blocks);
  }

  [[nodiscard]] index rows() const { return row_begin_[n]; }
  [[nodiscard]] index cols() const { return col_begin_[n]; }

  template <class X>
    requires(detail::block_part<oriented<false, A>, X> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace<false>(x);
  }
  template <class X, class Y, class W>
    requires(detail::block_part<oriented<false, A>, X> && ...)
  void apply(X const& x, Y& y, W& w) const {
    run<false, false>(scalar_t<X>(1), x, y, w);
  }
  template <class X, class Y, class W>
    requires(detail::accumulating_block_part<oriented<false, A>, X> && ...)
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    run<false, true>(α, x, y, w);
  }

  template <class X>
    requires(detail::block_part<oriented<true, A>, X> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace<true>(x);
  }
  template <class X, class Y, class W>
    requires(detail::block_part<oriented<true, A>, X> && ...)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    run<true, false>(scalar_t<X>(1), x, y, w);
  }
  template <class X, class Y, class W>
    requires(detail::accumulating_block_part<oriented<true, A>, X> && ...)
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    run<true, true>(α, x, y, w);
  }

  template <class D>
    requires(has_diagonal<std::remove_cvref_t<A>, plain_t<D>> && ...)
  void diagonal(D& d) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      auto const one = [&](auto const& block, index row) {
        detail::require_square("a block", block);
        auto own = slant::like(d, block.rows());
        block.diagonal(own);
        slant::local(d).middleRows(row, block.rows()) = slant::local(own);
      };
      (one(part<false, I>(), row_begin_[I]), ...);
    }(blocks);
  }
  template <class Y>
    requires(has_columns<std::remove_cvref_t<A>, plain_t<Y>> && ...)
  void columns(index first, Y& y) const {
    y.setZero();
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (detail::part_columns(part<false, I>(), col_begin_[I], row_begin_[I], first, y), ...);
    }(blocks);
  }
  /// diag(A₁⁻¹, A₂⁻¹, …).
  [[nodiscard]] auto inverse() const
    requires(detail::knows_its_inverse<std::remove_cvref_t<A>> && ...)
  {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return block_diagonal_operator<std::remove_cvref_t<decltype(part<false, I>().inverse())>...>(
          part<false, I>().inverse()...);
    }(blocks);
  }

 private:
  template <bool Adjoint, class X>
  [[nodiscard]] auto make_workspace(X const& x) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return boost::hana::make_tuple(detail::part_workspace<true>(part<Adjoint, I>(), x)...);
    }(blocks);
  }
  template <bool Adjoint, bool Add, class S, class X, class Y, class W>
  void run(S const& α, X const& x, Y& y, W& w) const {
    auto const& row_begin = Adjoint ? col_begin_ : row_begin_;
    auto const& col_begin = Adjoint ? row_begin_ : col_begin_;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (detail::apply_part<!Add>(part<Adjoint, I>(), α, x, col_begin[I], y, row_begin[I],
                                boost::hana::at_c<I>(w)),
       ...);
    }(blocks);
  }

  boost::hana::tuple<held<A>...> parts_;
  std::array<index, n + 1> row_begin_{};
  std::array<index, n + 1> col_begin_{};
};

/// diag(A₁, A₂, …).
template <operand... A>
  requires(sizeof...(A) >= 1)
[[nodiscard]] auto block_diagonal(A&&... a) {
  return block_diagonal_operator<part_t<A>...>(
      held<part_t<A>>(slant::as_operator(std::forward<A>(a)))...);
}

// --- diagonal blocks -----------------------------------------------------------------------------
//
// diag(A₁, …, A_p) with as many blocks as there are when the program runs, all of one type: the
// bodies or subdomains of a problem. Blocks of different types, known when it is compiled, are
// block_diagonal. With OpenMP, blocks are applied in parallel, with the same bits for any number of
// threads (base/parallel_for.hpp). Closure: the laws of the blocks.

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
    return workspaces<false>(x);
  }
  template <class X, class Y, class W>
    requires detail::block_part<A, X>
  void apply(X const& x, Y& y, W& w) const {
    run<false>(x, y, w);
  }

  template <class X>
    requires detail::block_part<expr::adjoint_view<A>, X>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return workspaces<true>(x);
  }
  template <class X, class Y, class W>
    requires detail::block_part<expr::adjoint_view<A>, X>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    run<true>(x, y, w);
  }

 private:
  /// One workspace for each block, in its order.
  template <bool Adjoint, class X>
  [[nodiscard]] auto workspaces(X const& x) const {
    auto const own = [&](A const& block) {
      return detail::part_workspace<true>(expr::oriented<Adjoint>(block), x);
    };
    std::vector<decltype(own(blocks_.front()))> w;
    w.reserve(blocks_.size());
    for (A const& block : blocks_) w.push_back(own(block));
    return w;
  }
  template <bool Adjoint, class X, class Y, class W>
  void run(X const& x, Y& y, W& w) const {
    auto const& row_begin = Adjoint ? col_begin_ : row_begin_;
    auto const& col_begin = Adjoint ? row_begin_ : col_begin_;
    detail::parallel_for(block_count(), rows() + cols(), [&](index number) {
      auto const i = static_cast<std::size_t>(number);
      detail::apply_part<true>(expr::oriented<Adjoint>(blocks_[i]), scalar_t<X>(1), x, col_begin[i],
                               y, row_begin[i], w[i]);
    });
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
