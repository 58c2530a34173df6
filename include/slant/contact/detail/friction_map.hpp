// SPDX-License-Identifier: MIT
//
// The equations of one contact for Newton's method, and their generalised derivative
//
//     dF = A dr + B du.
//
// Natural map with the de Saxcé correction (de Saxcé and Feng, 1998), G a slanting operator of P_K:
//
//     F = r − P_K(z),  z = r − ρ û,  û = u + μ‖u_t‖ n,      A = I − G,   B = ρ G E,
//     E = I + μ n (u_t/‖u_t‖)ᵀ,  and E = I where u_t = 0, a choice in the convex hull of the
//     limits.
//
// Alart and Curnier (1991), with y = r_n − ρ u_n and z = r_t − ρ u_t:
//
//     F_n = r_n − max(0, y),    F_t = r_t − P_disc(μ max(0, y))(z).
//
// An open contact has F = r, B = 0 in both.
#pragma once

#include <slant/sets/second_order_cone.hpp>

#include <Eigen/Core>

namespace slant::contact {

/// Which equations Newton's method solves.
enum class friction_equations : unsigned char { natural_map, alart_curnier };

namespace detail {

template <int N, class S>
struct friction_map {
  using part_type = Eigen::Matrix<S, N, 1>;
  using block_type = Eigen::Matrix<S, N, N>;
  part_type F;
  block_type A, B;    // only if derivatives were asked for
  bool open = false;  // B = 0, A = I
};

template <bool Derivative, int N, class S>
void natural_map(second_order_cone<N, S> const& cone, S const& ρ, Eigen::Matrix<S, N, 1> const& r,
                 Eigen::Matrix<S, N, 1> const& u, friction_map<N, S>& f) {
  using part_type = Eigen::Matrix<S, N, 1>;
  S const speed = u.template tail<N - 1>().norm();
  part_type z = r - ρ * u;
  z(0) -= ρ * cone.mu() * speed;
  f.F = r - cone.project(z);
  if constexpr (Derivative) {
    auto const G = cone.slant(z);
    f.open = (G.array() == S(0)).all();
    f.A = -G;
    f.A.diagonal().array() += S(1);
    f.B = ρ * G;
    if (speed > S(0)) {
      f.B.template rightCols<N - 1>() +=
          (ρ * cone.mu()) * G.col(0) * (u.template tail<N - 1>() / speed).transpose();
    }
  }
}

template <bool Derivative, int N, class S>
void alart_curnier_map(second_order_cone<N, S> const& cone, S const& ρ,
                       Eigen::Matrix<S, N, 1> const& r, Eigen::Matrix<S, N, 1> const& u,
                       friction_map<N, S>& f) {
  using tangent = Eigen::Matrix<S, N - 1, 1>;
  using square = Eigen::Matrix<S, N - 1, N - 1>;
  S const y = r(0) - ρ * u(0);
  if constexpr (Derivative) {
    f.A.setIdentity();
    f.B.setZero();
    f.open = !(y > S(0));
  }
  f.F = r;
  if (!(y > S(0))) return;
  f.F(0) = ρ * u(0);
  if constexpr (Derivative) {
    f.A(0, 0) = S(0);
    f.B(0, 0) = ρ;
  }
  tangent const z = r.template tail<N - 1>() - ρ * u.template tail<N - 1>();
  S const radius = cone.mu() * y, size = z.norm();
  if (size <= radius) {
    f.F.template tail<N - 1>() = ρ * u.template tail<N - 1>();
    if constexpr (Derivative) {
      f.A.template bottomRightCorner<N - 1, N - 1>().setZero();
      f.B.template bottomRightCorner<N - 1, N - 1>() = ρ * square::Identity();
    }
    return;
  }
  tangent const e = z / size;
  f.F.template tail<N - 1>() -= radius * e;
  if constexpr (Derivative) {
    square const turn = (radius / size) * (square::Identity() - e * e.transpose());
    f.A.template bottomRightCorner<N - 1, N - 1>() -= turn;
    f.B.template bottomRightCorner<N - 1, N - 1>() = ρ * turn;
    f.A.template bottomLeftCorner<N - 1, 1>() = -cone.mu() * e;
    f.B.template bottomLeftCorner<N - 1, 1>() = cone.mu() * ρ * e;
  }
}

/// F of one contact, with A and B if Derivative.
template <bool Derivative, int N, class S>
void friction_equation(friction_equations which, second_order_cone<N, S> const& cone, S const& ρ,
                       Eigen::Matrix<S, N, 1> const& r, Eigen::Matrix<S, N, 1> const& u,
                       friction_map<N, S>& f) {
  if (which == friction_equations::natural_map) {
    natural_map<Derivative>(cone, ρ, r, u, f);
  } else {
    alart_curnier_map<Derivative>(cone, ρ, r, u, f);
  }
}

}  // namespace detail
}  // namespace slant::contact
