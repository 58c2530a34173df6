// SPDX-License-Identifier: MIT
//
// The ball { x : ‖x‖ <= g }: the friction set of a node of a spatial problem is the disc ball<2>.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

#include <limits>

namespace slant {

/// { x ∈ R^N : ‖x‖ <= g }, g the radius.
///
/// Projection x min(1, g/‖x‖) [K (50)], every component within 4 ulp at any scale (components below
/// the smallest normal number excepted). Radius 0 and ∞ are legal.
/// "On the boundary" means | ‖x‖ − g | <= 8 ε g, ε the machine epsilon.
/// NaN in, NaN out; for N > 1 also for an infinite component, unless g = ∞.
template <int N, scalar S = double>
  requires(N >= 1)
class ball {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr int inequalities = 1;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  ball() = default;

  /// @throws bad_input if radius is NaN or negative.
  explicit ball(S const& radius) : radius_(radius) {
    if (!(radius >= S(0))) throw bad_input("radius", detail::show(radius), "a number >= 0");
  }

  [[nodiscard]] ball with(S const& radius) const { return ball(radius); }
  [[nodiscard]] S const& radius() const { return radius_; }

  /// Nearest point of the set. (Inlined: a call costs half as much as the rest.)
  [[nodiscard, gnu::always_inline]] vector_type project(auto const& x) const {
    vector_type const v = x;
    auto const length = detail::scaled_norm<S, N>(v);
    S const g = detail::times_power_of_two<S>(radius_, -length.exponent);
    if (length.value <= g) return v;
    if constexpr (N == 1) {
      if (!detail::any_nan(v(0))) return vector_type::Constant(v(0) < S(0) ? S(-radius_) : radius_);
    }
    S const factor = g / length.value;
    S const smallest = (std::numeric_limits<S>::min)();
    if (factor < smallest || g < smallest) return far_projection(v, length);
    return detail::multiple_of(factor, v);
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    auto const length = detail::scaled_norm<S, N>(x);
    // One unit of the smallest numbers per component: there rounding is no longer relative.
    S const g = radius_ + S(N) * std::numeric_limits<S>::denorm_min();
    return length.value <=
           (S(1) + detail::rounding_band<S>()) * detail::times_power_of_two<S>(g, -length.exponent);
  }

  /// For x in the set: free inside, sliding on the sphere; fixed if there is nothing to slide along
  /// (N = 1 on the boundary, or radius 0).
  [[nodiscard]] block_state state(auto const& x) const {
    if (radius_ == S(0)) return block_state::fixed;
    auto const length = detail::scaled_norm<S, N>(x);
    S const g = detail::times_power_of_two<S>(radius_, -length.exponent);
    if (length.value < (S(1) - detail::rounding_band<S>()) * g) return block_state::free;
    return N == 1 ? block_state::fixed : block_state::sliding;
  }

  /// Slanting operator of the projection at x: I for ‖x‖ <= g, otherwise (g/‖x‖)(I − xxᵀ/‖x‖²)
  /// [K (50)]; 0 everywhere for radius 0, where the projection is constant.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    auto const length = detail::scaled_norm<S, N>(v);
    S const g = detail::times_power_of_two<S>(radius_, -length.exponent);
    matrix_type result;
    if (length.value <= g) {
      result.setZero();
      if (radius_ > S(0)) result.setIdentity();
      return result;
    }
    if (N == 1 && !detail::has_nan(v)) return matrix_type::Zero();
    vector_type const e = direction(v, length);
    if (detail::has_nan(e)) return matrix_type::Constant(detail::not_a_number<S>());
    S const factor = g / length.value;
    for (int i = 0; i < N; ++i) {
      // 1 − eᵢ² as a sum of squares: no cancellation, and the result stays semidefinite.
      S others(0);
      for (int j = 0; j < N; ++j) {
        if (j == i) continue;
        others += e(j) * e(j);
        result(i, j) = -factor * (e(i) * e(j));
      }
      result(i, i) = factor * others;
    }
    return result;
  }

  /// sup{α >= 0 : ‖x + α d‖ <= g} for x in the set; x outside by rounding counts as on the sphere.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const v = x;
    vector_type const w = d;
    if (detail::has_nan(v) || detail::has_nan(w)) return detail::not_a_number<S>();
    if (detail::all_zero(w) || !detail::is_finite(radius_)) return detail::infinity<S>();
    if (radius_ == S(0)) return S(0);
    int const e = detail::binary_exponent(radius_);
    int const f = detail::binary_exponent(w);
    vector_type const vs = detail::times_power_of_two<S, N>(v, -e);
    vector_type const ws = detail::times_power_of_two<S, N>(w, -f);
    S const gs = detail::times_power_of_two<S>(radius_, -e);
    S const step =
        detail::exit_root<S>(detail::precise_dot<S>(ws, ws), detail::precise_dot<S>(vs, ws),
                             detail::exact_product(gs, gs) - detail::precise_dot<S>(vs, vs));
    return detail::times_power_of_two<S>(step, e - f);
  }

  /// g ‖y‖, with 0 · ∞ = 0.
  [[nodiscard]] S support(auto const& y) const {
    auto const length = detail::scaled_norm<S, N>(y);
    if (length.value == S(0) || radius_ == S(0))
      return detail::any_nan(length.value) ? length.value : S(0);
    if (!detail::is_finite(radius_)) return detail::any_nan(length.value) ? length.value : radius_;
    int const k = detail::binary_exponent(radius_);
    return detail::times_power_of_two<S>(length.value * detail::times_power_of_two<S>(radius_, -k),
                                         length.exponent + k);
  }

  /// f(x) = ‖x‖² − g² <= 0, in units of x²; accurate to the last digits also near the sphere.
  [[nodiscard]] Eigen::Matrix<S, 1, 1> inequality(auto const& x) const {
    vector_type const v = x;
    S const square = radius_ * radius_;
    S const f = detail::is_finite(square)
                    ? (detail::precise_dot<S>(v, v) - detail::exact_product(radius_, radius_)).hi
                : detail::has_nan(v) ? detail::not_a_number<S>()
                : contains(v)        ? S(-detail::infinity<S>())
                                     : detail::infinity<S>();
    return Eigen::Matrix<S, 1, 1>::Constant(f);
  }

  [[nodiscard]] vector_type inequality_gradient(auto const& x) const {
    vector_type const v = x;
    return detail::multiple_of(S(2), v);
  }

  /// ν₁ ∇²f = 2 ν₁ I.
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    matrix_type hessian = matrix_type::Zero();
    for (int i = 0; i < N; ++i) hessian(i, i) = S(2) * multipliers(0);
    return hessian;
  }

  /// (g, x) ∈ L.
  [[nodiscard]] Eigen::Matrix<S, N + 1, 1> lorentz_point(auto const& x) const {
    vector_type const v = x;
    return detail::from_entries<Eigen::Matrix<S, N + 1, 1>>(
        [&](int i) -> S { return i == 0 ? radius_ : v.data()[i - 1]; });
  }
  [[nodiscard]] Eigen::Matrix<S, N + 1, N> lorentz_matrix() const {
    return detail::from_entries<Eigen::Matrix<S, N + 1, N>>(
        [](int i, int j) { return S(i == j + 1 ? 1 : 0); });
  }

 private:
  /// g x/‖x‖ where g/‖x‖ would underflow.
  [[nodiscard]] vector_type far_projection(vector_type const& v,
                                           detail::scaled_number<S> const& length) const {
    if (!detail::is_finite(length.value)) return vector_type::Constant(detail::not_a_number<S>());
    return detail::multiple_of(radius_, direction(v, length));
  }
  /// x/‖x‖.
  [[nodiscard]] static vector_type direction(vector_type const& v,
                                             detail::scaled_number<S> const& length) {
    vector_type e;
    for (int i = 0; i < N; ++i) {
      e(i) = detail::times_power_of_two<S>(v(i), -length.exponent) / length.value;
    }
    return e;
  }

  S radius_{1};
};

/// The disc of radius g.
template <scalar S = double>
using disc = ball<2, S>;

}  // namespace slant
