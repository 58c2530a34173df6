// SPDX-License-Identifier: MIT
//
// Which constraints of  min ½xᵀA x − bᵀx,  x ∈ Λ₁ × … × Λ_m,  carry a multiplier at the solution.
//
// A block is active when z = x − ρ r lies strictly outside its set, where r = A x − b and ρ =
// 1/A_ii: when its multiplier, times ρ, exceeds its slack. At the solution one of the two numbers
// is zero, so this compares a rounding error with a quantity of the data; no threshold, no units.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <fem/require.hpp>

namespace fem {

/// For every block of the product set, in its order: is it active at x? Blocks without constraints
/// never are. A is symmetric with a positive diagonal, dense or sparse; the ρ of a block with
/// several components belongs to the mean of its diagonal entries. Throws std::invalid_argument for
/// sizes that do not fit.
template <class Set, class Matrix, class Vector>
[[nodiscard]] std::vector<bool> active_blocks(Set const& set, Matrix const& A, Vector const& b,
                                              Vector const& x) {
  require(x.size() == set.size(), "x", x.size(), "the dimension of the set");
  require(b.size() == x.size() && A.rows() == x.size() && A.cols() == x.size(), "A and b", A.rows(),
          "the sizes of the set");
  Vector const r = A * x - b;
  Vector const diagonal = A.diagonal();
  std::vector<bool> active;
  set.visit([&](auto const& block, auto const& place) {
    auto const ρ = 1 / place.value(diagonal).mean();
    auto const z = (place.value(x) - ρ * place.value(r)).eval();
    active.push_back(block.project(z) != z);
  });
  return active;
}

/// Active constraints of each kind.
struct active_counts {
  int bounds = 0;   ///< among the blocks of one component
  int circles = 0;  ///< among the blocks of two

  friend bool operator==(active_counts const&, active_counts const&) = default;
};

/// Counts the active blocks; requirements as above.
template <class Set, class Matrix, class Vector>
[[nodiscard]] active_counts count_active(Set const& set, Matrix const& A, Vector const& b,
                                         Vector const& x) {
  std::vector<bool> const active = active_blocks(set, A, b, x);
  active_counts counts;
  std::size_t i = 0;
  set.visit([&](auto const&, auto const& place) {
    if (active[i++]) ++(place.size() == 1 ? counts.bounds : counts.circles);
  });
  return counts;
}

}  // namespace fem
