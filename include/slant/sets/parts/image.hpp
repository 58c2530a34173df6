// SPDX-License-Identifier: MIT
//
// Images of a set under x = T z, T a shift, a scaling or a rotation. Such T map nearest points to
// nearest points, so everything a set can do carries over.
#pragma once

#include <slant/base/held.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/slants.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace slant {
template <class Part, class Map>
class image_set;
}

namespace slant::detail {

// --- rounding reach ------------------------------------------------------------------------------
//
// Membership and state of a point that is only known up to rounding, as when z = x − c has lost the
// last digits of x and c: the bands of the set itself do not know about that.

/// Some point within the distance δ of z (sum of moduli) lies in the set, as far as the projection
/// tells.
template <class C, class Z, class S>
[[nodiscard]] bool contains_within(C const& set, Z const& z, S const& δ) {
  if (set.contains(z)) return true;
  if (!is_finite(δ)) return false;
  auto nearest = slant::project(set, z);
  slant::local(nearest) -= z;
  return S(slant::local(nearest).template lpNorm<1>()) <= δ;
}

/// The most confined state of a point within the distance δ of z: z itself and z ± δ e_j are looked
/// at, the latter moved into the set.
template <class C, class Z, class S>
[[nodiscard]] block_state state_within(C const& set, Z const& z, S const& δ) {
  block_state most = set.state(z);
  if (!(δ > S(0)) || !is_finite(δ)) return most;
  auto probe = z;
  for (index j = 0; j < index(z.size()); ++j) {
    for (S const& side : {S(δ), S(-δ)}) {
      probe.coeffRef(j) = z.coeff(j) + side;
      most = std::max(most, set.state(slant::project(set, probe)));
    }
    probe.coeffRef(j) = z.coeff(j);
  }
  return most;
}

// --- image ---------------------------------------------------------------------------------------

/// A block's few numbers are worked out, a long vector stays an expression: no temporary.
template <class E>
[[nodiscard]] auto settled(E const& e) {
  if constexpr (E::SizeAtCompileTime != Eigen::Dynamic) {
    return e.eval();
  } else {
    return e;
  }
}

/// Calls f for the images of blocks under the map T.
template <class Map, class F>
[[nodiscard]] auto of_image(Map const& map, F& f) {
  return [&](auto const& b, auto const& p) {
    f(image_set<std::remove_cvref_t<decltype(b)>, decltype(map.at(p))>(b, map.at(p)), p);
  };
}

}  // namespace slant::detail

namespace slant {

/// T(Part) of a block, or of a product or any set whose dimension is known at run time; these under
/// a T that acts on each component. Made by `shifted`, `scaled` and `rotated`. T has
///     pull(x) = T⁻¹x, pull_direction(d), push(z) = T z,
///     offset(y) = yᵀT(0), push_adjoint(y): yᵀ(T z − T 0) = push_adjoint(y)ᵀz,
///     push_gradient(g), push_hessian(h), push_slant(g)    derivatives of f ∘ T⁻¹ and of T P T⁻¹
///     slop(x, z)    a bound on the rounding error of z = pull(x), sum of moduli
///     at(place)     the map of one block, if T acts on each component (separable)
/// A part of dynamic size that is not a product allocates in contains(x) for x near its boundary.
template <class Part, class Map>
class image_set : public detail::static_size<static_dimension_of<Part>>,
                  public detail::inequality_count<std::remove_cvref_t<Part>> {
  using part_type = std::remove_cvref_t<Part>;
  using point = point_t<part_type>;
  static constexpr bool is_block = has_static_dimension<part_type>;
  static constexpr bool smooth = detail::all_smooth<part_type>;
  /// The image of a product is the product of the images.
  static constexpr bool in_blocks = Map::separable && has_visit<part_type>;

 public:
  using scalar = set_scalar_t<part_type>;
  static constexpr bool whole_space = slant::whole_space<part_type>;
  static constexpr bool single_point = slant::single_point<part_type>;

  image_set(held<Part> part, Map map) : part_(std::move(part)), map_(std::move(map)) {}

  [[nodiscard]] part_type const& part() const { return part_.get(); }
  [[nodiscard]] Map const& map() const { return map_; }
  [[nodiscard]] index size() const { return slant::dimension_of(part()); }

  /// The image of part().with(params...) under the same map.
  template <class... Params>
  [[nodiscard]] image_set with(Params const&... params) const
    requires(is_block && requires(part_type const& p) { p.with(params...); })
  {
    return {held<Part>(part().with(params...)), map_};
  }

  /// T P(T⁻¹x) of a block; x itself where P leaves T⁻¹x, whatever rounding makes of T T⁻¹x.
  template <class X>
    requires is_block
  [[nodiscard]] auto project(X const& x) const {
    using vector = Eigen::Matrix<scalar_t<X>, static_dimension_of<Part>, 1>;
    vector const from = map_.pull(x), to = slant::project(part(), from);
    return to == from ? vector(x) : vector(map_.push(to));
  }
  /// y = T P(T⁻¹x), block by block where there are blocks; y may be x.
  template <class X, class Y>
    requires(!is_block)
  void project(X const& x, Y&& y) const {
    if constexpr (in_blocks) {
      visit([&](auto const& block, auto const& p) {
        detail::project_part(block, p, slant::local(x), slant::local(y));
      });
      return;
    }
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
    if constexpr (in_blocks) {
      // The bound on the rounding error of a block knows its own components only: a large one
      // elsewhere excuses nothing here.
      bool inside = true;
      visit([&](auto const& block, auto const& p) {
        inside = inside && block.contains(detail::argument_of(block, p, entries));
      });
      return inside;
    } else {
      auto const z = map_.pull(entries).eval();
      return detail::contains_within(part(), z, map_.slop(entries, z));
    }
  }

  /// State of x ∈ T(Part), up to the rounding of T⁻¹x.
  template <class X>
  [[nodiscard]] block_state state(X const& x) const
    requires(is_block && has_state<part_type, point>)
  {
    auto const z = map_.pull(x);
    return detail::state_within(part(), z, map_.slop(x, z));
  }

  template <class X>
  [[nodiscard]] auto slant(X const& x) const
    requires has_slant<part_type, point>
  {
    if constexpr (is_block) {
      return map_.push_slant(part().slant(map_.pull(x)));
    } else {
      return slant::projection_slant(part(), map_.pull(slant::local(x)));
    }
  }
  template <class X, class G>
  void slant(X const& x, G& g) const
    requires(!is_block && has_slant<part_type, point>)
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

  template <class X>
  [[nodiscard]] auto inequality(X const& x) const
    requires(is_block && smooth)
  {
    return part().inequality(map_.pull(x));
  }
  template <class X>
  [[nodiscard]] auto inequality_gradient(X const& x) const
    requires(is_block && smooth)
  {
    return map_.push_gradient(part().inequality_gradient(map_.pull(x)));
  }
  template <class X, class M>
  [[nodiscard]] auto inequality_hessian(X const& x, M const& multipliers) const
    requires(is_block && smooth)
  {
    return map_.push_hessian(part().inequality_hessian(map_.pull(x), multipliers));
  }

  template <class X>
  [[nodiscard]] auto lorentz_point(X const& x) const
    requires(is_block && has_lorentz_form<part_type, point>)
  {
    return part().lorentz_point(map_.pull(x));
  }
  [[nodiscard]] auto lorentz_matrix() const
    requires(is_block && has_lorentz_form<part_type, point>)
  {
    return map_.push_gradient(part().lorentz_matrix().transpose().eval()).transpose().eval();
  }

  [[nodiscard]] index block_count() const {
    return Map::separable ? slant::block_count(part()) : index{1};
  }
  /// f(block, place) for every innermost block, if T does not mix them.
  template <class F>
  void visit(F&& f) const
    requires in_blocks
  {
    part().visit(detail::of_image(map_, f));
  }
  /// f(block, place) for innermost block k.
  template <class F>
  void visit_block(index k, F&& f) const
    requires in_blocks && has_visit_block<part_type>
  {
    part().visit_block(k, detail::of_image(map_, f));
  }

 private:
  held<Part> part_;
  Map map_;
};

namespace detail {

/// T(set). Blocks are copied.
template <class C, class Map>
[[nodiscard]] auto image_of(C&& set, Map map) {
  return image_set<kept_part_t<C>, Map>(held<kept_part_t<C>>(std::forward<C>(set)), std::move(map));
}

}  // namespace detail

}  // namespace slant
