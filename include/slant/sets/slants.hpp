// SPDX-License-Identifier: MIT
//
// Slanting operators of projections: onto any set, onto products of blocks.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant {

// --- block diagonal slant ------------------------------------------------------------------------
//
// The slanting operator of a projection onto a product: one small symmetric matrix per block, and
// nothing at all for blocks without a constraint. With other laws than those of a nearest point the
// blocks are any small matrices: what functions given block by block need.

namespace detail {

/// What the slanting operators of nearest points promise.
[[nodiscard]] consteval law_set projection_laws(bool identity) {
  return identity ? slant::laws<slant::self_adjoint, slant::positive_definite, slant::projector>
                  : slant::laws<slant::self_adjoint, slant::firmly_nonexpansive>;
}

}  // namespace detail

/// diag(G₁, …, G_m) with N × N blocks in the places that Layout says; with the laws L of a nearest
/// point (the default) symmetric, 0 ⪯ G_i ⪯ I. With Identity all blocks are I: nothing is stored or
/// computed. Half lines and intervals (N = 1) store one number per block, 0 or 1.
template <class S, int N, class Layout = consecutive, bool Identity = false,
          law_set L = detail::projection_laws(Identity)>
class block_diagonal_slant {
 public:
  using scalar = S;
  using matrix_type = Eigen::Matrix<S, N, N>;
  static constexpr law_set laws = L;

  /// m blocks, to be assigned; allocates.
  explicit block_diagonal_slant(index m)
      : count_(m), entries_(index{N}, Identity ? index{0} : N * m) {}

  [[nodiscard]] index rows() const { return N * count_; }
  [[nodiscard]] index cols() const { return N * count_; }
  [[nodiscard]] index block_count() const { return count_; }

  /// G_i, an N × N matrix.
  [[nodiscard]] auto block(index i) const {
    if constexpr (Identity) {
      static_cast<void>(i);
      return matrix_type::Identity();
    } else {
      return entries_.template middleCols<N>(N * i);
    }
  }

  /// G_i = g, which keeps the laws.
  template <class G>
  void assign(index i, G const& g)
    requires(!Identity)
  {
    entries_.template middleCols<N>(N * i) = g;
  }

  /// f(G_i, place) for every block.
  template <class F>
  void visit(F&& f) const {
    for (index i = 0; i < count_; ++i) f(block(i), at(i));
  }

  /// y = G x; several columns at once are fine.
  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    combine<false>(slant::local(x), slant::local(y),
                   [](auto const&, auto const& gx) { return gx; });
  }

  /// y ← y + α G x.
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    combine<false>(slant::local(x), slant::local(y),
                   [&α](auto const& yi, auto const& gx) { return S(yi + α * gx); });
  }

  /// y = Gᵀx, where that is not G x.
  template <class X, class Y>
    requires(!L.contains(law::self_adjoint))
  void apply_adjoint(X const& x, Y& y) const {
    combine<true>(slant::local(x), slant::local(y), [](auto const&, auto const& gx) { return gx; });
  }
  template <class X, class Y>
    requires(!L.contains(law::self_adjoint))
  void apply_adjoint_add(S const& α, X const& x, Y& y) const {
    combine<true>(slant::local(x), slant::local(y),
                  [&α](auto const& yi, auto const& gx) { return S(yi + α * gx); });
  }

  /// d = diag(G).
  template <class V>
  void diagonal(V& d) const {
    auto& entries = slant::local(d);
    visit([&](auto const& g, auto const& p) {
      for (index j = 0; j < N; ++j) entries.coeffRef(p.component(j)) = g.coeff(j, j);
    });
  }

 private:
  [[nodiscard]] auto at(index i) const { return block_place<N, Layout>(i, count_); }

  /// y_j = result(y_j, (G x)_j), or (Gᵀx)_j, for every component j of every column.
  template <bool Adjoint, class X, class Y, class Result>
  void combine(X const& x, Y& y, Result const& result) const {
    for (index k = 0; k < index(x.cols()); ++k) {
      for (index i = 0; i < count_; ++i) {
        auto const p = at(i);
        for (index j = 0; j < N; ++j) {
          auto& target = y.coeffRef(p.component(j), k);
          if constexpr (Identity) {
            target = result(target, x.coeff(p.component(j), k));
          } else {
            auto const entry = [&](index l) -> S const& {
              return Adjoint ? entries_.coeffRef(l, N * i + j) : entries_.coeffRef(j, N * i + l);
            };
            S sum = entry(0) * x.coeff(p.component(0), k);
            for (index l = 1; l < N; ++l) sum += entry(l) * x.coeff(p.component(l), k);
            target = result(target, sum);
          }
        }
      }
    }
  }

  index count_;
  Eigen::Matrix<S, N, Eigen::Dynamic> entries_;
};

namespace detail {

/// The slanting operator of a power of the block C.
template <class S, class C, class Layout = consecutive>
using power_slant = block_diagonal_slant<S, C::dimension, Layout, whole_space<C>>;

// --- projection slant ----------------------------------------------------------------------------
//
// The slanting operator of the projection onto any set, as an operator: blocks give a small matrix,
// products give an operator, methods want the latter from both.

struct projection_slant_fn {
  /// A new operator; allocates.
  template <class C, class X>
    requires has_slant<C, X>
  [[nodiscard]] auto operator()(C const& c, X const& x) const {
    if constexpr (has_static_dimension<C>) {
      power_slant<scalar_t<X>, C> g(1);
      (*this)(c, x, g);
      return g;
    } else {
      return c.slant(x);
    }
  }
  /// Into an operator made earlier for the same set; no allocation if the set can do without.
  template <class C, class X, class G>
    requires has_slant<C, X>
  void operator()(C const& c, X const& x, G& g) const {
    if constexpr (has_static_dimension<C>) {
      if constexpr (!whole_space<C>) g.assign(0, c.slant(slant::local(x)));
    } else if constexpr (requires { c.slant(x, g); }) {
      c.slant(x, g);
    } else {
      g = c.slant(x);
    }
  }
};

}  // namespace detail

/// P_Λ°(x) as an operator: projection_slant(set, x), or projection_slant(set, x, g) in place.
inline constexpr detail::projection_slant_fn projection_slant{};

// --- direct sum ----------------------------------------------------------------------------------

namespace detail {

template <class X>
using rows_of_t = decltype(slant::local(std::declval<X&>()).middleRows(index{}, index{}));

/// P applies to its rows of X, into its rows of Y.
template <class P, class X, class Y>
concept applies_to_rows =
    requires(P const& part, rows_of_t<X const> const x, rows_of_t<Y> y) { part.apply(x, y); };

/// P adds to its rows of Y.
template <class P, class X, class Y>
concept accumulates_rows = requires(P const& part, scalar_t<X> α, rows_of_t<X const> const x,
                                    rows_of_t<Y> y) { part.apply_add(α, x, y); };

/// P writes its diagonal into its rows of V.
template <class P, class V>
concept writes_diagonal_rows = requires(P const& part, rows_of_t<V> d) { part.diagonal(d); };

/// What the direct sum of Parts does; Sum has for_each(f), which calls f(part, its first row).
template <class Sum, class... Parts>
class direct_sum_base {
 public:
  /// y = G x.
  template <class X, class Y>
    requires(applies_to_rows<Parts, X, Y> && ...)
  void apply(X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    sum().for_each([&](auto const& part, index first) {
      auto const xs = from.middleRows(first, part.rows());
      auto ys = to.middleRows(first, part.rows());
      part.apply(xs, ys);
    });
  }

  /// y ← y + α G x.
  template <class X, class Y>
    requires(accumulates_rows<Parts, X, Y> && ...)
  void apply_add(scalar_t<X> const& α, X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    sum().for_each([&](auto const& part, index first) {
      auto const xs = from.middleRows(first, part.rows());
      auto ys = to.middleRows(first, part.rows());
      part.apply_add(α, xs, ys);
    });
  }

  /// d = diag(G).
  template <class V>
    requires(writes_diagonal_rows<Parts, V> && ...)
  void diagonal(V& d) const {
    auto& entries = slant::local(d);
    sum().for_each([&](auto const& part, index first) {
      auto ds = entries.middleRows(first, part.rows());
      part.diagonal(ds);
    });
  }

 private:
  [[nodiscard]] Sum const& sum() const { return static_cast<Sum const&>(*this); }
};

}  // namespace detail

}  // namespace slant
