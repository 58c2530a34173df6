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
  if constexpr (T == 1) {
    return b / ((matrix(0, 0) + λ) / m);
  } else {
    Eigen::Matrix<S, T, T> s = matrix / m;
    s.diagonal().array() += λ / m;
    S const determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    return Eigen::Matrix<S, T, 1>(s(1, 1) * b(0) - s(0, 1) * b(1),
                                  s(0, 0) * b(1) - s(1, 0) * b(0)) /
           determinant;
  }
}

/// Solves one contact; `guess` is a λ from before, or 0.
template <int N, class S>
[[nodiscard]] one_contact<N, S> solve_one_contact(Eigen::Matrix<S, N, N> const& W,
                                                  Eigen::Matrix<S, N, 1> const& q, S const& μ,
                                                  S const& guess) {
  using std::abs;
  constexpr int T = N - 1;
  using tangent = Eigen::Matrix<S, T, 1>;
  one_contact<N, S> c;
  c.r.setZero();
  if (q(0) >= S(0)) return c;
  S const w = W(0, 0);
  if (μ == S(0)) {
    c.r(0) = -q(0) / w;
    return c;
  }
  tangent const coupling = W.template topRightCorner<1, T>().transpose();
  tangent const lever = W.template bottomLeftCorner<T, 1>() / w;
  Eigen::Matrix<S, T, T> const schur =
      W.template bottomRightCorner<T, T>() - lever * coupling.transpose();
  tangent const b = q.template tail<T>() - lever * q(0);
  auto const normal = [&](tangent const& t) { return S(-(q(0) + coupling.dot(t)) / w); };

  S const largest = schur.cwiseAbs().maxCoeff();
  tangent t = -shifted_inverse<T, S>(schur, S(0), largest, b) / largest;
  S n = normal(t);
  if (t.stableNorm() <= μ * n) {
    c.r << n, t;
    return c;
  }
  if constexpr (T == 1) {
    S const sign = b(0) > S(0) ? S(-1) : S(1);
    n = -q(0) / (w + sign * μ * coupling(0));
    c.slip = -b(0) / (sign * μ * n) - schur(0, 0);
    c.r << n, sign * μ * n;
    return c;
  }
  S const push = b.stableNorm(), first = push / μ * (w / -q(0));
  if (!(first <= std::numeric_limits<S>::max())) {  // λ → ∞: r_t against b
    tangent const e = b / push;
    n = -q(0) / (w - μ * coupling.dot(e));
    c.slip = std::numeric_limits<S>::max();
    c.r << n, e * (-μ * n);
    return c;
  }
  S low = S(0), high = std::numeric_limits<S>::infinity();
  S λ = guess > S(0) ? guess : first;
  tangent e = tangent::Zero();  // direction of r_t
  for (int k = 0; k < 80; ++k) {
    S const m = std::max(largest, λ);
    tangent const y = -shifted_inverse<T, S>(schur, λ, m, b);  // m r_t
    S const size = y.stableNorm();
    e = y / size;
    n = normal(tangent(y / m));
    S const ψ = μ * n / size * m - S(1);
    if (abs(ψ) <= S(4) * std::numeric_limits<S>::epsilon()) break;
    (ψ < S(0) ? low : high) = λ;
    tangent const z = shifted_inverse<T, S>(schur, λ, m, e);  // −(dr_t/dλ) m / ‖r_t‖
    S const slope = μ * (coupling.dot(z) / w / m + n * (e.dot(z) / size));
    S next = λ - ψ / slope;
    if (!(next > low && next < high)) {
      next = high < std::numeric_limits<S>::infinity() ? S(low + (high - low) / S(2)) : S(8) * λ;
    }
    if (next == λ) break;
    λ = next;
  }
  c.slip = λ;
  c.r << n, e * (μ * n);
  return c;
}

}  // namespace slant::contact::detail
