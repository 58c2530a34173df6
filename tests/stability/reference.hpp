// SPDX-License-Identifier: MIT
//
// The solution of a program in quadruple precision, and a proof of how exact it is.
//
// A primal-dual interior-point method [Boyd, Vandenberghe: Convex Optimization, 11.7] on the
// equilibrated program finds the faces; Newton's method for the natural residual, with elimination,
// the digits. The bound: for x on its face, g = A x − b and −s the point of the normal cone at x
// next to −g,
//
//     ‖x − x*‖_A ≤ ‖g − s‖_{A⁻¹}.
//
// In contact K is factored in quadruple precision, A = B K⁻¹Bᵀ formed, and u* = K⁻¹(f − Bᵀλ*).
#pragma once

#include <limits>
#include <stability/program.hpp>
#include <stability/quad.hpp>

namespace stability {

struct reference {
  quad_vector x{};  ///< the solution, λ* in contact
  quad_vector u{};  ///< displacement; empty without contact
  quad norm = 0;    ///< energy norm of the solution, ‖u*‖_K or ‖x*‖_A
  double bound = std::numeric_limits<double>::infinity();  ///< of its relative energy error
  double condition = 0;        ///< κ of D K D, D = diag(K)^(−1/2); of D A D without contact
  double plain_condition = 0;  ///< κ of K, of A
  double floor = 0;            ///< attainable relative energy error, see below

  /// Can it judge errors down to the floor?
  [[nodiscard]] bool exact() const { return bound <= 1e-3 * floor; }
};

/// floor = ε (‖y*‖ + ‖D b‖ [without contact]) / (√λ_min(Â) ‖x*‖_A) with  = D A D, y* = D⁻¹x*: a
/// residual that is rounded entry by entry, |δr_i| ≤ ε √A_ii ‖y*‖ as Cholesky's factorisation
/// leaves it, is an error of that size. It lies between ε√κ(Â) and εκ(Â).
[[nodiscard]] reference solve_in_quad(program const& p);

/// ‖u − u*‖_K/‖u*‖_K, or ‖x − x*‖_A/‖x*‖_A without contact; NaN where the numbers are.
[[nodiscard]] double relative_error(program const& p, reference const& r, Eigen::VectorXd const& x);
[[nodiscard]] double relative_error(program const& p, reference const& r,
                                    Eigen::Matrix<long double, Eigen::Dynamic, 1> const& x);

/// x − P(x − D²(A x − b)) in the scale of D⁻¹, over that of x, evaluated in double: what a user can
/// check. Without contact.
[[nodiscard]] double natural_residual(program const& p, Eigen::VectorXd const& x);

}  // namespace stability
