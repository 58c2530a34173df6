// SPDX-License-Identifier: MIT
//
// What every product of sets does with its parts, whether a part is a block of fixed dimension
// (which takes and returns its few numbers by value) or itself a product (which works in place).
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

// --- place ---------------------------------------------------------------------------------------
//
// Where the block of a product lives inside the vector: component j of the block is entry
// first + j · stride. Such places are closed under nesting, so a product of products of blocks
// still tells each block in three numbers where its part is.

/// Layout of a power of blocks with n components each: block i owns entries n·i … n·i + n − 1.
struct consecutive {};

/// Layout of a power of m blocks: component j of block i is entry i + j·m. This is the numbering
/// λ = (all first components, all second components, …) of [T] and [K].
struct planar {};

/// The place of one block. N is its dimension (Eigen::Dynamic: known at run time only).
template <int N = Eigen::Dynamic, class Layout = consecutive>
class place {
  static constexpr bool strided = std::is_same_v<Layout, planar>;
  static_assert(!strided || N != Eigen::Dynamic, "only blocks of static dimension can be planar");

 public:
  static constexpr int dimension = N;

  constexpr place(slant::index number, slant::index first, slant::index size,
                  slant::index stride = 1)
      : number_(number), first_(first), size_(size), stride_(stride) {}

  /// Number of the block, counted over all blocks of the outermost product.
  [[nodiscard]] constexpr slant::index index() const { return number_; }
  /// Number of components of the block.
  [[nodiscard]] constexpr slant::index size() const { return N == Eigen::Dynamic ? size_ : N; }
  /// Position of component j of the block in the whole vector.
  [[nodiscard]] constexpr slant::index component(slant::index j) const {
    return strided ? first_ + j * stride_ : first_ + j;
  }

  /// The block's part of x as an Eigen view, writable if x is; a copy if x is an expression without
  /// memory of its own and the layout is planar.
  template <class X>
  [[nodiscard]] auto in(X& x) const {
    auto& entries = slant::local(x);
    using L = std::remove_reference_t<decltype(entries)>;
    if constexpr (!strided && N == Eigen::Dynamic) {
      return entries.segment(first_, size_);
    } else if constexpr (!strided) {
      return entries.template segment<N>(first_);
    } else if constexpr (bool(L::Flags & Eigen::DirectAccessBit)) {
      using block = Eigen::Matrix<typename L::Scalar, N, 1>;
      constexpr bool is_const = std::is_const_v<std::remove_pointer_t<decltype(entries.data())>>;
      using target = std::conditional_t<is_const, block const, block>;
      auto const inner = entries.innerStride();
      return Eigen::Map<target, Eigen::Unaligned, Eigen::InnerStride<>>(
          entries.data() + first_ * inner, Eigen::InnerStride<>(stride_ * inner));
    } else {
      return value(x);
    }
  }

  /// A copy of the block's part of x, in registers for small static N.
  template <class X>
  [[nodiscard]] auto value(X const& x) const {
    auto const& entries = slant::local(x);
    using S = scalar_t<X>;
    Eigen::Matrix<S, N, 1> v;
    if constexpr (N == Eigen::Dynamic) v.resize(size_);
    for (slant::index j = 0; j < size(); ++j) v.coeffRef(j) = entries.coeff(component(j));
    return v;
  }

  /// The block's part of y = v.
  template <class Y, class V>
  void put(Y& y, V const& v) const {
    auto& entries = slant::local(y);
    for (slant::index j = 0; j < size(); ++j) entries.coeffRef(component(j)) = v.coeff(j);
  }

  /// The place in the whole vector of something at `inner` within this block.
  template <int M, class L>
  [[nodiscard]] constexpr auto then(place<M, L> const& inner) const {
    constexpr bool both = !strided && std::is_same_v<L, consecutive>;
    return place<M, std::conditional_t<both, consecutive, planar>>(
        number_ + inner.index(), component(inner.component(0)), inner.size(),
        component(inner.component(1)) - component(inner.component(0)));
  }

 private:
  slant::index number_;
  slant::index first_;
  slant::index size_;
  slant::index stride_;
};

/// The place of factor i of a power of m factors with N components and `inner` blocks each.
template <int N, class Layout>
[[nodiscard]] constexpr auto block_place(index i, index m, index inner = 1) {
  if constexpr (std::is_same_v<Layout, planar>) {
    return place<N, planar>(i * inner, i, N, m);
  } else {
    return place<N, consecutive>(i * inner, i * N, N);
  }
}

// --- blocks --------------------------------------------------------------------------------------

namespace detail {

template <class C>
struct set_scalar {
  using type = double;
};
template <class C>
  requires requires { typename C::scalar; }
struct set_scalar<C> {
  using type = typename C::scalar;
};

/// Base class with the static dimension N, or with nothing.
template <int N>
struct static_size {
  static constexpr int dimension = N;
};
template <>
struct static_size<Eigen::Dynamic> {};

}  // namespace detail

/// The scalar a set names, double if it names none.
template <class C>
using set_scalar_t = typename detail::set_scalar<std::remove_cvref_t<C>>::type;

/// Dimension of a set as far as its type tells, else Eigen::Dynamic.
template <class C>
inline constexpr int static_dimension_of = Eigen::Dynamic;
template <class C>
  requires has_static_dimension<std::remove_cvref_t<C>>
inline constexpr int static_dimension_of<C> = std::remove_cvref_t<C>::dimension;

/// Points of a set as Eigen objects.
template <class C>
using point_t = Eigen::Matrix<set_scalar_t<C>, static_dimension_of<C>, 1>;

/// A set that can be a part of a product.
template <class C> concept set_part = convex_set<C, point_t<C>>;

/// A set of fixed dimension: a block of a power.
template <class C> concept set_block = has_static_dimension<C> && set_part<C>;

/// A block without any constraint, which says so: `static constexpr bool whole_space = true`. Its
/// products do nothing with it, not even look at it.
template <class C> concept whole_space = requires { requires C::whole_space; };

/// A block of one point, which says so: `static constexpr bool single_point = true`. It has no
/// interior; methods that need one keep its components where they are.
template <class C> concept single_point = requires { requires C::single_point; };

namespace detail {

struct block_count_fn {
  template <class C>
  [[nodiscard]] constexpr index operator()(C const& c) const {
    if constexpr (requires { c.block_count(); }) {
      return c.block_count();
    } else {
      return 1;
    }
  }
};

struct visit_blocks_fn {
  template <class C, class F>
  constexpr void operator()(C const& c, F&& f) const {
    if constexpr (has_visit<C>) {
      c.visit(f);
    } else {
      f(c, place<static_dimension_of<C>>(0, 0, slant::dimension_of(c)));
    }
  }
};

struct visit_block_fn {
  template <class C, class F>
  constexpr void operator()(C const& c, [[maybe_unused]] index k, F&& f) const {
    if constexpr (has_visit_block<C>) {
      c.visit_block(k, f);
    } else {
      static_assert(!has_visit<C>, "this product of sets has no visit_block(k, f)");
      f(c, place<static_dimension_of<C>>(0, 0, slant::dimension_of(c)));
    }
  }
};

/// How a set or function made of parts keeps one passed as T&&: blocks are small and copied,
/// everything else follows the rule of base/held.hpp.
template <class T>
using kept_part_t = std::conditional_t<has_static_dimension<std::remove_cvref_t<T>>,
                                       std::remove_cvref_t<T>, kept_t<T>>;

/// The argument a part gets for its components of x: a copy for a block, a view for a product.
template <class C, class P, class X>
[[nodiscard]] auto argument_of(C const&, P const& p, X const& x) {
  if constexpr (has_static_dimension<C>) {
    return p.value(x);
  } else {
    return p.in(x);
  }
}

/// Projects the components of x at p into those of y, which may be the same.
template <class C, class P, class X, class Y>
void project_part(C const& part, P const& p, X const& x, Y& y) {
  if constexpr (has_static_dimension<C>) {
    p.put(y, slant::project(part, p.value(x)));
  } else {
    auto const xs = p.in(x);
    auto ys = p.in(y);
    slant::project(part, xs, ys);
  }
}

template <class X>
inline constexpr bool has_memory = bool(X::Flags & Eigen::DirectAccessBit);

/// The two are one and the same piece of memory.
template <class X, class Y>
[[nodiscard]] bool same_memory(X const& x, Y const& y) {
  if constexpr (has_memory<X> && has_memory<Y>) {
    return x.data() == y.data() && x.innerStride() == y.innerStride();
  } else {
    return false;
  }
}

/// The smallest of several steps, as they come in. NaN wins over everything.
template <class S>
class smallest_step {
 public:
  explicit smallest_step(S const& enough) : enough_(enough) {}

  /// Takes one more step into account; true if the rest need not be looked at.
  bool operator()(S const& step) {
    if (!(step >= best_)) best_ = step;
    return best_ < enough_ || !(best_ > S(0));
  }
  [[nodiscard]] S const& value() const { return best_; }

 private:
  S enough_;
  S best_ = std::numeric_limits<S>::infinity();
};

/// step_to_boundary of a part, with the early exit if it has one.
template <class C, class X, class D, class S>
[[nodiscard]] S step_of(C const& c, X const& x, D const& d, S const& enough) {
  if constexpr (requires { c.step_to_boundary(x, d, enough); }) {
    return c.step_to_boundary(x, d, enough);
  } else {
    return c.step_to_boundary(x, d);
  }
}

}  // namespace detail

/// Number of blocks of a set: 1 for a block, the sum over the parts for a product.
inline constexpr detail::block_count_fn block_count{};

/// f(block, place) for each block of a set; a set that is not a product is its own only block.
inline constexpr detail::visit_blocks_fn visit_blocks{};

/// f(block, place) for block k alone, 0 <= k < block_count; a step for each part of a product.
inline constexpr detail::visit_block_fn visit_block{};

}  // namespace slant

namespace slant::detail {

// --- inequality count ----------------------------------------------------------------------------

template <class... Parts>
inline constexpr bool all_smooth = (has_inequality_form<Parts, point_t<Parts>> && ...);

/// Base class with the member `inequalities` of a set made of Parts, if all of them have it.
template <class... Parts>
struct inequality_count {};
template <class... Parts>
  requires all_smooth<Parts...>
struct inequality_count<Parts...> {
  /// Number of smooth inequalities f_i(x) <= 0 that describe the set.
  static constexpr int inequalities = (Parts::inequalities + ...);
};

// --- block list ----------------------------------------------------------------------------------
//
// The blocks of a power: either one block and how often it occurs, or one block per set of
// parameters. Parameters are looked at once, here, and never again.

/// Anything with one entry per block; whatever is not such a list is one value for all blocks.
template <class P>
concept parameter_list = requires(P const& p) {
  { slant::local(p).size() } -> std::convertible_to<index>;
  slant::local(p)[0];
};

template <class P>
[[nodiscard]] decltype(auto) parameter_at(P const& p, index i) {
  if constexpr (requires { typename P::Scalar; }) {
    return p.coeff(i);
  } else if constexpr (parameter_list<P>) {
    auto const& entries = slant::local(p);
    return entries[static_cast<decltype(entries.size())>(i)];
  } else {
    return (p);
  }
}

/// The scalar of a list of numbers: entries of an Eigen or a standard vector.
template <class L>
using list_scalar_t = std::remove_cvref_t<decltype(parameter_at(std::declval<L const&>(), 0))>;

template <class Shape, class... Params>
concept takes_parameters = requires(Shape const& shape, Params const&... params) {
  { shape.with(parameter_at(params, 0)...) } -> std::convertible_to<Shape>;
};

/// A number of copies instead of parameters.
template <class... Params>
inline constexpr bool is_count = sizeof...(Params) == 1 && (std::integral<Params> && ...);

/// What power(shape, …) accepts after the shape.
template <class Shape, class... Params>
concept power_parameters =
    is_count<Params...> || (takes_parameters<Shape, Params...> && (parameter_list<Params> || ...));

/// The common length of the lists among the parameters.
template <class... Params>
[[nodiscard]] index parameter_count(Params const&... params) {
  index count = -1;
  int position = 0;
  auto const look = [&](auto const& p) {
    ++position;
    if constexpr (parameter_list<std::remove_cvref_t<decltype(p)>>) {
      auto const n = index(slant::local(p).size());
      if (count >= 0 && n != count) {
        throw bad_input("length of parameter list " + show(position), show(n),
                        show(count) + ", the length of the list before it");
      }
      count = n;
    }
  };
  (look(params), ...);
  return count;
}

template <class Shape, class... Params>
[[nodiscard]] Shape block_with(Shape const& shape, index i, Params const&... params) {
  try {
    return shape.with(parameter_at(params, i)...);
  } catch (bad_input const& e) {
    throw e.at(i);
  }
}

/// m equal blocks: no memory per block.
template <class Block>
class identical_blocks {
 public:
  identical_blocks(Block const& block, index count) : block_(block), count_(count) {
    if (count < 0) throw bad_input("number of blocks", show(count), "a number >= 0");
  }
  [[nodiscard]] index size() const { return count_; }
  [[nodiscard]] Block const& operator[](index) const { return block_; }
  /// What a loop should index: nothing that the loop writes can be part of it.
  [[nodiscard]] identical_blocks view() const { return *this; }

 private:
  Block block_;
  index count_;
};

/// One block per entry of the parameter lists.
template <class Block>
class listed_blocks {
 public:
  template <class... Params>
  explicit listed_blocks(Block const& shape, Params const&... params) : shape_(shape) {
    index const n = parameter_count(params...);
    blocks_.reserve(std::size_t(n));
    for (index i = 0; i < n; ++i) blocks_.push_back(block_with(shape_, i, params...));
  }

  /// New parameters, no allocation. If one of them is bad nothing changes.
  template <class... Params>
  void update(Params const&... params) {
    index const n = parameter_count(params...);
    if (n >= 0 && n != size()) {
      throw bad_input("number of parameters", show(n), show(size()) + ", the number of blocks");
    }
    for (index i = 0; i < size(); ++i) static_cast<void>(block_with(shape_, i, params...));
    for (index i = 0; i < size(); ++i) {
      blocks_[std::size_t(i)] = shape_.with(parameter_at(params, i)...);
    }
  }
  [[nodiscard]] index size() const { return index(blocks_.size()); }
  [[nodiscard]] Block const& operator[](index i) const { return blocks_[std::size_t(i)]; }
  [[nodiscard]] Block const* view() const { return blocks_.data(); }

 private:
  Block shape_;
  std::vector<Block> blocks_;
};

}  // namespace slant::detail
