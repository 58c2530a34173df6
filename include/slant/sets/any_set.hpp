// SPDX-License-Identifier: MIT
//
// A product of blocks of which only the scalar is in the type: how many there are, of which kinds
// and in which order is known at run time. With any_operator.hpp it makes one type of many
// quadratic programs, so that a method is compiled once for all of them (problems/any_qp.hpp).
//
//     slant::any_set<> const Λ(slant::cartesian(slant::half_lines(m), slant::discs(g)));
//
// Intuition. Blocks of one kind that follow one another are a run, a power_product that looks at
// the blocks of the set that it is made of; the set is a list of runs, and which kind a run is of
// is asked once for the whole run and not once for each block. Inside the loop it is the code of
// the given set, with the same bits (only that a free block is passed over, also if its component
// is NaN). Bounds that the given set changes by update() have changed here as well.
//
// Rejected: virtual functions. Methods visit blocks with functions of their own (faces, barriers,
// certificates), of which a base class would have to list every one; and a virtual call for each
// block costs more than the block. So the kinds are a closed list, by default those of
// contact_sets.hpp with ball<3> and ellipse; all have an inequality form, which some methods ask
// for. A set with other blocks keeps its type, and methods are instantiated for it.
#pragma once

#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/sets/slants.hpp>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace slant {

namespace detail {

template <class C>
inline constexpr bool repeats_one_block = false;
template <class Block, class Layout>
inline constexpr bool repeats_one_block<power_product<Block, Layout, identical_blocks<Block>>> =
    true;

/// The blocks of another set: a power of listed or of identical ones, or a single block.
template <class Block>
class viewed_blocks {
 public:
  /// What a loop indexes.
  struct range {
    Block const* first;
    index step;  // 0 where all are the same one
    Block const& operator[](index i) const { return first[i * step]; }
  };

  /// A power of listed or identical blocks, or a single block; it must outlive this object.
  template <class C>
  explicit viewed_blocks(C const& set) : set_(&set), first_(&first_of<C>) {
    if constexpr (!std::same_as<C, Block>) {
      count_ = set.size() / Block::dimension;
      step_ = repeats_one_block<C> ? 0 : 1;
    }
  }

  [[nodiscard]] index size() const { return count_; }
  /// All are the same one, and there is one.
  [[nodiscard]] bool repeats_one() const { return step_ == 0 && count_ > 0; }
  [[nodiscard]] Block const& operator[](index i) const { return view()[i]; }
  [[nodiscard]] range view() const {
    return {count_ > 0 ? static_cast<Block const*>(first_(set_)) : nullptr, step_};
  }

 private:
  template <class C>
  static void const* first_of(void const* set) {
    if constexpr (std::same_as<C, Block>) {
      return set;
    } else {
      return &static_cast<C const*>(set)->block(0);
    }
  }

  void const* set_;
  void const* (*first_)(void const*);  // of the blocks, which lie elsewhere after an assignment
  index count_ = 1, step_ = 1;
};

}  // namespace detail

/// A run: blocks of one kind, one after the other or planar.
template <class Block, class Layout = consecutive>
using run_of = power_product<Block, Layout, detail::viewed_blocks<Block>>;

/// The kinds of an any_set unless others are listed. (A class and not a list of them, which would
/// be a thousand characters in the name of each function.)
template <class S>
struct usual_runs {
  using type =
      std::variant<run_of<half_line<S>>, run_of<interval<S>>, run_of<symmetric_interval<S>>,
                   run_of<free_space<1, S>>, run_of<ball<2, S>>, run_of<ball<2, S>, planar>,
                   run_of<ball<3, S>>, run_of<ellipse<S>>, run_of<ellipse<S>, planar>,
                   run_of<plane_cone<S>>, run_of<second_order_cone<3, S>>>;
};

/// The kinds that the forces of contact with Tresca friction have: what a method is instantiated
/// for is less.
template <class S>
struct contact_runs {
  using type =
      std::variant<run_of<half_line<S>>, run_of<symmetric_interval<S>>, run_of<ball<2, S>>>;
};

namespace detail {

template <class T, class V>
inline constexpr bool is_alternative = false;
template <class T, class... Ts>
inline constexpr bool is_alternative<T, std::variant<Ts...>> = (std::same_as<T, Ts> || ...);

/// What a run is made of: a power, or a single block.
template <class C>
struct run_type {
  using type = void;
};
template <class Block, class Layout, class Blocks>
struct run_type<power_product<Block, Layout, Blocks>> {
  using type = run_of<Block, Layout>;
};
template <class C>
  requires has_static_dimension<C>
struct run_type<C> {
  using type = run_of<C>;
};
template <class C>
using run_type_t = typename run_type<C>::type;

/// The kinds of C, part by part, are among Runs.
template <class Runs, class C>
[[nodiscard]] consteval bool is_made_of() {
  using run = run_type_t<C>;
  if constexpr (is_alternative<run, typename Runs::type>) {
    return true;
  } else if constexpr (requires { C::part_count; }) {
    return []<std::size_t... I>(std::index_sequence<I...>) {
      return (
          is_made_of<
              Runs, std::remove_cvref_t<decltype(std::declval<C const&>().template part<I>())>>() &&
          ...);
    }(std::make_index_sequence<C::part_count>{});
  } else {
    return false;
  }
}

/// All kinds of Others are among Runs.
template <class Runs, class Others>
inline constexpr bool has_kinds_of = false;
template <class Runs, class... Run>
inline constexpr bool has_kinds_of<Runs, std::variant<Run...>> = (is_alternative<Run, Runs> && ...);

/// The slanting operator of a run; runs with blocks of one size have the same.
template <class S>
using any_run_slant =
    std::variant<block_diagonal_slant<S, 1>, block_diagonal_slant<S, 1, consecutive, true>,
                 block_diagonal_slant<S, 2>, block_diagonal_slant<S, 2, planar>,
                 block_diagonal_slant<S, 3>>;

template <class S, class Runs>
inline constexpr bool has_slants_of = false;
template <class S, class... Block, class... Layout, class... Blocks>
inline constexpr bool has_slants_of<S, std::variant<power_product<Block, Layout, Blocks>...>> =
    (is_alternative<power_slant<S, Block, Layout>, any_run_slant<S>> && ...);

}  // namespace detail

template <scalar S, class Runs>
class any_set;

/// The slanting operator of the projection onto an any_set, that of run after run.
template <scalar S>
class any_set_slant : public detail::direct_sum_base<any_set_slant<S>> {
 public:
  using scalar = S;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::firmly_nonexpansive>;

  [[nodiscard]] index rows() const { return size_; }
  [[nodiscard]] index cols() const { return size_; }

  /// f(slant of a run, its first row).
  template <class F>
  void for_each(F const& f) const {
    index first = 0;
    for (auto const& run : runs_) {
      std::visit(
          [&](auto const& g) {
            f(g, first);
            first += g.rows();
          },
          run);
    }
  }

 private:
  template <slant::scalar, class>
  friend class any_set;
  any_set_slant() = default;

  std::vector<detail::any_run_slant<S>> runs_{};
  index size_ = 0;
};

/// Λ₁ × … × Λ_m of the kinds listed in Runs::type, a std::variant; see the top of this file. Refers
/// to a set that it is made of as an lvalue, owns an rvalue; copies share it. Nothing allocates but
/// the constructor and slant(x).
template <scalar S = double, class Runs = usual_runs<S>>
class any_set {
  static_assert(detail::has_slants_of<S, typename Runs::type>,
                "any_set: runs of blocks with one, two or three components; planar ones with two");

 public:
  using scalar = S;

  /// The whole space of dimension 0.
  any_set() = default;
  /// The same set as `set`.
  template <class C>
    requires(!std::same_as<std::remove_cvref_t<C>, any_set> &&
             detail::is_made_of<Runs, std::remove_cvref_t<C>>())
  explicit any_set(C&& set) {
    if constexpr (std::is_lvalue_reference_v<C>) {
      add(set);
    } else {
      auto const owned = std::make_shared<std::remove_cvref_t<C> const>(std::forward<C>(set));
      add(*owned);
      owned_ = owned;
    }
  }

  /// The same set as one of fewer kinds; refers to what that refers to, and shares what it owns.
  template <class Others>
    requires(detail::has_kinds_of<typename Runs::type, typename Others::type>)
  explicit any_set(any_set<S, Others> const& set) : owned_(set.owned_) {
    for (auto const& some : set.runs_) std::visit([&](auto const& run) { add(run); }, some);
  }

  [[nodiscard]] index size() const { return size_; }
  [[nodiscard]] index block_count() const { return block_count_; }

  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    each_run([&](auto const& run, auto const& p) { detail::project_part(run, p, x, y); });
  }
  /// x ∈ Λ, up to rounding.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    if (slant::local(x).size() != size_) return false;
    bool inside = true;
    each_run([&](auto const& run, auto const& p) { inside = inside && run.contains(p.in(x)); });
    return inside;
  }
  /// sup{α >= 0 : x + α d ∈ Λ} for x ∈ Λ, or any step below `enough` that is known to be too long.
  template <class X, class D, class T = scalar_t<X>>
  [[nodiscard]] T step_to_boundary(X const& x, D const& d,
                                   std::type_identity_t<T> const& enough = T(0)) const {
    detail::check_rows("x", x, size(), "the dimension of the set");
    detail::check_rows("d", d, size(), "the dimension of the set");
    detail::smallest_step<T> smallest(enough);
    bool more = true;
    each_run([&](auto const& run, auto const& p) {
      if (more) more = !smallest(run.step_to_boundary(p.in(x), p.in(d), enough));
    });
    return smallest.value();
  }
  /// sup{yᵀz : z ∈ Λ}, ∞ allowed.
  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const {
    detail::check_rows("y", y, size(), "the dimension of the set");
    scalar_t<Y> sum(0);
    each_run([&](auto const& run, auto const& p) { sum += run.support(p.in(y)); });
    return sum;
  }
  /// The slanting operator of the projection at x; allocates.
  template <class X>
  [[nodiscard]] any_set_slant<S> slant(X const& x) const {
    detail::check_rows("x", x, size(), "the dimension of the set");
    any_set_slant<S> g;
    g.size_ = size_;
    each_run([&](auto const& run, auto const& p) { g.runs_.emplace_back(run.slant(p.in(x))); });
    return g;
  }
  /// The same into an operator that slant(x) made earlier; does not allocate.
  template <class X>
  void slant(X const& x, any_set_slant<S>& g) const {
    detail::check_rows("x", x, size(), "the dimension of the set");
    eigen_assert(g.runs_.size() == runs_.size());
    auto next = g.runs_.begin();
    each_run([&](auto const& run, auto const& p) {
      using slant_type = std::remove_cvref_t<decltype(run.slant(p.in(x)))>;
      run.slant(p.in(x), std::get<slant_type>(*next++));
    });
  }
  /// f(block, place) for every block.
  template <class F>
  void visit(F&& f) const {
    each_run([&](auto const& run, auto const& outer) {
      run.visit([&](auto const& block, auto const& inner) { f(block, outer.then(inner)); });
    });
  }
  /// f(block, place) for block k.
  template <class F>
  void visit_block(index k, F&& f) const {
    each_run([&](auto const& run, auto const& outer) {
      index const l = k - outer.index();
      if (l < 0 || l >= run.block_count()) return;
      run.visit_block(l, [&](auto const& b, auto const& inner) { f(b, outer.then(inner)); });
    });
  }
  /// f(first component, size) for every run, as the parts of the set that it was made of.
  template <class F>
  void visit_parts(F const& f) const {
    each_run([&](auto const&, auto const& p) { f(p.component(0), p.size()); });
  }

 private:
  template <slant::scalar, class>
  friend class any_set;

  template <class C>
  void add(C const& set) {
    using run = detail::run_type_t<C>;
    if constexpr (std::same_as<run, C>) {
      size_ += set.size();
      block_count_ += set.block_count();
      runs_.emplace_back(set);
    } else if constexpr (detail::is_alternative<run, typename Runs::type>) {
      detail::viewed_blocks<typename run::block_type> blocks(set);
      size_ += slant::dimension_of(set);
      block_count_ += blocks.size();
      runs_.emplace_back(run(blocks));
    } else {
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        (add(set.template part<I>()), ...);
      }(std::make_index_sequence<C::part_count>{});
    }
  }

  /// f(run, place) for all runs.
  template <class F>
  void each_run(F const& f) const {
    index number = 0, first = 0;
    for (auto const& some : runs_) {
      std::visit(
          [&](auto const& run) {
            f(run, place<>(number, first, run.size()));
            number += run.block_count();
            first += run.size();
          },
          some);
    }
  }

  std::vector<typename Runs::type> runs_{};
  index size_ = 0, block_count_ = 0;
  std::shared_ptr<void const> owned_{};
};

template <class C>
any_set(C&&) -> any_set<set_scalar_t<std::remove_cvref_t<C>>>;

}  // namespace slant
