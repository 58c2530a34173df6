// SPDX-License-Identifier: MIT
//
// What the tests of Newton's method share: a small natural residual with bounds and discs of very
// different radii, many of which are active, and its Newton system as a dense matrix.
#pragma once

#include <slant/operators/counted.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/power.hpp>
#include <slant/slanting/projection.hpp>

#include <slanting/slanting_support.hpp>

#include <Eigen/Core>
#include <cmath>

namespace newton_scene {

/// m bounds x ≥ 0 and m discs with radii smallest … 3.
template <class S = double>
[[nodiscard]] auto contact_set(int m, double smallest, double unit = 1) {
  Eigen::Matrix<S, Eigen::Dynamic, 1> radii(m);
  for (int i = 0; i < m; ++i) {
    double const part = m == 1 ? 0 : double(i) / (m - 1);
    radii[i] = S(unit * smallest * std::pow(3 / smallest, part));
  }
  return slant::cartesian(slant::power(slant::half_line<S>{}, m),
                          slant::power(slant::ball<2, S>{}, radii));
}

/// A, b, ρ of a problem with 3m unknowns.
struct data {
  explicit data(int m_in, unsigned seed = 1)
      : m(m_in),
        A(slanting_support::random_spd(3 * m, seed)),
        b(20 * slanting_support::random_vector(3 * m, seed + 1)),
        ρ(3 * m / A.trace()) {}

  [[nodiscard]] auto definite() const {
    return slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
  }
  [[nodiscard]] Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(3 * m); }

  int m;
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double ρ;
};

}  // namespace newton_scene
