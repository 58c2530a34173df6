// SPDX-License-Identifier: MIT
//
// A set of one point: components with a prescribed value.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <string>

namespace slant {

/// { p } ⊂ R^N, by default the origin.
///
/// The interior is empty, so there is no inequality form. Membership: ‖x − p‖ <= 8 ε ‖p‖, ε the
/// machine epsilon. The slanting operator is 0: the projection is constant. NaN in, NaN out.
template <int N = 1, scalar S = double>
  requires(N >= 1)
class point {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr bool single_point = true;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  point() = default;

  /// @throws bad_input if an entry of p is NaN or infinite.
  explicit point(vector_type const& p) : position_(p) {
    for (int i = 0; i < N; ++i) {
      if (!detail::is_finite<S>(p(i))) {
        throw bad_input("p(" + std::to_string(i) + ")", detail::show(p(i)), "a finite number");
      }
    }
  }

  [[nodiscard]] point with(vector_type const& p) const { return point(p); }
  [[nodiscard]] vector_type const& position() const { return position_; }

  [[nodiscard]] vector_type project(auto const& x) const {
    if (detail::has_nan(vector_type(x))) return vector_type::Constant(detail::not_a_number<S>());
    return position_;
  }

  /// Membership up to rounding.
  [[nodiscard]] bool contains(auto const& x) const {
    vector_type const difference = x - position_;
    auto const gap = detail::scaled_norm<S, N>(difference);
    auto const size = detail::scaled_norm<S, N>(position_);
    return detail::times_power_of_two<S>(gap.value, gap.exponent - size.exponent) <=
           detail::rounding_band<S>() * size.value;
  }

  [[nodiscard]] block_state state(auto const&) const { return block_state::fixed; }

  [[nodiscard]] matrix_type slant(auto const& x) const {
    return matrix_type::Constant(detail::has_nan(vector_type(x)) ? detail::not_a_number<S>()
                                                                 : S(0));
  }

  /// 0, and ∞ for d = 0.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const w = d;
    if (detail::has_nan(vector_type(x)) || detail::has_nan(w)) return detail::not_a_number<S>();
    return detail::all_zero(w) ? detail::infinity<S>() : S(0);
  }

  /// yᵀp.
  [[nodiscard]] S support(auto const& y) const { return vector_type(y).dot(position_); }

 private:
  vector_type position_ = vector_type::Zero();
};

}  // namespace slant
