// SPDX-License-Identifier: MIT
//
// The whole space: components without any constraint, such as the pressures of a Stokes problem.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

namespace slant {

/// R^N. Projection and slanting operator are the identity; there is no inequality. NaN in, NaN out.
template <int N = 1, scalar S = double>
  requires(N >= 1)
class free_space {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr int inequalities = 0;
  static constexpr bool whole_space = true;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  [[nodiscard]] free_space with() const { return {}; }

  [[nodiscard]] vector_type project(auto const& x) const { return x; }

  /// True unless x holds a NaN.
  [[nodiscard]] bool contains(auto const& x) const { return !detail::has_nan(vector_type(x)); }

  [[nodiscard]] block_state state(auto const&) const { return block_state::free; }

  [[nodiscard]] matrix_type slant(auto const& x) const {
    if (detail::has_nan(vector_type(x))) return matrix_type::Constant(detail::not_a_number<S>());
    return matrix_type::Identity();
  }

  /// ∞: no step leaves the space.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    bool const nan = detail::has_nan(vector_type(x)) || detail::has_nan(vector_type(d));
    return nan ? detail::not_a_number<S>() : detail::infinity<S>();
  }

  /// 0 for y = 0, otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    if (detail::has_nan(v)) return detail::not_a_number<S>();
    return detail::all_zero(v) ? S(0) : detail::infinity<S>();
  }

  [[nodiscard]] Eigen::Matrix<S, 0, 1> inequality(auto const&) const { return {}; }
  [[nodiscard]] Eigen::Matrix<S, N, 0> inequality_gradient(auto const&) const { return {}; }
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const&) const {
    return matrix_type::Zero();
  }
};

}  // namespace slant
