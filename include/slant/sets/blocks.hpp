// SPDX-License-Identifier: MIT
//
// What every product of sets does with its parts, whether a part is a block of fixed dimension
// (which takes and returns its few numbers by value) or itself a product (which works in place).
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/place.hpp>

#include <Eigen/Core>

#include <limits>
#include <type_traits>

namespace slant {

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

template <class C>
[[nodiscard]] consteval int static_dimension() {
  if constexpr (has_static_dimension<C>) {
    return C::dimension;
  } else {
    return Eigen::Dynamic;
  }
}

}  // namespace detail

/// The scalar a set names, double if it names none.
template <class C>
using set_scalar_t = typename detail::set_scalar<std::remove_cvref_t<C>>::type;

/// Dimension of a set as far as its type tells, else Eigen::Dynamic.
template <class C>
inline constexpr int static_dimension_of = detail::static_dimension<std::remove_cvref_t<C>>();

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

/// A block whose projection is nearest in a norm of its own, which says so: `static constexpr bool
/// oblique = true`. Its slanting operator is not symmetric (in_metric.hpp), and so that no method
/// takes it for an ordinary set it has no state.
template <class C> concept oblique = requires { requires C::oblique; };

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

}  // namespace slant
