// SPDX-License-Identifier: MIT
//
// The half line { x : l <= x }: one bound, such as a contact pressure that cannot pull.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

namespace slant {

/// { x ∈ R : x >= l }.
///
/// Projection max(l, x), exact; slanting function 1 for x >= l, else 0 [K (49)]. l = −∞ is legal.
/// "On the bound" means within 8 ε |l|, ε the machine epsilon; a bound 0 has no band.
/// NaN in, NaN out.
template <scalar S = double>
class half_line {
 public:
  using scalar = S;
  static constexpr int dimension = 1;
  static constexpr int inequalities = 1;
  using vector_type = Eigen::Matrix<S, 1, 1>;
  using matrix_type = Eigen::Matrix<S, 1, 1>;

  half_line() = default;

  /// @throws bad_input if l is NaN or +∞.
  explicit half_line(S const& l) : lower_(l) {
    if (!(l < detail::infinity<S>())) {
      throw bad_input("l", detail::show(l), "a number less than infinity");
    }
  }

  [[nodiscard]] half_line with(S const& l) const { return half_line(l); }
  [[nodiscard]] S const& lower() const { return lower_; }

  /// Nearest point of the set.
  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    if (v(0) < lower_) v(0) = lower_;
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    return detail::at_least(vector_type(x)(0), lower_);
  }

  /// For x in the set: fixed on the bound, free above it.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    return v(0) <= lower_ || detail::at_bound(v(0), lower_) ? block_state::fixed
                                                            : block_state::free;
  }

  /// Slanting operator of the projection at x [K (49)].
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    if (detail::any_nan(v(0))) return v;
    return matrix_type::Constant(v(0) >= lower_ ? S(1) : S(0));
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x below l by rounding counts as l.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    return detail::step_to_bounds<S>(vector_type(x)(0), vector_type(d)(0), lower_,
                                     detail::infinity<S>());
  }

  /// sup of y z over z in the set: y l for y <= 0, otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    return v(0) > S(0) ? detail::infinity<S>() : detail::support_product(v(0), lower_);
  }

  /// f(x) = l − x <= 0.
  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality(auto const& x) const {
    return Eigen::Matrix<S, 1, 1>::Constant(lower_ - vector_type(x)(0));
  }

  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality_gradient(auto const&) const {
    return Eigen::Matrix<S, 1, 1>::Constant(S(-1));
  }

  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }

 private:
  S lower_{0};
};

}  // namespace slant
