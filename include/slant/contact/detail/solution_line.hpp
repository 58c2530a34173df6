// SPDX-License-Identifier: MIT
//
// Where the next load step starts. λ_k, λ_{k−1} solve the last two steps, d = λ_k − λ_{k−1}; b is
// new. On the line through them
//
//     q(λ_k + τ d) = q(λ_k) + τ dᵀ(A λ_k − b) + ½ τ² dᵀA d
//
// has its minimum at τ = −dᵀ(A λ_k − b) / dᵀA d, and since A λ_k and A λ_{k−1} are known from the
// gradients there, finding it takes no product. That point is as good as the last solution (τ = 0)
// and as the extrapolated one (τ = 1), if blocks at their bounds do not make it leave Λ. Before the
// first solution stands 0: what is proportional to the load is found exactly.
//
// Measured on bricks (k = 8, twenty steps, three scenes): 41 to 70 products a step from here, 42 to
// 72 from τ = 1, 81 to 97 from the last solution. Rejected: the minimum over more directions (the
// last three solutions, or more), which is better for q and worse for the bounds: a tenth to a
// third more products.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

#include <utility>

namespace slant::contact::detail {

/// The last two solutions with their images by A.
template <class V>
class solution_line {
 public:
  using scalar = scalar_t<V>;

  /// For vectors of n entries; both solutions are 0.
  explicit solution_line(index n)
      : last_(V::Zero(n)), before_(V::Zero(n)), A_last_(V::Zero(n)), A_before_(V::Zero(n)) {}

  [[nodiscard]] V const& last() const { return last_; }

  /// A new solution x with its gradient r = A x − b, in multiples of unit.
  void record(V const& x, V const& r, scalar const& unit, V const& b) {
    std::swap(last_, before_);
    std::swap(A_last_, A_before_);
    last_ = x;
    A_last_ = unit * r + b;
  }

  /// The same without a gradient: there is no line then.
  void record(V const& x) { last_ = x; }

  /// q at the last solution for this b.
  [[nodiscard]] scalar energy(V const& b) const {
    return last_.dot(A_last_) / scalar(2) - last_.dot(b);
  }

  /// The point of least energy in x; false, and the last solution, where there is no line.
  bool minimum(V const& b, V& x) const {
    scalar const curvature = (last_ - before_).dot(A_last_ - A_before_);
    scalar const slope = (last_ - before_).dot(A_last_ - b);
    scalar const τ = -slope / curvature;
    bool const line = curvature > scalar(0) && slant::detail::is_finite(τ);
    x = last_;
    if (line) x += τ * (last_ - before_);
    return line;
  }

 private:
  V last_, before_, A_last_, A_before_;
};

}  // namespace slant::contact::detail
