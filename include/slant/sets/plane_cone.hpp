// SPDX-License-Identifier: MIT
//
// The friction cone of a plane problem, { (x_n, x_t) : |x_t| <= μ x_n }, as the polyhedron that it
// is: the same set as second_order_cone<2>, with linear inequalities in place of the quadratic one.
// An interior-point method has nothing to curve around then.
#pragma once

#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

namespace slant {

/// { x ∈ R² : |x_t| <= μ x_n }, μ >= 0 finite. All but the inequality form is that of
/// second_order_cone<2>.
template <scalar S = double>
class plane_cone : public second_order_cone<2, S> {
  using base = second_order_cone<2, S>;

 public:
  using typename base::matrix_type;
  using typename base::vector_type;

  plane_cone() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit plane_cone(S const& mu) : base(mu) {}

  [[nodiscard]] plane_cone with(S const& mu) const { return plane_cone(mu); }

  /// { diag(s) x : x in the set }; s > 0.
  [[nodiscard]] plane_cone stretched(vector_type const& s) const {
    return plane_cone(base::stretched(s).mu());
  }

  /// f(x) = (x_t − μ x_n, −x_t − μ x_n) <= 0, each within an ulp.
  [[nodiscard]] vector_type inequality(auto const& x) const {
    vector_type const v = x;
    detail::double_word<S> const bound = detail::exact_product<S>(this->mu(), v(0));
    detail::double_word<S> const slip(v(1));
    return {(slip - bound).hi, (-slip - bound).hi};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] matrix_type inequality_gradient(auto const&) const {
    matrix_type gradient;
    gradient << -this->mu(), -this->mu(), S(1), S(-1);
    return gradient;
  }

  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }

  /// It has flat sides, and f is linear.
  void lorentz_point(auto const& x) const = delete;
};

}  // namespace slant
