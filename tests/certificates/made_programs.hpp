// SPDX-License-Identifier: MIT
//
// Quadratic programs over half lines and discs whose solution is known.
#pragma once

#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <support/dense_algebra.hpp>

namespace test {

using real_vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// A quadratic program over half lines and discs that is made from its solution: x* with forces −g*
/// in the normal cone, b = A x* − g*.
struct made_program {
  Eigen::MatrixXd A;
  Eigen::MatrixXd inverse;
  Eigen::VectorXd b;
  Eigen::VectorXd g;  // radii
  Eigen::VectorXd solution;
  double lost;  // ‖·‖_{A⁻¹} of what rounding b loses
};

inline made_program make_program(int m, double log_condition, std::mt19937& random) {
  using namespace evaluated;
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0, 1);
  int const n = 3 * m;
  Eigen::MatrixXd X(n, n);
  for (int j = 0; j < n * n; ++j) X.data()[j] = gauss(random);
  Eigen::MatrixXd const Q = orthonormal(X);
  Eigen::VectorXd eigenvalues(n);
  for (int j = 0; j < n; ++j) eigenvalues(j) = std::pow(10, -log_condition * uniform(random));
  eigenvalues(0) = 1;
  eigenvalues(n - 1) = std::pow(10, -log_condition);
  made_program p;
  p.A = Q * eigenvalues.asDiagonal() * Q.transpose();
  p.A = 0.5 * (p.A + p.A.transpose());
  p.inverse = Q * eigenvalues.cwiseInverse().asDiagonal() * Q.transpose();
  p.g.resize(m);
  p.solution.resize(n);
  real_vector force = real_vector::Zero(n);
  for (int i = 0; i < m; ++i) {
    bool const open = uniform(random) < 0.5;
    p.solution(i) = open ? 0 : uniform(random);
    if (open) force(i) = uniform(random) < 0.2 ? 0 : uniform(random);  // weak contact at times
    p.g(i) = uniform(random) < 0.1 ? 0 : uniform(random);
    Eigen::Vector2d t(gauss(random), gauss(random));
    bool const slides = uniform(random) < 0.5;
    t *= p.g(i) * (slides ? 1 : 0.9 * uniform(random)) / t.norm();
    p.solution.segment<2>(m + 2 * i) = t;
    if (slides && p.g(i) > 0) {
      long double const size = uniform(random) / p.g(i);
      force(m + 2 * i) = -size * static_cast<long double>(t(0));
      force(m + 2 * i + 1) = -size * static_cast<long double>(t(1));
    }
  }
  real_vector const b = p.A.cast<long double>() * p.solution.cast<long double>() - force;
  p.b = b.cast<double>();
  Eigen::VectorXd const rounding = (b - p.b.cast<long double>()).cast<double>();
  p.lost = std::sqrt(rounding.dot(p.inverse * rounding));
  // The radius of a sliding disc is that of the point, up to rounding.
  p.lost += 4e-16 * p.solution.norm() + 4e-16 * force.cast<double>().norm();
  return p;
}

inline double energy_norm(Eigen::MatrixXd const& A, Eigen::VectorXd const& x) {
  real_vector const y = x.cast<long double>();
  return static_cast<double>(std::sqrt(std::fmax(0.0L, y.dot(A.cast<long double>() * y))));
}

inline auto program(made_program const& p) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A), p.b,
                             slant::cartesian(slant::half_lines(p.g.size()), slant::discs(p.g))};
}

}  // namespace test
