// SPDX-License-Identifier: MIT
//
// Multipliers for a point that another method has found, so that SSNM can go on from there: [T
// Remark 4.2] "appropriately modifies" λ and μ without saying how. Here, block by block, from
//
//     r + Σ zᵢ ∇fᵢ(x) = 0,   zᵢ ≥ 0,   zᵢ = 0 in the interior;        r = A x − b
//
// zᵢ = max(0, −∇fᵢᵀr / ‖∇fᵢ‖²) for the blocks that x is not inside of, else 0: least squares for
// each inequality by itself. At the solution these are the multipliers (of blocks with one
// inequality, or of which one at a time can be active).
#pragma once

#include <slant/sets/blocks.hpp>
#include <slant/slanting/detail/inequality_layout.hpp>

#include <Eigen/Core>

namespace slant {

/// One multiplier per smooth inequality of the set, in its order; r is the gradient A x − b. z has
/// as many entries as the set has inequalities and is overwritten.
template <class Set, class V, class Z>
void estimated_multipliers(Set const& set, V const& x, V const& r, Z&& z) {
  using S = scalar_t<V>;
  auto&& multipliers = slant::local(z);
  index row = 0;
  slant::visit_blocks(set, [&](auto const& block, auto const& place) {
    using block_type = std::remove_cvref_t<decltype(block)>;
    constexpr int n = static_dimension_of<block_type>;
    constexpr int k = detail::inequalities_of<block_type>;
    if constexpr (k > 0) {
      Eigen::Matrix<S, n, 1> const point = place.value(x);
      Eigen::Matrix<S, n, 1> const force = place.value(r);
      Eigen::Matrix<S, n, k> const gradients = block.inequality_gradient(point);
      bool const inside = [&] {
        if constexpr (has_state<block_type, Eigen::Matrix<S, n, 1>>) {
          return block.state(point) == block_state::free;
        } else {
          return (block.inequality(point).array() < S(0)).all();
        }
      }();
      for (int i = 0; i < k; ++i) {
        S const slope = gradients.col(i).squaredNorm();
        S const push = -gradients.col(i).dot(force);
        multipliers[row++] = !inside && push > S(0) && slope > S(0) ? S(push / slope) : S(0);
      }
    }
  });
}

}  // namespace slant
