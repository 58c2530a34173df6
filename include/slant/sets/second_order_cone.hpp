// SPDX-License-Identifier: MIT
//
// The second-order cone { (x_n, x_t) : ‖x_t‖ <= μ x_n }: normal pressure and Coulomb friction
// together.
#pragma once

#include <slant/base/double_word.hpp>
#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/sets/parts/bounds.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace slant::detail {

// --- cone projection -----------------------------------------------------------------------------
//
// Nearest point of the cone { (n, t) : ‖t‖ <= μ n }.
//
// With ρ = ‖t‖ the point is its own projection for ρ <= μ n, the apex is the projection for
// n + μρ <= 0 (the polar cone), and in between the mantle is met at
//
//     p_n = (n + μρ)/(1 + μ²),   p_t = (μ/ρ) (n + μρ)/(1 + μ²) t.
//
// For n < 0 the sum n + μρ cancels, and ρ is no number of the format: double words keep its
// digits, and where even they run out, just outside the polar cone, the sum is
// (μ²ρ² − n²)/(μρ − n) with a numerator that is a polynomial in the data and can be had to any
// precision. Each of n, ρ, μ is split into a number of order one and a power of two, so that
// neither tiny nor huge data nor any μ overflows.

enum class cone_region : unsigned char { inside, mantle, apex, undefined };

template <class S>
struct cone_foot {
  cone_region region;
  S normal;  ///< p_n
  S factor;  ///< factor · 2^exponent = p_t/t ∈ [0, 1]
  int exponent;

  /// Makes the point x its nearest one.
  template <int N>
  void move(Eigen::Matrix<S, N, 1>& x) const {
    if (region == cone_region::inside) return;
    S const product = times_power_of_two<S>(factor, exponent);
    bool const underflow = product < (std::numeric_limits<S>::min)();
    for (int i = 0; i < N; ++i) {
      S& entry = x.data()[i];
      if (region == cone_region::apex) entry = S(0);
      if (region == cone_region::undefined) entry = not_a_number<S>();
      if (region != cone_region::mantle) continue;
      entry = i == 0      ? normal
              : underflow ? times_power_of_two<S>(factor * entry, exponent)
                          : S(entry * product);
    }
  }
};

/// mantissa · 2^exponent; 0 has the smallest exponent of all.
template <class S>
struct split_number {
  S mantissa;
  int exponent;

  explicit split_number(S const& v)
      : mantissa(times_power_of_two<S>(v, -binary_exponent(v))),
        exponent(v == S(0) ? std::numeric_limits<int>::min() / 8 : binary_exponent(v)) {}
};

/// Nearest point of { ‖t‖ <= μ n } to x = (n, t). The region is undefined for an x that holds a NaN
/// or an infinity.
template <class S, int N>
[[nodiscard]] cone_foot<S> nearest_on_cone(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  using word = double_word<S>;
  if (!all_finite(x)) return {cone_region::undefined, S(0), S(0), 0};
  S const n = x(0);
  Eigen::Matrix<S, N - 1, 1> t = tail_of(x);
  if (all_zero(t)) {
    return {n >= S(0) ? cone_region::inside : cone_region::apex, S(0), S(0), 0};
  }
  int const t_unit = binary_exponent(t);
  t = times_power_of_two<S, N - 1>(t, -t_unit);
  auto const ρ = square_root(precise_dot<S>(t, t));
  split_number<S> const m(μ), ns(n);
  auto const larger = [](int a, int b) { return a < b ? b : a; };

  if (n >= S(0)) {  // ρ <= μ n ?
    int const unit = larger(m.exponent + ns.exponent, t_unit);
    auto const bound = exact_product(m.mantissa, ns.mantissa);
    if ((times_power_of_two(ρ, t_unit - unit) -
         times_power_of_two(bound, m.exponent + ns.exponent - unit))
            .hi <= S(0)) {
      return {cone_region::inside, S(0), S(0), 0};
    }
  }
  int const unit = larger(ns.exponent, m.exponent + t_unit);
  S const axis = times_power_of_two<S>(ns.mantissa, ns.exponent - unit);
  auto const μρ = times_power_of_two(word(m.mantissa) * ρ, m.exponent + t_unit - unit);
  auto sum = word(axis) + μρ;
  if (axis < S(0) && sum.hi < -axis / S(1024) && sum.hi > axis / S(1024)) {
    exact_squares<S, N> squares;
    for (int i = 0; i < N - 1; ++i) {
      squares.add(m.mantissa, times_power_of_two<S>(t(i), m.exponent + t_unit - unit));
    }
    squares.subtract(S(1), axis);
    sum = squares.sum() / (μρ - word(axis));
  }
  if (sum.hi <= S(0)) return {cone_region::apex, S(0), S(0), 0};
  // 1 + μ², for μ > 1 in units of 2^2m.
  int const s_unit = 2 * larger(0, m.exponent);
  auto const s =
      times_power_of_two(exact_product(m.mantissa, m.mantissa), 2 * m.exponent - s_unit) +
      times_power_of_two(word(S(1)), -s_unit);
  S const factor = (word(m.mantissa) * sum / (s * ρ)).hi;
  int const e = binary_exponent(factor);
  return {cone_region::mantle, times_power_of_two((sum / s).hi, unit - s_unit),
          times_power_of_two(factor, -e), e + m.exponent + unit - s_unit - t_unit};
}

// --- cone slant ----------------------------------------------------------------------------------

/// The derivative where x is projected onto the mantle, w wᵀ + θ (0 ⊕ (I − e eᵀ)) as
/// second_order_cone::slant has it, θ = ‖p_t‖/‖x_t‖ of the foot p.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> mantle_slant(S const& μ, cone_foot<S> const& foot,
                                                  Eigen::Matrix<S, N, 1> const& x) {
  using std::sqrt;
  Eigen::Matrix<S, N - 1, 1> e = tail_of(x);
  auto const ρ = scaled_norm<S, N - 1>(e);
  for (int i = 0; i < N - 1; ++i) e(i) = times_power_of_two<S>(e(i), -ρ.exponent) / ρ.value;
  S const θ = times_power_of_two<S>(foot.factor, foot.exponent);
  S const q = μ < S(1) ? μ : S(S(1) / μ);
  S const larger = S(1) / sqrt(S(1) + q * q), smaller = q * larger;
  Eigen::Matrix<S, N, 1> w;
  w(0) = μ < S(1) ? larger : smaller;
  for (int i = 1; i < N; ++i) w(i) = (μ < S(1) ? smaller : larger) * e(i - 1);
  Eigen::Matrix<S, N, N> G;
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < N; ++i) G(i, j) = w(i) * w(j);
  }
  for (int i = 0; i < N - 1; ++i) {
    for (int j = 0; j < N - 1; ++j) {
      if (j == i) continue;
      G(i + 1, i + 1) += θ * (e(j) * e(j));  // 1 − eᵢ² without cancellation
      G(i + 1, j + 1) -= θ * (e(i) * e(j));
    }
  }
  return G;
}

/// μ‖x_t‖ for x = (x_n, x_t), with its exponent apart: it may be no number of the format.
template <class S, int N>
[[nodiscard]] scaled_number<S> scaled_slip(S const& μ, Eigen::Matrix<S, N, 1> const& x) {
  auto const ρ = scaled_norm<S, N - 1>(tail_of(x));
  int const k = binary_exponent(μ);
  return {S(times_power_of_two(μ, -k) * ρ.value), k + ρ.exponent};
}

// --- cone step -----------------------------------------------------------------------------------

/// (μ n, t) in units of 2^exponent, the entries of order one at most; 0 keeps exponent 0.
template <class S, int N>
struct cone_coordinates {
  double_word<S> axis;
  Eigen::Matrix<S, N - 1, 1> t;
  int exponent = 0;

  cone_coordinates(S const& μ, Eigen::Matrix<S, N, 1> const& x) : t(tail_of(x)) {
    int const k = binary_exponent(μ);
    bool const has_axis = x(0) != S(0) && μ != S(0);
    int const n_exponent = binary_exponent<S>(x(0)) + k;
    int const t_exponent = binary_exponent(t);
    exponent = has_axis && (all_zero(t) || n_exponent > t_exponent) ? n_exponent : t_exponent;
    axis = has_axis ? double_word<S>(times_power_of_two(μ, -k)) *
                          double_word<S>(times_power_of_two<S>(x(0), k - exponent))
                    : double_word<S>(S(0));
    t = times_power_of_two<S, N - 1>(t, -exponent);
  }
};

/// sup{α >= 0 : x + α d in the cone} for x in the cone { ‖t‖ <= μ n } and d not in it.
///
/// The quadric ‖x_t + α d_t‖² = μ²(x_n + α d_n)² also holds the mirror cone, so the step ends at
/// x_n + α d_n = 0 at the latest. That bound decides when the ray runs down a generator, where all
/// coefficients of the quadratic vanish.
template <class S, int N>
[[nodiscard]] S cone_step(S const& μ, Eigen::Matrix<S, N, 1> const& x,
                          Eigen::Matrix<S, N, 1> const& d) {
  S const to_apex = d(0) < S(0) ? S(-(x(0) < S(0) ? S(0) : x(0)) / d(0)) : infinity<S>();
  cone_coordinates<S, N> const u(μ, x), v(μ, d);
  auto const A = precise_dot<S>(v.t, v.t) - v.axis * v.axis;
  auto const B = precise_dot<S>(u.t, v.t) - u.axis * v.axis;
  auto const C = u.axis * u.axis - precise_dot<S>(u.t, u.t);
  S const to_quadric = times_power_of_two<S>(exit_root<S>(A, B, C), u.exponent - v.exponent);
  return to_apex < to_quadric ? to_apex : to_quadric;
}

// --- algebra -------------------------------------------------------------------------------------

/// The Jordan algebra of the Lorentz cone L = { x : ‖x_t‖ <= x_0 } in M dimensions: e = (1, 0) is its
/// unit, L the squares in it.
template <int M, class S>
struct lorentz_algebra {
  using part = Eigen::Matrix<S, M, 1>;

  [[nodiscard]] static S tangential_length(part const& x) {
    using std::sqrt;
    return sqrt(pairwise_squares<M - 1>(x.data() + 1));
  }
  /// x_0² − ‖x_t‖².
  [[nodiscard]] static S determinant(part const& x) {
    S const t = tangential_length(x);
    return (x[0] - t) * (x[0] + t);
  }
  /// J x = (x_0, −x_t).
  [[nodiscard]] static part reflected(part const& x) {
    return from_entries<part>([&](int i) -> S { return i == 0 ? x[i] : S(-x[i]); });
  }
  /// x ∘ y = (xᵀy, x_0 y_t + y_0 x_t).
  [[nodiscard]] static part product(part const& x, part const& y) {
    part z = combination(x[0], y, y[0], x);
    z[0] = dot_of(x, y);
    return z;
  }
  /// y with x ∘ y = z.
  [[nodiscard]] static part quotient(part const& z, part const& x) {
    S const along = sum_of<M - 1>([&](int i) -> S { return x[i + 1] * z[i + 1]; });
    S const y0 = (x[0] * z[0] - along) / determinant(x);
    return from_entries<part>(
        [&](int i) -> S { return i == 0 ? y0 : S((z[i] - y0 * x[i]) / x[0]); });
  }
  /// xᵀy for x and y of determinant 1 in L, which is at least 1 and would cancel.
  [[nodiscard]] static S pairing(part const& x, part const& y) {
    S const u = tangential_length(x), v = tangential_length(y);
    S turned(0);
    if (u > S(0) && v > S(0)) {
      turned = sum_of<M - 1>([&](int i) -> S {
        S const sum = x[i + 1] / u + y[i + 1] / v;
        return sum * sum;
      });
    }
    return y[0] / (x[0] + u) + u / (y[0] + v) + u * v * turned / S(2);
  }
  /// 2 v vᵀ − J.
  [[nodiscard]] static Eigen::Matrix<S, M, M> hyperbolic(part const& v) {
    return from_entries<Eigen::Matrix<S, M, M>>([&](int i, int j) -> S {
      S const J = i != j ? S(0) : i == 0 ? S(1) : S(-1);
      return S(2) * v[i] * v[j] - J;
    });
  }
};

}  // namespace slant::detail

namespace slant {

// --- second order cone ---------------------------------------------------------------------------

/// { x ∈ R^N : ‖x_t‖ <= μ x_n }, x_n = x₀ the axis, x_t = (x₁, …); μ >= 0 is finite.
///
/// μ = 0 is the ray along the axis. Every component of the projection is within 4 ulp at any scale
/// and for any μ (components below the smallest normal number excepted); see
/// cone projection, above. "On the mantle" means | ‖x_t‖ − μ x_n | <= 8 ε μ x_n, ε the machine
/// epsilon. The apex is 0 only: a cone has no length with which "nearly 0" could be measured. NaN
/// in, NaN out; so does an infinite component.
template <int N, scalar S = double>
  requires(N >= 2)
class second_order_cone {
 public:
  using scalar = S;
  static constexpr int dimension = N;
  static constexpr int inequalities = 2;
  using vector_type = Eigen::Matrix<S, N, 1>;
  using matrix_type = Eigen::Matrix<S, N, N>;

  second_order_cone() = default;

  /// @throws bad_input if mu is NaN, negative or infinite.
  explicit second_order_cone(S const& mu) : mu_(mu) {
    detail::check_option("mu", mu, mu >= S(0) && detail::is_finite(mu), "a finite number >= 0");
  }

  [[nodiscard]] second_order_cone with(S const& mu) const { return second_order_cone(mu); }
  [[nodiscard]] S const& mu() const { return mu_; }

  [[nodiscard]] vector_type project(auto const& x) const {
    vector_type v = x;
    detail::nearest_on_cone<S, N>(mu_, v).move(v);
    return v;
  }

  /// Membership up to the band.
  [[nodiscard]] bool contains(auto const& x) const {
    return ratio_at_most(x, S(1) + detail::rounding_band<S>());
  }

  /// For x in the set: fixed at the apex, sliding on the mantle (for μ = 0 on the ray), else free.
  [[nodiscard]] block_state state(auto const& x) const {
    vector_type const v = x;
    if (!(v(0) > S(0))) return block_state::fixed;
    bool const inside = mu_ > S(0) && ratio_at_most(v, S(1) - detail::rounding_band<S>());
    return inside ? block_state::free : block_state::sliding;
  }

  /// Slanting operator of the projection at x.
  ///
  ///     ‖x_t‖ <= μ x_n        I                                (mantle and apex included)
  ///     x_n + μ‖x_t‖ <= 0     0                                (the polar cone, apex excluded)
  ///     otherwise             w wᵀ + θ (0 ⊕ (I − e eᵀ)),       e = x_t/‖x_t‖,
  ///
  /// where w = (1, μe)/√(1 + μ²) is the generator through p and θ = μ p_n/‖x_t‖ ∈ [0, 1]:
  /// differentiate p = w wᵀx with de = (I − eeᵀ) dx_t/‖x_t‖. For μ = 0, where there is no interior,
  /// the derivative e₀e₀ᵀ of the projection to the ray stands for I.
  [[nodiscard]] matrix_type slant(auto const& x) const {
    vector_type const v = x;
    auto const foot = detail::nearest_on_cone<S, N>(mu_, v);
    if (foot.region == detail::cone_region::mantle) {
      return detail::mantle_slant<S, N>(mu_, foot, v);
    }
    matrix_type G = matrix_type::Zero();
    if (foot.region == detail::cone_region::undefined) G.setConstant(detail::not_a_number<S>());
    if (foot.region == detail::cone_region::inside) {
      if (mu_ > S(0)) G.setIdentity();
      G(0, 0) = S(1);
    }
    return G;
  }

  /// sup{α >= 0 : x + α d in the set} for x in the set; x outside by rounding counts as on the
  /// mantle, and so does d: a direction of the cone up to the band has no end.
  [[nodiscard]] S step_to_boundary(auto const& x, auto const& d) const {
    vector_type const v = x, w = d;
    if (detail::has_nan(v) || detail::has_nan(w)) return detail::not_a_number<S>();
    if (contains(w)) return detail::infinity<S>();
    return detail::cone_step<S, N>(mu_, v, w);
  }

  /// 0 for y in the polar cone y_n + μ‖y_t‖ <= 0 (up to 8 ε |y_n|), otherwise ∞.
  [[nodiscard]] S support(auto const& y) const {
    vector_type const v = y;
    if (detail::has_nan(v)) return detail::not_a_number<S>();
    if (v(0) > S(0)) return detail::infinity<S>();
    S const depth = -v(0) * (S(1) + detail::rounding_band<S>());
    auto const μρ = detail::scaled_slip<S, N>(mu_, v);
    return detail::times_power_of_two<S>(μρ.value, μρ.exponent) <= depth ? S(0)
                                                                         : detail::infinity<S>();
  }

  /// f(x) = (‖x_t‖² − μ²x_n², −x_n) <= 0; the first accurate also near the mantle.
  [[nodiscard]] Eigen::Matrix<S, 2, 1> inequality(auto const& x) const {
    using word = detail::double_word<S>;
    vector_type const v = x;
    auto const t = detail::tail_of(v);
    auto const bound = detail::exact_product<S>(mu_, v(0));
    auto const squares = detail::precise_dot<S>(t, t);
    return {(squares - bound * word(bound)).hi, S(-v(0))};
  }

  /// Column i is the gradient of fᵢ.
  [[nodiscard]] Eigen::Matrix<S, N, 2> inequality_gradient(auto const& x) const {
    vector_type const v = x;
    return detail::from_entries<Eigen::Matrix<S, N, 2>>([&](int i, int j) -> S {
      if (j == 1) return S(i == 0 ? -1 : 0);
      return i == 0 ? S(-2) * mu_ * (mu_ * v[0]) : S(2) * v[i];
    });
  }

  /// ν₁ ∇²f₁ = 2 ν₁ diag(−μ², 1, …, 1); f₂ is linear.
  [[nodiscard]] matrix_type inequality_hessian(auto const&, auto const& multipliers) const {
    S const twice = S(2) * multipliers(0);
    return detail::from_entries<matrix_type>([&](int i, int j) -> S {
      if (i != j) return S(0);
      return i == 0 ? twice * (-mu_ * mu_) : twice;
    });
  }

  /// (μ x_n, x_t) ∈ L; needs μ > 0.
  [[nodiscard]] vector_type lorentz_point(auto const& x) const {
    vector_type v = x;
    v.data()[0] *= mu_;
    return v;
  }
  [[nodiscard]] matrix_type lorentz_matrix() const {
    return detail::from_entries<matrix_type>([&](int i, int j) -> S {
      return i != j ? S(0) : i == 0 ? mu_ : S(1);
    });
  }

 private:
  /// ‖x_t‖ <= factor · μ x_n and x_n >= 0, with one unit of the smallest numbers allowed for every
  /// component: there rounding is no longer relative.
  [[nodiscard]] bool ratio_at_most(vector_type const& v, S const& factor) const {
    if (!(v(0) >= S(0))) return false;
    auto const ρ = detail::scaled_norm<S, N - 1>(detail::tail_of(v));
    int const k = detail::binary_exponent(mu_);
    S const unit = std::numeric_limits<S>::denorm_min();
    S const bound = factor * detail::times_power_of_two<S>(mu_, -k) *
                    detail::times_power_of_two<S>(v(0) + unit, k - ρ.exponent);
    return ρ.value <= bound + detail::times_power_of_two<S>(S(N) * unit, -ρ.exponent);
  }

  S mu_{1};
};

// --- plane cone ----------------------------------------------------------------------------------
//
// The friction cone of a plane problem, { (x_n, x_t) : |x_t| <= μ x_n }, as the polyhedron that it
// is: the same set as second_order_cone<2>, with linear inequalities in place of the quadratic one.
// An interior-point method has nothing to curve around then.

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
