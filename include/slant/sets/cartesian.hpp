// SPDX-License-Identifier: MIT
//
// Products of different sets, one after the other in the vector: normal forces in half lines, then
// tangential forces in discs.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/slants.hpp>

#include <Eigen/Core>
#include <boost/hana/basic_tuple.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace slant {
template <class... Parts>
class direct_sum_slant;
}

namespace slant::detail {

// --- base ----------------------------------------------------------------------------------------

/// Parts that follow one another in the vector: sets, or functions.
template <class... Parts>
class part_sequence {
 protected:
  template <std::size_t I>
  using part_type = std::remove_cvref_t<std::tuple_element_t<I, std::tuple<Parts...>>>;

 public:
  explicit part_sequence(held<Parts>... parts) : parts_(std::move(parts)...) {}

  static constexpr std::size_t part_count = sizeof...(Parts);

  /// The parts, as they are kept.
  [[nodiscard]] auto&& parts() && noexcept { return std::move(parts_); }

  template <std::size_t I>
  [[nodiscard]] constexpr part_type<I> const& part() const {
    return boost::hana::at_c<I>(parts_).get();
  }

  /// First component of part I; offset<part_count>() is the dimension.
  template <std::size_t I>
  [[nodiscard]] constexpr index offset() const {
    if constexpr (I == 0) {
      return 0;
    } else {
      return offset<I - 1>() + slant::dimension_of(part<I - 1>());
    }
  }

  /// offset<I>() if the types tell, else -1.
  template <std::size_t I>
  [[nodiscard]] static consteval index static_offset() {
    if constexpr (I == 0) {
      return 0;
    } else {
      constexpr int last = static_dimension_of<part_type<I - 1>>;
      constexpr index before = static_offset<I - 1>();
      return before < 0 || last < 0 ? index{-1} : before + last;
    }
  }

  [[nodiscard]] index block_count() const {
    index n = 0;
    for_each_part([&](auto const& part, auto const&) { n += slant::block_count(part); });
    return n;
  }

  /// f(block, place) for every innermost block.
  template <class F>
  void visit(F&& f) const {
    for_each_part([&](auto const& part, auto const& outer) {
      slant::visit_blocks(part, [&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
    });
  }
  /// f(block, place) for innermost block k.
  template <class F>
  void visit_block(index k, F&& f) const {
    for_each_part([&](auto const& part, auto const& outer) {
      index const l = k - outer.index();
      if (l < 0 || l >= slant::block_count(part)) return;
      slant::visit_block(part, l,
                         [&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
    });
  }

 protected:
  template <std::size_t I>
  [[nodiscard]] constexpr auto place_of(index number = 0) const {
    constexpr index known = static_offset<I>();
    return place<static_dimension_of<part_type<I>>>(number, known < 0 ? offset<I>() : known,
                                                    slant::dimension_of(part<I>()));
  }

  /// f(part, place) for every part.
  template <class F>
  void for_each_part(F&& f) const {
    index number = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((f(part<I>(), place_of<I>(number)), number += slant::block_count(part<I>())), ...);
    }(std::index_sequence_for<Parts...>{});
  }

  /// The slanting operators at x of the projections onto step(part), one after the other.
  template <class X, class Step>
  [[nodiscard]] auto slants_at(X const& x, Step const& step) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      auto const of = [](auto... g) { return direct_sum_slant<decltype(g)...>(std::move(g)...); };
      return of(
          slant::projection_slant(step(part<I>()), argument_of(part<I>(), place_of<I>(), x))...);
    }(std::index_sequence_for<Parts...>{});
  }
  /// The same into an operator made earlier.
  template <class X, class G, class Step>
  void renew_slants(X const& x, G& g, Step const& step) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slant::projection_slant(step(part<I>()), argument_of(part<I>(), place_of<I>(), x),
                               g.template part<I>()),
       ...);
    }(std::index_sequence_for<Parts...>{});
  }

  /// Whether f(part, place) holds for all parts; stops at the first for which it does not.
  template <class F>
  bool all_parts(F&& f) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (f(part<I>(), place_of<I>()) && ...);
    }(std::index_sequence_for<Parts...>{});
  }

 private:
  boost::hana::basic_tuple<held<Parts>...> parts_;
};

/// What products of sets have, whether their dimension is static or not.
template <class... Parts>
class cartesian_base : public part_sequence<Parts...> {
 protected:
  static constexpr bool all_slant = (has_slant<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);
  static constexpr bool all_step =
      (has_step_to_boundary<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);
  static constexpr bool all_support =
      (has_support<std::remove_cvref_t<Parts>, point_t<Parts>> && ...);

  [[nodiscard]] index components() const { return this->template offset<sizeof...(Parts)>(); }

 public:
  using part_sequence<Parts...>::part_sequence;

  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    this->for_each_part([&](auto const& part, auto const& p) { project_part(part, p, x, y); });
  }

  /// x ∈ Λ, up to rounding.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    if (slant::local(x).size() != components()) return false;
    return this->all_parts(
        [&](auto const& part, auto const& p) { return part.contains(argument_of(part, p, x)); });
  }

  /// sup{α >= 0 : x + α d ∈ Λ} for x ∈ Λ. Looks no further once a step below `enough` is found, and
  /// returns that: enough to know that a step of length `enough` would leave Λ.
  template <class X, class D, class S = scalar_t<X>>
  [[nodiscard]] S step_to_boundary(X const& x, D const& d,
                                   std::type_identity_t<S> const& enough = S(0)) const
    requires all_step
  {
    check_rows("x", x, components(), "the dimension of the set");
    check_rows("d", d, components(), "the dimension of the set");
    smallest_step<S> smallest(enough);
    this->all_parts([&](auto const& part, auto const& p) {
      return !smallest(step_of(part, argument_of(part, p, x), argument_of(part, p, d), enough));
    });
    return smallest.value();
  }

  /// sup{yᵀz : z ∈ Λ}, ∞ allowed.
  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const
    requires all_support
  {
    check_rows("y", y, components(), "the dimension of the set");
    scalar_t<Y> sum(0);
    this->for_each_part(
        [&](auto const& part, auto const& p) { sum += part.support(argument_of(part, p, y)); });
    return sum;
  }
};

}  // namespace slant::detail

namespace slant {

// --- block product -------------------------------------------------------------------------------

/// Λ₁ × … × Λ_k of blocks: again a block, of static dimension, of which a power can be made: the
/// half line and the disc of one node, say. Made by `cartesian`.
template <class... Parts>
class block_product : public detail::cartesian_base<Parts...>,
                      public detail::inequality_count<Parts...> {
  using base = detail::cartesian_base<Parts...>;
  using first_type = typename base::template part_type<0>;
  static constexpr bool smooth = detail::all_smooth<Parts...>;

 public:
  static constexpr int dimension = (Parts::dimension + ...);
  static constexpr bool whole_space = (slant::whole_space<Parts> && ...);
  using scalar = set_scalar_t<first_type>;
  using vector_type = Eigen::Matrix<scalar, dimension, 1>;
  using matrix_type = Eigen::Matrix<scalar, dimension, dimension>;

  using base::base;

  /// The product of other blocks of the same types: power(cartesian(…), blocks, blocks, …).
  [[nodiscard]] block_product with(Parts const&... parts) const { return block_product(parts...); }

  [[nodiscard]] static constexpr index size() { return dimension; }

  using base::project;
  template <class X>
  [[nodiscard]] auto project(X const& x) const {
    Eigen::Matrix<scalar_t<X>, dimension, 1> y;
    project(x, y);
    return y;
  }

  /// The slanting operator of the projection at x: block diagonal.
  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires base::all_slant
  {
    Eigen::Matrix<scalar_t<X>, dimension, dimension> g;
    g.setZero();
    this->for_each_part([&](auto const& part, auto const& p) {
      constexpr int n = std::remove_cvref_t<decltype(p)>::dimension;
      auto const first = p.component(0);
      g.template block<n, n>(first, first) = part.slant(p.value(x));
    });
    return g;
  }

  /// The inequalities of all parts, one after the other.
  template <class X>
  [[nodiscard]] auto inequality(X const& x) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, block_product::inequalities, 1> f;
    index row = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      constexpr int k = std::remove_cvref_t<decltype(part)>::inequalities;
      f.template segment<k>(row) = part.inequality(p.value(x));
      row += k;
    });
    return f;
  }
  /// Column i is the gradient of inequality i.
  template <class X>
  [[nodiscard]] auto inequality_gradient(X const& x) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, dimension, block_product::inequalities> g;
    g.setZero();
    index column = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(part)>;
      constexpr int k = block_type::inequalities;
      g.template block<block_type::dimension, k>(p.component(0), column) =
          part.inequality_gradient(p.value(x));
      column += k;
    });
    return g;
  }
  /// Σ ν_i ∇²f_i.
  template <class X, class M>
  [[nodiscard]] auto inequality_hessian(X const& x, M const& multipliers) const
    requires smooth
  {
    Eigen::Matrix<scalar_t<X>, dimension, dimension> h;
    h.setZero();
    index row = 0;
    this->for_each_part([&](auto const& part, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(part)>;
      constexpr int n = block_type::dimension;
      constexpr int k = block_type::inequalities;
      auto const ν = multipliers.template segment<k>(row).eval();
      h.template block<n, n>(p.component(0), p.component(0)) =
          part.inequality_hessian(p.value(x), ν);
      row += k;
    });
    return h;
  }
};

// --- direct sum slant ----------------------------------------------------------------------------

/// diag(P₁, …, P_k) for operators P_i that apply without a workspace to segments of a vector. Every
/// law that all parts declare holds for the direct sum, and it can do what all parts can.
template <class... Parts>
class direct_sum_slant : public detail::direct_sum_base<direct_sum_slant<Parts...>, Parts...> {
 public:
  static constexpr auto laws = (law_set{~0U} & ... & laws_of<Parts>);

  explicit direct_sum_slant(Parts... parts) : parts_(std::move(parts)...) {}

  [[nodiscard]] index rows() const {
    index n = 0;
    for_each([&](auto const& part, index) { n += part.rows(); });
    return n;
  }
  [[nodiscard]] index cols() const { return rows(); }

  /// P_i.
  template <std::size_t I>
  [[nodiscard]] auto const& part() const {
    return boost::hana::at_c<I>(parts_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& part() {
    return boost::hana::at_c<I>(parts_);
  }

  /// f(part, first row of it).
  template <class F>
  void for_each(F&& f) const {
    index first = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((f(part<I>(), first), first += part<I>().rows()), ...);
    }(std::index_sequence_for<Parts...>{});
  }

 private:
  boost::hana::basic_tuple<Parts...> parts_;
};

// --- cartesian -----------------------------------------------------------------------------------

/// Λ₁ × … × Λ_k. Made by `cartesian`. If all parts are blocks, so is the product (block_product);
/// this is the other case, whose dimension is known at run time only. Offsets in front of the first
/// such part are compile-time constants all the same.
template <class... Parts>
class cartesian_product : public detail::cartesian_base<Parts...> {
  using base = detail::cartesian_base<Parts...>;

 public:
  using scalar = set_scalar_t<typename base::template part_type<0>>;

  using base::base;

  /// Number of components.
  [[nodiscard]] index size() const { return this->template offset<sizeof...(Parts)>(); }

  /// The slanting operator of the projection at x.
  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires base::all_slant
  {
    detail::check_rows("x", x, size(), "the dimension of the set");
    return this->slants_at(x, [](auto const& part) -> auto const& { return part; });
  }

  /// The same into an operator that slant(x) made earlier; does not allocate unless a part must.
  template <class X, class... Slants>
  void slant(X const& x, direct_sum_slant<Slants...>& g) const
    requires base::all_slant
  {
    detail::check_rows("x", x, size(), "the dimension of the set");
    this->renew_slants(x, g, [](auto const& part) -> auto const& { return part; });
  }
};

namespace detail {

/// One complaint per part that is no set; a fold over the parts would only say that one is not.
template <class Part>
consteval bool check_part() {
  static_assert(set_part<Part>, "a part of a cartesian product must be a convex set");
  return true;
}

}  // namespace detail

/// Λ₁ × … × Λ_k: cartesian(half_lines(m), discs(g)). Products passed as lvalues are referenced,
/// rvalues and blocks are owned. A product of blocks is itself a block.
template <class... Parts>
  requires(sizeof...(Parts) > 0)
[[nodiscard]] auto cartesian(Parts&&... parts) {
  if constexpr (!(set_part<std::remove_cvref_t<Parts>> && ...)) {
    static_cast<void>((detail::check_part<std::remove_cvref_t<Parts>>() && ...));
    return detail::stand_in{};
  } else if constexpr ((has_static_dimension<std::remove_cvref_t<Parts>> && ...)) {
    return block_product<std::remove_cvref_t<Parts>...>(std::remove_cvref_t<Parts>(parts)...);
  } else {
    return cartesian_product<detail::kept_part_t<Parts>...>(
        held<detail::kept_part_t<Parts>>(std::forward<Parts>(parts))...);
  }
}

}  // namespace slant
