// SPDX-License-Identifier: MIT
//
// A matrix of operators:
//
//     auto S = slant::block(slant::block_row(K, slant::adjoint(B)),
//                           slant::block_row(B, slant::zero(m)));
//
// Zero blocks are recognised by their type and cost nothing. Closure: none; that a saddle point
// matrix is symmetric is declared by the caller: `declare<self_adjoint>(block(…))`.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- part ----------------------------------------------------------------------------------------
//
// Applying a part of a block operator to its segments of x and y. Parts that accept Eigen segments
// work on them in place. Parts that know only the vector type itself (a distributed vector, say)
// get copies, which live in the workspace.

template <class A>
inline constexpr bool is_zero_operator<expr::adjoint_view<A>> = is_zero_operator<A>;

template <class V, class Inner>
struct copied_segments {
  V x;
  V y;
  Inner inner;
};

/// What apply_part<Overwrite> needs for its segment of x.
template <bool Overwrite, class A, class X>
[[nodiscard]] auto part_workspace(A const& a, X const& x) {
  if constexpr (is_zero_operator<A>) {
    return no_workspace{};
  } else if constexpr (takes_segments<A, X>) {
    auto const segment = slant::like(slant::local(x), a.cols());
    if constexpr (Overwrite) {
      return slant::workspace(a, segment);
    } else {
      return accumulate_workspace(a, segment);
    }
  } else {
    auto segment = slant::like(x, a.cols());
    auto inner = slant::workspace(a, segment);
    return copied_segments<plain_t<X>, decltype(inner)>{std::move(segment),
                                                        slant::like(x, a.rows()), std::move(inner)};
  }
}

/// y(row : row + a.rows()) ← [+] α A x(col : col + a.cols()). Overwrites if Overwrite (then α = 1).
template <bool Overwrite, class A, class S, class X, class Y, class W>
void apply_part(A const& a, S const& α, X const& x, index col, Y& y, index row, W& w) {
  if constexpr (is_zero_operator<A>) {
    if constexpr (Overwrite) slant::local(y).middleRows(row, a.rows()).setZero();
  } else {
    auto const from = slant::local(x).middleRows(col, a.cols());
    auto to = slant::local(y).middleRows(row, a.rows());
    if constexpr (takes_segments<A, X>) {
      if constexpr (Overwrite) {
        slant::apply(a, from, to, w);
      } else {
        accumulate(a, α, from, to, w);
      }
    } else {
      slant::local(w.x) = from;
      slant::apply(a, w.x, w.y, w.inner);
      if constexpr (Overwrite) {
        to = slant::local(w.y);
      } else {
        to += α * slant::local(w.y);
      }
    }
  }
}

/// Those of the wanted columns first … first + y.cols() − 1 of the whole that pass through a part,
/// whose own columns start at `col` and rows at `row`.
template <class A, class Y>
void part_columns(A const& a, index col, index row, index first, Y& y) {
  index const begin = std::max(first, col);
  index const end = std::min<index>(first + y.cols(), col + a.cols());
  if (begin >= end || is_zero_operator<A>) return;
  plain_t<Y> own(a.rows(), end - begin);
  a.columns(begin - col, own);
  y.block(row, begin - first, a.rows(), end - begin) = own;
}

/// A part can be applied to its segment of vectors like X.
template <class A, class X>
concept block_part = is_zero_operator<A> || takes_segments<A, X> || linear_operator<A, plain_t<X>>;

/// A part can add to its segment of vectors like X without a temporary.
template <class A, class X>
concept accumulating_block_part =
    is_zero_operator<A> || (takes_segments<A, X> && has_accumulate<A, plain_t<local_t<X>>>);

}  // namespace slant::detail

namespace slant {

/// One row of blocks. Each A is `Operator const&` (referenced) or an operator type (owned).
template <class... A>
struct block_row_of {
  static constexpr std::size_t size = sizeof...(A);
  template <std::size_t J>
  using block_type = std::remove_cvref_t<detail::nth<J, A...>>;
  template <class Y>
  static constexpr bool have_columns = ((detail::is_zero_operator<std::remove_cvref_t<A>> ||
                                         has_columns<std::remove_cvref_t<A>, plain_t<Y>>)&&...);

  boost::hana::tuple<held<A>...> blocks;
};

/// One row of blocks, from left to right.
template <operand... A>
  requires(sizeof...(A) >= 1)
[[nodiscard]] auto block_row(A&&... a) {
  return block_row_of<part_t<A>...>{boost::hana::tuple<held<part_t<A>>...>(
      held<part_t<A>>(slant::as_operator(std::forward<A>(a)))...)};
}

/// The operator with the given rows of blocks (each a block_row_of), all equally long.
template <class... Rows>
class block_operator {
  static constexpr std::size_t m = sizeof...(Rows);
  static constexpr std::size_t n = detail::nth<0, Rows...>::size;
  static_assert(((Rows::size == n) && ...), "all rows of blocks have the same number of blocks");

  template <std::size_t I, std::size_t J>
  using block_type = typename detail::nth<I, Rows...>::template block_type<J>;

  // The same code serves A and Aᵀ: block (I, J) of A, or the adjoint of block (J, I).
  template <bool Adjoint>
  static constexpr std::size_t height = Adjoint ? n : m;
  template <bool Adjoint>
  static constexpr std::size_t width = Adjoint ? m : n;
  using places = std::make_index_sequence<m * n>;  // row by row

  template <bool Adjoint, std::size_t I, std::size_t J>
  [[nodiscard]] decltype(auto) part() const {
    constexpr std::size_t row = Adjoint ? J : I, col = Adjoint ? I : J;
    return expr::oriented<Adjoint>(
        boost::hana::at_c<col>(boost::hana::at_c<row>(rows_).blocks).get());
  }
  template <bool Adjoint, std::size_t I, std::size_t J>
  using part_type = expr::oriented_t<Adjoint, block_type<Adjoint ? J : I, Adjoint ? I : J>>;

  /// The column of the first nonzero block of a row; it overwrites, the others add. width if none.
  template <bool Adjoint, std::size_t I>
  static constexpr std::size_t first_block = []<std::size_t... J>(std::index_sequence<J...>) {
    std::size_t first = 0;
    (void)((detail::is_zero_operator<part_type<Adjoint, I, J>> ? (++first, true) : false) && ...);
    return first;
  }(std::make_index_sequence<width<Adjoint>>{});

  template <bool Adjoint, class X>
  static constexpr bool applicable = []<std::size_t... P>(std::index_sequence<P...>) {
    constexpr std::size_t k = width<Adjoint>;
    return (detail::block_part<part_type<Adjoint, P / k, P % k>, X> && ...);
  }(places{});
  template <bool Adjoint, class X>
  static constexpr bool accumulating = []<std::size_t... P>(std::index_sequence<P...>) {
    constexpr std::size_t k = width<Adjoint>;
    return (detail::accumulating_block_part<part_type<Adjoint, P / k, P % k>, X> && ...);
  }(places{});

 public:
  static constexpr law_set laws{};

  /// Throws bad_input naming the block whose size does not fit its row and column.
  explicit block_operator(Rows... rows) : rows_(std::move(rows)...) {
    for_each_block([this]<std::size_t I, std::size_t J>() {
      if constexpr (J == 0) row_begin_[I + 1] = row_begin_[I] + part<false, I, J>().rows();
      if constexpr (I == 0) col_begin_[J + 1] = col_begin_[J] + part<false, I, J>().cols();
    });
    for_each_block([this]<std::size_t I, std::size_t J>() {
      detail::require_size(detail::entry_text("block", index(I), index(J)), part<false, I, J>(),
                           row_begin_[I + 1] - row_begin_[I], col_begin_[J + 1] - col_begin_[J],
                           "the first blocks of its row and column");
    });
  }

  [[nodiscard]] index rows() const { return row_begin_[m]; }
  [[nodiscard]] index cols() const { return col_begin_[n]; }

  /// Block (I, J). One that is owned may be renewed; it keeps its size.
  template <std::size_t I, std::size_t J>
  [[nodiscard]] auto const& block() const noexcept {
    return boost::hana::at_c<J>(boost::hana::at_c<I>(rows_).blocks).get();
  }
  template <std::size_t I, std::size_t J>
  [[nodiscard]] auto& block() noexcept {
    return boost::hana::at_c<J>(boost::hana::at_c<I>(rows_).blocks).get();
  }

  template <class X>
    requires applicable<false, X>
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace<false>(x);
  }
  template <class X, class Y, class W>
    requires applicable<false, X>
  void apply(X const& x, Y& y, W& w) const {
    run<false, false>(scalar_t<X>(1), x, y, w);
  }
  template <class X, class Y, class W>
    requires accumulating<false, X>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    run<false, true>(α, x, y, w);
  }

  template <class X>
    requires applicable<true, X>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace<true>(x);
  }
  template <class X, class Y, class W>
    requires applicable<true, X>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    run<true, false>(scalar_t<X>(1), x, y, w);
  }
  template <class X, class Y, class W>
    requires accumulating<true, X>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    run<true, true>(α, x, y, w);
  }

  template <class Y>
    requires(Rows::template have_columns<Y> && ...)
  void columns(index first, Y& y) const {
    y.setZero();
    for_each_block([&]<std::size_t I, std::size_t J>() {
      detail::part_columns(part<false, I, J>(), col_begin_[J], row_begin_[I], first, y);
    });
  }

 private:
  static void for_each_block(auto f) {
    [&]<std::size_t... P>(std::index_sequence<P...>) {
      (f.template operator()<P / n, P % n>(), ...);
    }(places{});
  }

  template <bool Adjoint, class X>
  [[nodiscard]] auto make_workspace(X const& x) const {
    return [&]<std::size_t... P>(std::index_sequence<P...>) {
      return boost::hana::make_tuple(
          detail::part_workspace<P % width<Adjoint> == first_block<Adjoint, P / width<Adjoint>>>(
              part<Adjoint, P / width<Adjoint>, P % width<Adjoint>>(), x)...);
    }(places{});
  }

  /// y = A x, or y ← y + α A x if Add; with Aᵀ for A if Adjoint.
  template <bool Adjoint, bool Add, class S, class X, class Y, class W>
  void run(S const& α, X const& x, Y& y, W& w) const {
    index const* const row_begin = Adjoint ? col_begin_.data() : row_begin_.data();
    index const* const col_begin = Adjoint ? row_begin_.data() : col_begin_.data();
    auto row = [&]<std::size_t I, std::size_t... J>(std::index_sequence<J...>) {
      constexpr std::size_t first = first_block<Adjoint, I>;
      if constexpr (!Add && first == width<Adjoint>) {
        slant::local(y).middleRows(row_begin[I], row_begin[I + 1] - row_begin[I]).setZero();
      }
      (detail::apply_part < !Add &&
           J == first > (part<Adjoint, I, J>(), α, x, col_begin[J], y, row_begin[I],
                         boost::hana::at_c<I * width<Adjoint> + J>(w)),
       ...);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (row.template operator()<I>(std::make_index_sequence<width<Adjoint>>{}), ...);
    }(std::make_index_sequence<height<Adjoint>>{});
  }

  boost::hana::tuple<Rows...> rows_;
  std::array<index, m + 1> row_begin_{};
  std::array<index, n + 1> col_begin_{};
};

/// The operator with these rows of blocks.
template <class... A, class... Rows>
[[nodiscard]] auto block(block_row_of<A...> first, Rows... rest) {
  return block_operator<block_row_of<A...>, Rows...>(std::move(first), std::move(rest)...);
}

// --- schur complement ----------------------------------------------------------------------------
//
// Schur complements of block systems, applied and never formed:
//
//     [ K  B₁ᵀ ; B₂  −D ]   →   S = D + B₂ K⁻¹ B₁ᵀ        [T (3.3)]
//
// The general one has no laws. With B₁ = B₂ = B the closures of sum and congruence apply:
// self-adjoint and semidefinite if K⁻¹ and D are; definite if also D is, or if K⁻¹ is and the rows
// of B are asserted to be independent: schur_complement(Kinv, full_row_rank(B), D).

namespace detail {

/// K⁻¹ as an operator, or a factorisation of K.
template <class K>
concept inverse_operand = factorization_like<std::remove_cvref_t<K>> || operand<K>;

/// K⁻¹ as an operator, from the operator itself or from a factorisation of K.
template <class K>
[[nodiscard]] decltype(auto) as_inverse(K&& k) {
  if constexpr (factorization_like<std::remove_cvref_t<K>>) {
    return slant::inverse(std::forward<K>(k));
  } else {
    require_square("K", k);
    return slant::as_operator(std::forward<K>(k));
  }
}

/// Three overloads that each explain why they do not fit would hide this one sentence.
template <class B>
[[nodiscard]] stand_in refuse_factor() {
  static_assert(adjoint_operand<B>, "schur_complement: B must have apply_adjoint(x, y)");
  return {};
}

}  // namespace detail

/// S = D + B₂ K⁻¹ B₁ᵀ. The first argument is K⁻¹ or a factorisation of K; B₁ needs an adjoint.
/// Throws bad_input naming the argument whose size does not fit.
template <detail::inverse_operand K, operand B1, operand B2, operand D>
[[nodiscard]] auto schur_complement(K&& k_inverse, B1&& b1, B2&& b2, D&& d) {
  if constexpr (!adjoint_operand<B1>) {
    return detail::refuse_factor<B1>();
  } else {
    index const n = k_inverse.rows();
    detail::require_cols("B1", b1, n, "the size of K");
    detail::require_cols("B2", b2, n, "the size of K");
    detail::require_size("D", d, b2.rows(), b1.rows(), "the rows of B2 and of B1");
    return slant::sum(
        std::forward<D>(d),
        slant::product(std::forward<B2>(b2), detail::as_inverse(std::forward<K>(k_inverse)),
                       slant::adjoint(std::forward<B1>(b1))));
  }
}

/// S = D + B K⁻¹ Bᵀ. The first argument is K⁻¹ or a factorisation of K.
template <detail::inverse_operand K, operand B, operand D>
[[nodiscard]] auto schur_complement(K&& k_inverse, B&& b, D&& d) {
  if constexpr (!adjoint_operand<B>) {
    return detail::refuse_factor<B>();
  } else {
    detail::require_cols("B", b, k_inverse.rows(), "the size of K");
    detail::require_size("D", d, b.rows(), b.rows(), "the rows of B");
    return slant::sum(
        std::forward<D>(d),
        slant::congruence(std::forward<B>(b), detail::as_inverse(std::forward<K>(k_inverse))));
  }
}

}  // namespace slant
