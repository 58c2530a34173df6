// SPDX-License-Identifier: MIT
//
// Definite programs over up to four half lines and intervals: two methods against all 3ⁿ active
// sets.
#include "numbers.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

#include <array>

namespace properties::programs {

using matrix = Eigen::MatrixXd;
using vector = Eigen::VectorXd;
using wide = long double;
constexpr int most = 4;
using wide_matrix = std::array<std::array<wide, most + 1>, most>;  // with the right-hand side

struct program {
  matrix A;
  vector b, low, high;  ///< high may be infinite
  double least = 0;     ///< eigenvalues of A are at least this
};

program any_program() {
  Eigen::Index const n = *rc::gen::inRange(1, most + 1);
  program p;
  matrix const L = matrix_of(*rc::gen::inRange(0, 4), n, quarter);
  p.least = *rc::gen::inRange(1, 17) / 16.0;
  p.A = L.transpose() * L + p.least * matrix::Identity(n, n);
  p.b = vector_of(n, quarter);
  p.low = vector_of(n, quarter);
  p.high = p.low + vector_of(n, quarter).cwiseAbs();  // sometimes the same
  for (double& bound : p.high)
    if (*rc::gen::arbitrary<bool>()) bound = std::numeric_limits<double>::infinity();
  // Any units: of forces, and of displacements.
  double const force = std::ldexp(1.0, *rc::gen::inRange(-100, 100)),
               length = std::ldexp(1.0, *rc::gen::inRange(-100, 100));
  p.A *= force / length;
  p.least *= force / length;
  p.b *= force;
  p.low *= length;
  p.high *= length;
  return p;
}

/// The point of an active set: kind 0 is on the lower bound, 1 on the upper, 2 free.
bool solve_face(program const& p, std::array<int, most> const& kinds, vector& x) {
  int const n = static_cast<int>(p.b.size());
  wide_matrix M{};
  for (int i = 0; i < n; ++i) {
    auto& row = M[static_cast<std::size_t>(i)];
    int const kind = kinds[static_cast<std::size_t>(i)];
    for (int j = 0; j < n; ++j)
      row[static_cast<std::size_t>(j)] = kind == 2 ? p.A(i, j) : i == j ? p.least : 0;
    row[most] = kind == 2 ? p.b[i] : p.least * (kind == 0 ? p.low[i] : p.high[i]);
    if (!std::isfinite(row[most])) return false;
  }
  // Rows of a definite matrix and of the identity: pivots on the diagonal.
  auto const size = static_cast<std::size_t>(n);
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t i = 0; i < size; ++i) {
      if (i == k) continue;
      wide const factor = M[i][k] / M[k][k];
      for (std::size_t j = k; j < most + 1; ++j) M[i][j] -= factor * M[k][j];
    }
  x.resize(n);
  for (std::size_t i = 0; i < size; ++i) x[static_cast<int>(i)] = double(M[i][most] / M[i][i]);
  return true;
}

/// The solution: of all points of active sets that are in the set, the one of least energy.
vector brute_force(program const& p) {
  int const n = static_cast<int>(p.b.size());
  vector best, x;
  wide least = std::numeric_limits<wide>::infinity();
  std::array<int, most> kinds{};
  for (int code = 0; code < 81; ++code) {
    for (int i = 0, rest = code; i < most; ++i, rest /= 3)
      kinds[static_cast<std::size_t>(i)] = rest % 3;
    if (n < most && kinds[static_cast<std::size_t>(n)] > 0) continue;
    if (!solve_face(p, kinds, x)) continue;
    if ((x.array() < p.low.array()).any() || (x.array() > p.high.array()).any()) continue;
    wide energy = 0;
    for (int i = 0; i < n; ++i) {
      wide product = 0;
      for (int j = 0; j < n; ++j) product += static_cast<wide>(p.A(i, j)) * x[j];
      energy += x[i] * (product / 2 - static_cast<wide>(p.b[i]));
    }
    if (energy < least) {
      least = energy;
      best = x;
    }
  }
  return best;
}

template <class Report>
void agree(program const& p, vector const& exact, Report const& r) {
  RC_LOG() << r.reason << "\n";
  RC_ASSERT(r.converged());
  RC_ASSERT((r.x().array() >= p.low.array()).all() && (r.x().array() <= p.high.array()).all());
  // ‖x − x*‖ ≤ (1 + ‖A‖/λ) ‖r̃‖ / λ, with ‖r̃‖ ≤ 1e-12 ‖A P(0) − b‖.
  vector const origin = p.low.cwiseMax(vector::Zero(p.b.size())).cwiseMin(p.high);
  double const norm = p.A.norm(), scale = (p.A * origin - p.b).norm() + norm * exact.norm();
  RC_ASSERT((r.x() - exact).norm() <= 1e-11 * (1 + norm / p.least) * scale / p.least);
}

}  // namespace properties::programs

namespace properties {

bool programs_are_solved() {
  using namespace programs;
  return rc::check("programs with bounds have the solution that all active sets give", [] {
    program const p = any_program();
    vector const exact = brute_force(p);
    RC_ASSERT(exact.size() == p.b.size());
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
    auto const set = slant::intervals(p.low, p.high);
    auto const qp = slant::separable_qp{A, p.b, set};
    auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(2000);
    vector const start = *rc::gen::arbitrary<bool>() ? vector(vector::Zero(p.b.size()))
                                                     : vector_of(p.b.size(), number);
    agree(p, exact, slant::solve(slant::kprgp{qp}, start, stop));
    agree(p, exact, slant::solve(slant::symmetric_newton{qp}, start, stop));
  });
}

}  // namespace properties
