// SPDX-License-Identifier: MIT
//
// diag(A₁, A₂, …). Closure: every law that all blocks have. Blocks are independent of each other,
// so diagonal and inverse exist where the blocks have them.
#pragma once

#include <slant/operators/adjoint.hpp>
#include <slant/operators/detail/block_part.hpp>
#include <slant/operators/detail/closure.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

namespace slant {

/// y = diag(A₁, A₂, …) x. Each A is `Operator const&` (referenced) or an operator type (owned).
template <class... A>
class block_diagonal_operator {
  static constexpr std::size_t n = sizeof...(A);
  static constexpr std::make_index_sequence<n> blocks{};

  template <bool Adjoint, class B>
  using oriented = std::conditional_t<Adjoint, adjoint_operator<std::remove_cvref_t<B> const&>,
                                      std::remove_cvref_t<B>>;

  template <bool Adjoint, std::size_t I>
  [[nodiscard]] decltype(auto) part() const {
    auto const& block = boost::hana::at_c<I>(parts_).get();
    if constexpr (Adjoint) {
      using B = std::remove_cvref_t<decltype(block)>;
      return adjoint_operator<B const&>(held<B const&>(block));
    } else {
      return (block);
    }
  }

 public:
  static constexpr law_set laws = detail::block_diagonal_laws({laws_of<A>...});

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
      return std::make_tuple(detail::part_workspace<true>(part<Adjoint, I>(), x)...);
    }(blocks);
  }
  template <bool Adjoint, bool Add, class S, class X, class Y, class W>
  void run(S const& α, X const& x, Y& y, W& w) const {
    auto const& row_begin = Adjoint ? col_begin_ : row_begin_;
    auto const& col_begin = Adjoint ? row_begin_ : col_begin_;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (detail::apply_part<!Add>(part<Adjoint, I>(), α, x, col_begin[I], y, row_begin[I],
                                std::get<I>(w)),
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

}  // namespace slant
