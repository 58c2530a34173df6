// SPDX-License-Identifier: MIT
//
// Images of a block under x = T z, T a shift, a scaling or a rotation. Such T map nearest points to
// nearest points, so everything a block can do carries over.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/detail/inequality_count.hpp>
#include <slant/sets/detail/rounding_reach.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant {

namespace detail {

/// A block's few numbers are worked out, a long vector stays an expression: no temporary.
template <class E>
[[nodiscard]] auto settled(E const& e) {
  if constexpr (E::SizeAtCompileTime != Eigen::Dynamic) {
    return e.eval();
  } else {
    return e;
  }
}

}  // namespace detail

/// T(Part). Made by `shifted`, `scaled_set` and `rotated`. T has
///     pull(x) = T⁻¹x, pull_direction(d), push(z) = T z, push_direction(z),
///     offset(y) = yᵀT(0), push_adjoint(y): yᵀ(T z − T 0) = push_adjoint(y)ᵀz,
///     push_gradient(g), push_hessian(h), push_slant(g)    derivatives of f ∘ T⁻¹ and of T P T⁻¹
///     slop(x, z)    a bound on the rounding error of z = pull(x), sum of moduli
///     at(place)     the map of one block, if T acts on each component (separable)
template <set_block Part, class Map>
class image_block : public detail::inequality_count<Part> {
  static constexpr bool smooth = detail::all_smooth<Part>;
  /// The image of a product is the product of the images.
  static constexpr bool in_blocks = Map::separable && has_visit<Part>;

 public:
  using scalar = set_scalar_t<Part>;
  static constexpr int dimension = Part::dimension;
  static constexpr bool whole_space = slant::whole_space<Part>;
  static constexpr bool single_point = slant::single_point<Part>;
  static constexpr bool oblique = slant::oblique<Part>;
  using vector_type = Eigen::Matrix<scalar, dimension, 1>;
  using matrix_type = Eigen::Matrix<scalar, dimension, dimension>;

  image_block(Part part, Map map) : part_(std::move(part)), map_(std::move(map)) {}

  [[nodiscard]] Part const& part() const { return part_; }
  [[nodiscard]] Map const& map() const { return map_; }
  [[nodiscard]] static constexpr index size() { return dimension; }

  /// The image of part().with(params...) under the same map.
  template <class... Params>
  [[nodiscard]] image_block with(Params const&... params) const
    requires requires(Part const& p) { p.with(params...); }
  {
    return {part_.with(params...), map_};
  }

  /// T P(T⁻¹x).
  template <class X>
  [[nodiscard]] auto project(X const& x) const {
    return map_.push(slant::project(part_, map_.pull(x)));
  }

  /// Membership, up to the rounding of T⁻¹x.
  template <class X>
  [[nodiscard]] bool contains(X const& x) const {
    if constexpr (in_blocks) {
      return detail::blocks_contain(*this, x);
    } else {
      auto const z = map_.pull(x);
      return detail::contains_within(part_, z, map_.slop(x, z));
    }
  }

  /// State of x ∈ T(Part), up to the rounding of T⁻¹x.
  template <class X>
  [[nodiscard]] block_state state(X const& x) const
    requires has_state<Part, vector_type>
  {
    auto const z = map_.pull(x);
    return detail::state_within(part_, z, map_.slop(x, z));
  }

  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires has_slant<Part, vector_type>
  {
    return map_.push_slant(part_.slant(map_.pull(x)));
  }

  template <class X, class D>
  [[nodiscard]] auto step_to_boundary(X const& x, D const& d) const
    requires has_step_to_boundary<Part, vector_type>
  {
    return part_.step_to_boundary(map_.pull(x), map_.pull_direction(d));
  }

  template <class Y>
  [[nodiscard]] scalar_t<Y> support(Y const& y) const
    requires has_support<Part, vector_type>
  {
    return map_.offset(y) + part_.support(map_.push_adjoint(y));
  }

  template <class X>
  [[nodiscard]] auto inequality(X const& x) const
    requires smooth
  {
    return part_.inequality(map_.pull(x));
  }
  template <class X>
  [[nodiscard]] auto inequality_gradient(X const& x) const
    requires smooth
  {
    return map_.push_gradient(part_.inequality_gradient(map_.pull(x)));
  }
  template <class X, class M>
  [[nodiscard]] auto inequality_hessian(X const& x, M const& multipliers) const
    requires smooth
  {
    return map_.push_hessian(part_.inequality_hessian(map_.pull(x), multipliers));
  }

  template <class X>
  [[nodiscard]] auto lorentz_point(X const& x) const
    requires has_lorentz_form<Part, vector_type>
  {
    return part_.lorentz_point(map_.pull(x));
  }
  [[nodiscard]] auto lorentz_matrix() const
    requires has_lorentz_form<Part, vector_type>
  {
    return map_.push_gradient(part_.lorentz_matrix().transpose().eval()).transpose().eval();
  }

  [[nodiscard]] index block_count() const {
    return Map::separable ? slant::block_count(part_) : index{1};
  }
  /// f(block, place) for every innermost block, if T does not mix them.
  template <class F>
  void visit(F&& f) const
    requires in_blocks
  {
    part_.visit([&](auto const& b, auto const& p) {
      f(image_block<std::remove_cvref_t<decltype(b)>, decltype(map_.at(p))>(b, map_.at(p)), p);
    });
  }

 private:
  Part part_;
  Map map_;
};

}  // namespace slant
