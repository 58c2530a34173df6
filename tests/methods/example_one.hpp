// SPDX-License-Identifier: MIT
//
// [K Ex 1]: A = tridiag(−1, 4, −1), b = A y, twelve unknowns in six discs of radii g. The pairs are
// (i, i + 6). The solution has the discs 2, 3, 5 active; here it comes from Newton's method on the
// optimality conditions with that set of equations, and is checked against the inequalities.
#pragma once

#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>

namespace test {

template <class S>
struct example_one {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  matrix A = matrix::Zero(12, 12);
  vector b;
  vector g = vector(6);

  example_one() {
    using std::sqrt;
    for (Eigen::Index i = 0; i < 12; ++i) {
      A(i, i) = S(4);
      if (i > 0) A(i, i - 1) = A(i - 1, i) = S(-1);
    }
    vector y(12);
    y << S(2), S(1), S(1) / S(2), S(0), S(0), S(11), S(1) / S(100000), S(-1), sqrt(S(2)),
        S(-1) / S(10), S(41) / S(100000), S(143);
    b = A * y;
    g << S(2), S(1), S(1) / S(2), S(2), S(1) / S(1000), S(154);
  }

  [[nodiscard]] auto set() const { return slant::discs<slant::planar>(g); }
  [[nodiscard]] auto a() const {
    return slant::matrix<slant::law::self_adjoint, slant::law::positive_definite>(A);
  }
  [[nodiscard]] vector zero() const { return vector::Zero(12); }
};

/// Solution of example one: A x − b + 2 μᵢ xᵢ = 0, ‖xᵢ‖² = gᵢ² for the active discs i.
template <class S>
struct example_one_solution {
  using vector = typename example_one<S>::vector;
  static constexpr std::array<Eigen::Index, 3> active{1, 2, 4};

  vector x;                        ///< 12
  vector multipliers;              ///< 3; all positive at the solution
  bool feasible_elsewhere = true;  ///< ‖xᵢ‖ < gᵢ for the other discs
  S residual{0};                   ///< of the equations

  example_one_solution() {
    example_one<S> const p;
    vector z(15);
    z.head(12) = p.b / S(4);
    for (Eigen::Index k = 0; k < 3; ++k) {
      auto const i = active[static_cast<std::size_t>(k)];
      using std::sqrt;
      S const length = sqrt(S(z(i) * z(i) + z(i + 6) * z(i + 6)));
      z(i) *= p.g(i) / length;
      z(i + 6) *= p.g(i) / length;
      z(12 + k) = S(2);
    }
    for (int step = 0; step < 60; ++step) {
      typename example_one<S>::matrix J = example_one<S>::matrix::Zero(15, 15);
      vector F(15);
      J.topLeftCorner(12, 12) = p.A;
      F.head(12) = p.A * z.head(12) - p.b;
      for (Eigen::Index k = 0; k < 3; ++k) {
        auto const i = active[static_cast<std::size_t>(k)];
        F(12 + k) = -p.g(i) * p.g(i);
        for (auto const j : {i, i + 6}) {
          F(j) += S(2) * z(12 + k) * z(j);
          F(12 + k) += z(j) * z(j);
          J(j, j) += S(2) * z(12 + k);
          J(j, 12 + k) = J(12 + k, j) = S(2) * z(j);
        }
      }
      residual = F.norm();
      z -= J.partialPivLu().solve(F);
    }
    x = z.head(12);
    multipliers = z.tail(3);
    for (Eigen::Index i : {0, 3, 5}) {
      feasible_elsewhere =
          feasible_elsewhere && x(i) * x(i) + x(i + 6) * x(i + 6) < p.g(i) * p.g(i);
    }
  }
};

}  // namespace test
