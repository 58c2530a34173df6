// SPDX-License-Identifier: MIT
//
// Definite programs over up to four half lines and intervals: what two methods find fulfils the
// optimality conditions, as computed in long double.
#include "numbers.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/contact_sets.hpp>

#include <algorithm>
#include <cmath>

namespace properties::programs {

using matrix = Eigen::MatrixXd;
using vector = Eigen::VectorXd;
using wide = long double;

struct program {
  matrix A;
  vector b, low, high;  ///< high may be infinite
};

program any_program() {
  Eigen::Index const n = *rc::gen::inRange(1, 5);
  program p;
  matrix const L = matrix_of(*rc::gen::inRange(0, 4), n, quarter);
  p.A = L.transpose() * L + *rc::gen::inRange(1, 17) / 16.0 * matrix::Identity(n, n);
  p.b = vector_of(n, quarter);
  p.low = vector_of(n, quarter);
  p.high = p.low + vector_of(n, quarter).cwiseAbs();  // sometimes the same
  for (double& bound : p.high)
    if (*rc::gen::arbitrary<bool>()) bound = std::numeric_limits<double>::infinity();
  // Any units: of forces, and of displacements.
  double const force = std::ldexp(1.0, *rc::gen::inRange(-100, 100)),
               length = std::ldexp(1.0, *rc::gen::inRange(-100, 100));
  p.A *= force / length;
  p.b *= force;
  p.low *= length;
  p.high *= length;
  return p;
}

/// x is in the set, and a step of length 1/‖A‖ against its gradient, projected, leads nowhere: by
/// ‖x − x*‖ ≤ 2 ‖A‖/λ ‖x − P(x − g/‖A‖)‖ it is the solution.
template <class Report>
void solved(program const& p, Report const& r) {
  RC_LOG() << r.reason << "\n";
  RC_ASSERT(r.converged());
  vector const x = r.x();
  RC_ASSERT((x.array() >= p.low.array()).all() && (x.array() <= p.high.array()).all());
  vector const origin = p.low.cwiseMax(vector::Zero(p.b.size())).cwiseMin(p.high);
  double const norm = p.A.norm(), scale = (p.A * origin - p.b).norm() + norm * x.norm();
  wide distance = 0;
  for (int i = 0; i < p.b.size(); ++i) {
    wide gradient = -static_cast<wide>(p.b[i]);
    for (int j = 0; j < p.b.size(); ++j) gradient += static_cast<wide>(p.A(i, j)) * x[j];
    wide const moved = std::clamp<wide>(x[i] - gradient / norm, p.low[i], p.high[i]);
    distance = std::hypot(distance, x[i] - moved);
  }
  // The methods stop at 1e-12 for steps of at most four times that length.
  RC_ASSERT(norm * double(distance) <= 1e-11 * scale);
}

}  // namespace properties::programs

namespace properties {

bool programs_are_solved() {
  using namespace programs;
  return rc::check("the solution of a program with bounds fulfils its optimality conditions", [] {
    program const p = any_program();
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
    auto const set = slant::intervals(p.low, p.high);
    auto const qp = slant::separable_qp{A, p.b, set};
    auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(2000);
    vector const start = *rc::gen::arbitrary<bool>() ? vector(vector::Zero(p.b.size()))
                                                     : vector_of(p.b.size(), number);
    solved(p, slant::solve(slant::kprgp{qp}, start, stop));
    solved(p, slant::solve(slant::symmetric_newton{qp}, start, stop));
  });
}

}  // namespace properties
