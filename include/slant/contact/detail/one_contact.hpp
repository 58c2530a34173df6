// SPDX-License-Identifier: MIT
//
// One contact with Coulomb friction, solved exactly: u = W r + q with a small positive definite W.
//
// q_n >= 0 is met by r = 0. Otherwise the contact is closed, u_n = 0, and elimination of r_n leaves
//
//     S r_t + b = u_t,   S = W_tt − W_tn W_nt / W_nn,   b = q_t − W_tn q_n / W_nn,
//     r_n = −(q_n + W_nt r_t) / W_nn.
//
// Stick is u_t = 0 with ‖r_t‖ <= μ r_n. Slip is u_t = −λ r_t with λ > 0, so that
// r_t(λ) = −(S + λI)⁻¹ b, and λ is the root of
//
//     ψ(λ) = μ r_n(λ)/‖r_t(λ)‖ − 1,
//
// negative at 0, where stick has failed, and growing like λ in the end: there is a root for every μ
// and every W, and since ψ is nearly linear Newton's method within a bracket needs a few steps (in
// 3D the root of a quartic: Bonnefon and Daviet, "Quartic formulation of Coulomb 3D frictional
// contact", 2011). In 2D the sign of r_t is that of −b, which says it all.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/sets/detail/entries.hpp>
#include <slant/sets/detail/scaled_norm.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant::contact::detail {

/// A contact's r, and λ of u_t = −λ r_t (0: it sticks or is open).
template <int N, class S>
struct one_contact {
  Eigen::Matrix<S, N, 1> r;
  S slip{0};
};

/// m (S + λI)⁻¹ b for 1 × 1 and 2 × 2 matrices, m the largest entry of S and λ: neither squares
/// nor inverses leave the range of numbers where λ is huge.
template <int T, class S>
[[nodiscard]] Eigen::Matrix<S, T, 1> shifted_inverse(Eigen::Matrix<S, T, T> const& matrix,
                                                     S const& λ, S const& m,
                                                     Eigen::Matrix<S, T, 1> const& b) {
  using slant::detail::from_entries;
  if constexpr (T == 1) {
    return Eigen::Matrix<S, T, 1>(S(b(0) / ((matrix(0, 0) + λ) / m)));
  } else {
    auto const s = from_entries<Eigen::Matrix<S, T, T>>(
        [&](int i, int j) -> S { return matrix(i, j) / m + (i == j ? λ / m : S(0)); });
    S const determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    return {S((s(1, 1) * b(0) - s(0, 1) * b(1)) / determinant),
            S((s(0, 0) * b(1) - s(1, 0) * b(0)) / determinant)};
  }
}

/// Solves one contact; `guess` is a λ from before, or 0.
template <int N, class S>
[[nodiscard]] one_contact<N, S> solve_one_contact(Eigen::Matrix<S, N, N> const& W,
                                                  Eigen::Matrix<S, N, 1> const& q, S const& μ,
                                                  S const& guess) {
  using slant::detail::dot_of;
  using slant::detail::from_entries;
  using slant::detail::length_of;
  using slant::detail::multiple_of;
  using std::abs;
  constexpr int T = N - 1;
  using tangent = Eigen::Matrix<S, T, 1>;
  using matrix = Eigen::Matrix<S, T, T>;
  auto const over = [](tangent const& t, S const& a) {
    return from_entries<tangent>([&](int i) -> S { return t(i) / a; });
  };
  auto const force = [&](S const& n, tangent const& t) {
    return from_entries<Eigen::Matrix<S, N, 1>>([&](int i) { return i == 0 ? n : t(i - 1); });
  };
  one_contact<N, S> c{.r = from_entries<Eigen::Matrix<S, N, 1>>([](int) { return S(0); })};
  if (q(0) >= S(0)) return c;
  S const w = W(0, 0);
  if (μ == S(0)) {
    c.r(0) = -q(0) / w;
    return c;
  }
  auto const coupling = from_entries<tangent>([&](int i) { return W(0, i + 1); });
  auto const lever = from_entries<tangent>([&](int i) -> S { return W(i + 1, 0) / w; });
  auto const schur = from_entries<matrix>(
      [&](int i, int j) -> S { return W(i + 1, j + 1) - lever(i) * coupling(j); });
  auto const b = from_entries<tangent>([&](int i) -> S { return q(i + 1) - lever(i) * q(0); });
  auto const normal = [&](tangent const& t) { return S(-(q(0) + dot_of(coupling, t)) / w); };

  S const largest = slant::detail::largest_of(schur);
  tangent const t = over(shifted_inverse<T, S>(schur, S(0), largest, b), -largest);
  S n = normal(t);
  if (length_of(t) <= μ * n) {
    c.r = force(n, t);
    return c;
  }
  if constexpr (T == 1) {
    S const sign = b(0) > S(0) ? S(-1) : S(1);
    n = -q(0) / (w + sign * μ * coupling(0));
    c.slip = -b(0) / (sign * μ * n) - schur(0, 0);
    c.r = force(n, tangent(S(sign * μ * n)));
    return c;
  }
  S const push = length_of(b), first = push / μ * (w / -q(0));
  if (!(first <= std::numeric_limits<S>::max())) {  // λ → ∞: r_t against b
    tangent const e = over(b, push);
    n = -q(0) / (w - μ * dot_of(coupling, e));
    c.slip = std::numeric_limits<S>::max();
    c.r = force(n, multiple_of(-μ * n, e));
    return c;
  }
  S low = S(0), high = std::numeric_limits<S>::infinity();
  S λ = guess > S(0) ? guess : first;
  tangent e = b;  // direction of r_t
  for (int k = 0; k < 80; ++k) {
    S const m = std::max(largest, λ);
    tangent const y = multiple_of(S(-1), shifted_inverse<T, S>(schur, λ, m, b));  // m r_t
    S const size = length_of(y);
    e = over(y, size);
    n = normal(over(y, m));
    S const ψ = μ * n / size * m - S(1);
    if (abs(ψ) <= S(4) * std::numeric_limits<S>::epsilon()) break;
    (ψ < S(0) ? low : high) = λ;
    tangent const z = shifted_inverse<T, S>(schur, λ, m, e);  // −(dr_t/dλ) m / ‖r_t‖
    S const slope = μ * (dot_of(coupling, z) / w / m + n * (dot_of(e, z) / size));
    S next = λ - ψ / slope;
    if (!(next > low && next < high)) {
      next = high < std::numeric_limits<S>::infinity() ? S(low + (high - low) / S(2)) : S(8) * λ;
    }
    if (next == λ) break;
    λ = next;
  }
  c.slip = λ;
  c.r = force(n, multiple_of(μ * n, e));
  return c;
}

}  // namespace slant::contact::detail
