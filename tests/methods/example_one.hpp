// SPDX-License-Identifier: MIT
//
// Example 1 of the lecture in any scalar, and its solution: the discs 2, 3, 5 are active, so it
// comes from Newton's method on the optimality conditions with these equations; that the
// inequalities hold as well is for the tests to check.
#pragma once

#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <tridiagonal/example_1.hpp>

namespace test {

template <class S>
struct example_one {
  using vector = example_1::vector<S>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  matrix A = example_1::matrix<S>();
  vector b = example_1::right_hand_side<S>();
  vector g = example_1::radii<S>();

  [[nodiscard]] auto set() const { return slant::discs<slant::planar>(g); }
  [[nodiscard]] auto a() const {
    return slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
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

  example_one_solution();
};

template <class S>
example_one_solution<S>::example_one_solution() {
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
  for (Eigen::Index i : {0, 3, 5})
    feasible_elsewhere = feasible_elsewhere && x(i) * x(i) + x(i + 6) * x(i + 6) < p.g(i) * p.g(i);
}

// Compiled once.
extern template struct example_one_solution<double>;

}  // namespace test
