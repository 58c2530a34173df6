// SPDX-License-Identifier: MIT
//
// Powers: m blocks of one shape, each with parameters of its own. power(ball<2>{}, radii) are the
// friction discs of m nodes; the power of a function φ is the sum φ₁(x₁) + … + φ_m(x_m), as of m
// springs.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/sets/slants.hpp>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// What powers of sets and of functions share: m blocks of the type Block with n components.
template <class Block, class Layout, class Blocks>
class equal_parts {
 public:
  using scalar = set_scalar_t<Block>;
  using block_type = Block;
  using layout = Layout;

  explicit equal_parts(Blocks blocks) : blocks_(std::move(blocks)) {}

  /// Number of components, m n.
  [[nodiscard]] index size() const { return blocks_.size() * n; }
  /// Number of innermost blocks: m, or more if Block is itself a product.
  [[nodiscard]] index block_count() const {
    return blocks_.size() == 0 ? 0 : blocks_.size() * slant::block_count(blocks_[0]);
  }
  /// Factor i of the power, 0 <= i < m.
  [[nodiscard]] Block const& block(index i) const { return blocks_[i]; }

  /// New parameters for all blocks (lists of length m, or one value for all); does not allocate.
  /// @throws bad_input naming parameter and block; nothing is changed then.
  template <class... Params>
  void update(Params const&... params)
    requires takes_parameters<Block, Params...> && requires(Blocks& b) { b.update(params...); }
  {
    blocks_.update(params...);
  }

  /// f(block, place) for every innermost block.
  template <class F>
  void visit(F&& f) const {
    auto const blocks = blocks_.view();
    for (index i = 0; i < blocks_.size(); ++i) {
      if constexpr (has_visit<Block>) {
        auto const outer = at(i);
        blocks[i].visit([&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
      } else {
        f(blocks[i], at(i));
      }
    }
  }
  /// f(block, place) for innermost block k.
  template <class F>
  void visit_block(index k, F&& f) const {
    if constexpr (has_visit<Block>) {
      index const inner_count = slant::block_count(blocks_[0]);
      auto const outer = at(k / inner_count);
      slant::visit_block(blocks_[k / inner_count], k % inner_count,
                         [&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
    } else {
      f(blocks_[k], at(k));
    }
  }

 protected:
  static constexpr int n = Block::dimension;

  /// Where factor i is, numbered by innermost blocks.
  [[nodiscard]] auto at(index i) const {
    if constexpr (has_visit<Block>) {
      return block_place<n, Layout>(i, blocks_.size(), slant::block_count(blocks_[i]));
    } else {
      return block_place<n, Layout>(i, blocks_.size(), index(1));
    }
  }

  /// f(block, place) for every factor, innermost or not.
  template <class F>
  void for_each_factor(F&& f) const {
    auto const blocks = blocks_.view();
    for (index i = 0; i < blocks_.size(); ++i) f(blocks[i], at(i));
  }

  Blocks blocks_;
};

}  // namespace detail

/// Λ₁ × … × Λ_m, all of the type Block with n components. Made by `power`. Every member costs what
/// a loop over the blocks written by hand costs; none allocates except slant(x).
template <class Block, class Layout, class Blocks>
class power_product : public detail::equal_parts<Block, Layout, Blocks> {
  using base = detail::equal_parts<Block, Layout, Blocks>;
  using base::at, base::blocks_, base::n;
  using vector_type = Eigen::Matrix<set_scalar_t<Block>, n, 1>;

 public:
  using base::base;
  using base::size;

  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    eigen_assert(from.size() == size() && to.size() == size());
    if constexpr (!whole_space<Block>) {
      project_blocks(from, to);
    } else if (!detail::same_memory(from, to)) {
      to.head(size()) = from;
    }
  }

  /// x ∈ Λ, up to rounding.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    auto const& entries = slant::local(x);
    if (entries.size() != size()) return false;
    if constexpr (whole_space<Block>) {
      return !entries.hasNaN();
    } else {
      auto const blocks = blocks_.view();
      for (index i = 0; i < blocks_.size(); ++i) {
        if (!blocks[i].contains(at(i).value(entries))) return false;
      }
      return true;
    }
  }

  /// sup{α >= 0 : x + α d ∈ Λ} for x ∈ Λ. Looks no further once a step below `enough` is found, and
  /// returns that: enough to know that a step of length `enough` would leave Λ.
  template <class X, class D, class S = scalar_t<X>>
  [[nodiscard]] S step_to_boundary(X const& x, D const& d,
                                   std::type_identity_t<S> const& enough = S(0)) const
    requires has_step_to_boundary<Block, vector_type>
  {
    detail::check_rows("x", x, size(), "the dimension of the set");
    detail::check_rows("d", d, size(), "the dimension of the set");
    detail::smallest_step<S> smallest(enough);
    if constexpr (!whole_space<Block>) {
      auto const blocks = blocks_.view();
      for (index i = 0; i < blocks_.size(); ++i) {
        auto const p = at(i);
        if (smallest(detail::step_of(blocks[i], p.value(x), p.value(d), enough))) break;
      }
    }
    return smallest.value();
  }

  /// sup{yᵀz : z ∈ Λ}, ∞ allowed.
  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const
    requires has_support<Block, vector_type>
  {
    detail::check_rows("y", y, size(), "the dimension of the set");
    scalar_t<Y> sum(0);
    auto const blocks = blocks_.view();
    for (index i = 0; i < blocks_.size(); ++i) sum += blocks[i].support(at(i).value(y));
    return sum;
  }

  /// The slanting operator of the projection at x: block diagonal, symmetric, 0 ⪯ G ⪯ I.
  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires has_slant<Block, vector_type>
  {
    detail::power_slant<scalar_t<X>, Block, Layout> g(blocks_.size());
    slant(x, g);
    return g;
  }

  /// The same into an operator that slant(x) made earlier; does not allocate.
  template <class X>
  void slant(X const& x, detail::power_slant<scalar_t<X>, Block, Layout>& g) const
    requires has_slant<Block, vector_type>
  {
    detail::check_rows("x", x, size(), "the dimension of the set");
    eigen_assert(g.block_count() == blocks_.size());
    if constexpr (!whole_space<Block>) {
      auto const blocks = blocks_.view();
      for (index i = 0; i < blocks_.size(); ++i) g.assign(i, blocks[i].slant(at(i).value(x)));
    }
  }

 private:
  template <class X, class Y>
  void project_blocks(X const& from, Y& to) const {
    if constexpr (requires { blocks_.repeats_one(); }) {
      if (blocks_.repeats_one()) {
        detail::identical_blocks<Block> const same(blocks_[0], blocks_.size());
        project_each(same.view(), from, to);
      } else {
        project_each(blocks_.view().first, from, to);
      }
    } else {
      project_each(blocks_.view(), from, to);
    }
  }
  template <class View, class X, class Y>
  void project_each(View const& blocks, X const& from, Y& to) const {
    index const m = blocks_.size();
    // Where `from` and `to` share memory they are the same: iterations are independent. Not knowing
    // that, a compiler vectorises for separate arrays only.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (index i = 0; i < m; ++i) detail::project_part(blocks[i], at(i), from, to);
  }
};

/// φ₁(x₁) + … + φ_m(x_m), all of the type Block, a function of n components. Made by `power`. None
/// of its members allocates except slant(ρ, z).
template <class Block, class Layout, class Blocks>
class function_power : public detail::equal_parts<Block, Layout, Blocks> {
  using base = detail::equal_parts<Block, Layout, Blocks>;
  using base::blocks_, base::for_each_factor, base::n;
  using vector_type = Eigen::Matrix<set_scalar_t<Block>, n, 1>;

 public:
  using base::base;

  /// x = prox_{ρφ}(z), ρ > 0; x may be z.
  template <class S, class Z, class X>
  void prox(S const& ρ, Z const& z, X&& x) const {
    for_each_factor([&](auto const& b, auto const& p) { p.put(x, slant::prox(b, ρ, p.value(z))); });
  }
  /// φ(x), ∞ where a summand is.
  template <class X>
  [[nodiscard]] scalar_t<X> value(X const& x) const {
    scalar_t<X> sum(0);
    for_each_factor([&](auto const& b, auto const& p) { sum += b.value(p.value(x)); });
    return sum;
  }
  /// φ*(v), the sum of the conjugates.
  template <class V>
  [[nodiscard]] scalar_t<V> conjugate(V const& v) const
    requires has_conjugate<Block, vector_type>
  {
    scalar_t<V> sum(0);
    for_each_factor([&](auto const& b, auto const& p) { sum += b.conjugate(p.value(v)); });
    return sum;
  }

  /// The slanting operator of the proximal map at z: block diagonal, symmetric, 0 ⪯ G ⪯ I.
  template <class S, class Z>
    requires has_slant<step_t<Block const&, S>, vector_type>
  [[nodiscard]] auto slant(S const& ρ, Z const& z) const {
    block_diagonal_slant<scalar_t<Z>, n, Layout> g(blocks_.size());
    slant(ρ, z, g);
    return g;
  }
  /// The same into an operator made earlier.
  template <class S, class Z>
    requires has_slant<step_t<Block const&, S>, vector_type>
  void slant(S const& ρ, Z const& z, block_diagonal_slant<scalar_t<Z>, n, Layout>& g) const {
    detail::check_rows("z", z, this->size(), "the dimension of the function");
    for (index i = 0; i < blocks_.size(); ++i) {
      g.assign(i, blocks_[i].slant(ρ, this->at(i).value(z)));
    }
  }
};

/// Λ₁ × … × Λ_m of one shape, or φ₁ + … + φ_m of one function, in the layout `consecutive`
/// (default) or `planar`:
///     power(block, m)              m copies of a block: power(free_space<1>{}, m)
///     power(shape, parameters…)    one block shape.with(parameters[i]…) per entry of the lists
///                                  (Eigen or standard vectors of one length; a single number
///                                  stands for all blocks): power<planar>(ball<2>{}, radii),
///                                  power(interval<>{}, 0.0, upper)
/// @throws bad_input naming parameter and block, "radius[3]: got -1, expected a number >= 0".
template <class Layout = consecutive, class Block, class... Params>
  requires detail::power_parameters<Block, Params...>
[[nodiscard]] auto power(Block const& shape, Params const&... params) {
  // What has prox is meant as a function, all else as a set.
  if constexpr (has_static_dimension<Block> && function_part<Block> &&
                !proximable<Block, point_t<Block>>) {
    static_assert(proximable<Block, point_t<Block>>, "power: a function must have value(x)");
    return detail::stand_in{};
  } else if constexpr (!has_static_dimension<Block> ||
                       (!function_part<Block> && !set_part<Block>)) {
    static_assert(set_block<Block>,
                  "power: the shape must be a convex set or function of fixed dimension");
    return detail::stand_in{};
  } else {
    auto const of = [&]<class Blocks>(Blocks blocks) {
      using made = std::conditional_t<function_part<Block>, function_power<Block, Layout, Blocks>,
                                      power_product<Block, Layout, Blocks>>;
      return made(std::move(blocks));
    };
    if constexpr (detail::is_count<Params...>) {
      return of(detail::identical_blocks<Block>(shape, static_cast<index>(params)...));
    } else {
      return of(detail::listed_blocks<Block>(shape, params...));
    }
  }
}

}  // namespace slant
