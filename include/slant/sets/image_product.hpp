// SPDX-License-Identifier: MIT
//
// Images of a product (or any set whose dimension is known at run time) under a shift or a scaling.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/operators/held.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/detail/rounding_reach.hpp>
#include <slant/sets/image_block.hpp>
#include <slant/sets/projection_slant.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// T(Part) for a map T that acts on each component; see image_block for its members. A part that is
/// not a product of blocks allocates in contains(x) for x near its boundary.
template <class Part, class Map>
class image_product {
  using part_type = std::remove_cvref_t<Part>;
  using point = point_t<part_type>;

 public:
  using scalar = set_scalar_t<part_type>;

  image_product(held<Part> part, Map map) : part_(std::move(part)), map_(std::move(map)) {}

  [[nodiscard]] part_type const& part() const { return part_.get(); }
  [[nodiscard]] Map const& map() const { return map_; }
  [[nodiscard]] index size() const { return slant::dimension_of(part()); }
  [[nodiscard]] index block_count() const { return slant::block_count(part()); }

  /// y = P(x); y may be x.
  template <class X, class Y>
  void project(X const& x, Y&& y) const {
    auto to = slant::local(y).head(size());  // a view: y has its size and is not to be resized
    to = map_.pull(slant::local(x));
    slant::project(part(), to, to);
    to = map_.push(to);
  }

  /// Membership, up to the rounding of T⁻¹x.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    auto const& entries = slant::local(x);
    if (entries.size() != size()) return false;
    if constexpr (has_visit<part_type>) {
      return detail::blocks_contain(*this, entries);
    } else {
      typename std::remove_cvref_t<decltype(entries)>::PlainObject const z = map_.pull(entries);
      return detail::contains_within(part(), z, map_.slop(entries, z));
    }
  }

  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires has_slant<part_type, point>
  {
    return slant::projection_slant(part(), map_.pull(slant::local(x)));
  }
  template <class X, class G>
  void slant(X const& x, G& g) const
    requires has_slant<part_type, point>
  {
    slant::projection_slant(part(), map_.pull(slant::local(x)), g);
  }

  template <class X, class D, class S = scalar_t<X>>
  [[nodiscard]] S step_to_boundary(X const& x, D const& d,
                                   std::type_identity_t<S> const& enough = S(0)) const
    requires has_step_to_boundary<part_type, point>
  {
    return detail::step_of(part(), map_.pull(slant::local(x)), map_.pull_direction(slant::local(d)),
                           enough);
  }

  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const
    requires has_support<part_type, point>
  {
    return map_.offset(slant::local(y)) + part().support(map_.push_adjoint(slant::local(y)));
  }

  /// f(block, place) for every innermost block; a block of the image is the image of a block.
  template <class F>
  void visit(F&& f) const
    requires has_visit<part_type>
  {
    part().visit([&](auto const& b, auto const& p) {
      f(image_block<std::remove_cvref_t<decltype(b)>, decltype(map_.at(p))>(b, map_.at(p)), p);
    });
  }

 private:
  held<Part> part_;
  Map map_;
};

namespace detail {

/// T(set): an image_block of a block, an image_product of anything else.
template <class C, class Map>
[[nodiscard]] auto image_of(C&& set, Map map) {
  using part = std::remove_cvref_t<C>;
  if constexpr (has_static_dimension<part>) {
    return image_block<part, Map>(std::forward<C>(set), std::move(map));
  } else {
    return image_product<kept_t<C>, Map>(held<kept_t<C>>(std::forward<C>(set)), std::move(map));
  }
}

}  // namespace detail

}  // namespace slant
