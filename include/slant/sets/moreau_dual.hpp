// SPDX-License-Identifier: MIT
//
// The dual K* = {u : uᵀr >= 0 for all r ∈ K} of any closed convex cone K that can project, by
// Moreau's decomposition u = P_K*(u) − P_K(−u). For round friction cones there is dual_cone.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/elliptic_cone.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant {

/// K* of the block K, a closed convex cone.
///
/// P(u) = u + P_K(−u), with an error of some ε ‖u‖ (ε the machine epsilon): small components, as
/// near −K, have no more digits than the others leave them; P(u) of a u in K* is u. NaN in, NaN
/// out. It has no state, as no method for quadratic programs needs it.
template <set_block Cone>
class moreau_dual {
 public:
  using scalar = set_scalar_t<Cone>;
  static constexpr int dimension = Cone::dimension;
  using vector_type = Eigen::Matrix<scalar, dimension, 1>;
  using matrix_type = Eigen::Matrix<scalar, dimension, dimension>;

  moreau_dual() = default;
  explicit moreau_dual(Cone cone) : primal_(std::move(cone)) {}

  /// The dual of cone().with(params...).
  template <class... Params>
  [[nodiscard]] moreau_dual with(Params const&... params) const
    requires requires(Cone const& cone) { cone.with(params...); }
  {
    return moreau_dual(primal_.with(params...));
  }
  /// K.
  [[nodiscard]] Cone const& dual() const { return primal_; }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type const v = x;
    return v + primal_.project(vector_type(-v));
  }

  /// Membership: −x is in the polar cone of K up to its band or up to the rounding of project.
  [[nodiscard]] bool contains(auto const& x) const {
    vector_type const v = -x;
    if (primal_.support(v) == scalar(0)) return true;
    scalar const distance = primal_.project(v).template lpNorm<Eigen::Infinity>();
    return distance <= detail::rounding_band<scalar>() * v.template lpNorm<Eigen::Infinity>();
  }

  /// Slanting operator of the projection at x: I − G(−x), G that of K with its choice at kinks; at
  /// the apex I, the value from inside as for all sets.
  [[nodiscard]] matrix_type slant(auto const& x) const
    requires has_slant<Cone, vector_type>
  {
    vector_type const v = -x;
    if ((v.array() == scalar(0)).all()) return matrix_type::Identity();
    return matrix_type::Identity() - primal_.slant(v);
  }

  /// 0 for −y in K, otherwise ∞.
  [[nodiscard]] scalar support(auto const& y) const {
    vector_type const v = -y;
    if (detail::has_nan(v)) return detail::not_a_number<scalar>();
    return primal_.contains(v) ? scalar(0) : detail::infinity<scalar>();
  }

 private:
  Cone primal_{};
};

/// { u : ‖(μ₁u₁, μ₂u₂)‖ <= u_n }.
template <scalar S>
[[nodiscard]] moreau_dual<elliptic_cone<S>> dual(elliptic_cone<S> const& cone) {
  return moreau_dual<elliptic_cone<S>>(cone);
}
/// The dual of the dual is the cone itself.
template <class Cone>
[[nodiscard]] Cone dual(moreau_dual<Cone> const& cone) {
  return cone.dual();
}

}  // namespace slant
