// SPDX-License-Identifier: MIT
//
// Projection in a norm of one's own: the nearest point of a block measured by (xᵀD x)^½,
// D = diag(d),
//
//     P(x) = argmin { (z − x)ᵀD(z − x) : z ∈ Λ } = D^(−½) P'(D^½ x),
//
// P' the Euclidean projection onto the stretched set D^½Λ. It is closed where stretching along the
// axes stays in the family: a friction cone becomes one with another coefficient, an ellipse
// another ellipse. Projected gradients that are scaled by the diagonal of a Delassus operator,
// r − P(r − D⁻¹û), need it: the stiffness of a contact is not the same along n and t.
//
// The slanting operator D^(−½) G' D^½ is D-symmetric, D G = (D G)ᵀ with 0 ⪯ D G ⪯ D, and
// no symmetric operator unless D is constant. So projections in a metric declare no laws, and as
// blocks they have no state: a method for quadratic programs, which counts on the Euclidean
// projection, does not take them.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaled_norm.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/power.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string>

namespace slant {

/// A block whose images { diag(s) z : z ∈ Λ }, s > 0, are blocks of its family: stretched(s), which
/// may refuse some s by bad_input.
template <class C>
concept stretchable =
    set_block<C> && has_slant<C, point_t<C>> && requires(C const& c, point_t<C> const& s) {
      { c.stretched(s) } -> set_block;
      { c.stretched(s) } -> has_slant<point_t<C>>;
    };

/// Λ with the projection in the norm of diag(d); made by `in_metric`.
template <stretchable Block>
class in_metric_block {
  /// The units of the points do not matter to a cone.
  static constexpr bool is_cone = requires { requires Block::is_cone; };
  using stretched_type =
      decltype(std::declval<Block const&>().stretched(std::declval<point_t<Block> const&>()));

 public:
  using scalar = set_scalar_t<Block>;
  static constexpr int dimension = Block::dimension;
  static constexpr bool oblique = true;
  using vector_type = Eigen::Matrix<scalar, dimension, 1>;
  using matrix_type = Eigen::Matrix<scalar, dimension, dimension>;

  /// The Euclidean norm.
  in_metric_block() : in_metric_block(Block{}, vector_type::Ones()) {}

  /// @throws bad_input if an entry of d is not a finite number > 0, or if the block cannot be
  /// stretched so.
  in_metric_block(Block const& set, vector_type const& d)
      : set_(set), roots_(roots(d)), stretched_(set.stretched(roots_)) {}

  [[nodiscard]] in_metric_block with(Block const& set, vector_type const& d) const {
    return in_metric_block(set, d);
  }

  /// Λ.
  [[nodiscard]] Block const& set() const { return set_; }

  /// Nearest point of the set in the norm of d.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    int const e = unit_of(v);
    vector_type const z = stretched_point(v, e);
    vector_type const p = stretched_.project(z);
    for (int i = 0; i < dimension; ++i) {
      bool const vanished = z(i) == scalar(0) && v(i) != scalar(0);
      if (p(i) == z(i) && !vanished) continue;  // what stays is not rounded
      v(i) = detail::times_power_of_two<scalar>(p(i) / roots_(i), e);
    }
    return v;
  }

  /// Membership up to the band of the set.
  [[nodiscard]] bool contains(auto const& x) const { return set_.contains(x); }

  /// Slanting operator of the projection, D-symmetric; the choice at kinks is that of the set.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    matrix_type const g = stretched_.slant(stretched_point(v, unit_of(v)));
    return roots_.cwiseInverse().asDiagonal() * g * roots_.asDiagonal();
  }

 private:
  /// Points of cones are taken in units of themselves, 2^e: their products with √d are numbers
  /// then.
  [[nodiscard]] static int unit_of(vector_type const& x) {
    return is_cone && detail::all_finite(x) ? detail::binary_exponent(x) : 0;
  }
  [[nodiscard]] vector_type stretched_point(vector_type const& x, int e) const {
    return roots_.cwiseProduct(detail::times_power_of_two<scalar, dimension>(x, -e));
  }
  /// √d in units of a power of two: a common factor of d does not matter.
  [[nodiscard]] static vector_type roots(vector_type const& d) {
    using std::sqrt;
    vector_type s;
    for (int i = 0; i < dimension; ++i) {
      if (!(d(i) > scalar(0) && detail::is_finite(scalar(d(i))))) {
        throw bad_input("d(" + std::to_string(i) + ")", detail::show(scalar(d(i))),
                        "a finite number > 0");
      }
      s(i) = sqrt(d(i));
    }
    return detail::times_power_of_two<scalar, dimension>(s, -detail::binary_exponent(s));
  }

  Block set_;
  vector_type roots_;
  stretched_type stretched_;
};

/// A block with the projection in the norm (xᵀdiag(d) x)^½, d > 0:
/// in_metric(second_order_cone<3>{μ}, {d_n, d_t, d_t}).
/// @throws bad_input if d has another size or an entry that is not a finite number > 0, or if the
/// block cannot be stretched so (a cone needs the same d for all tangential components, an elliptic
/// one does not).
template <stretchable Block, class D = point_t<Block>>
[[nodiscard]] in_metric_block<Block> in_metric(Block const& set, D const& d) {
  detail::check_size("d", index(slant::local(d).size()), index(Block::dimension),
                     "the dimension of the set,");
  return in_metric_block<Block>(set, point_t<Block>(slant::local(d)));
}

/// A power of blocks in the norm of diag(d), d one number for each component.
/// @throws bad_input naming the block, as above, or if d has another size.
template <stretchable Block, class Layout, class Blocks, class D>
[[nodiscard]] auto in_metric(power_product<Block, Layout, Blocks> const& set, D const& d) {
  detail::check_size("d", index(slant::local(d).size()), set.size(), "the dimension of the set,");
  index const m = set.size() / Block::dimension;
  return detail::mapped_power(set, [&](Block const& block, index i) {
    try {
      return in_metric_block<Block>(
          block, block_place<Block::dimension, Layout>(i, m).value(slant::local(d)));
    } catch (bad_input const& e) {
      throw e.at(i);
    }
  });
}

}  // namespace slant
