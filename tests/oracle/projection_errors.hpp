// SPDX-License-Identifier: MIT
//
// Largest error of the projections of the library over many hard points, in ulp of each component,
// against the naive twins in a much wider type.
#pragma once

#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/second_order_cone.hpp>

#include "hard_points.hpp"
#include "naive_projections.hpp"
#include "precise.hpp"

#include <Eigen/Core>

namespace oracle {

/// What was found, with the worst case for a message.
template <class S, int N>
struct projection_errors {
  double ulp = 0;            ///< largest error of a component
  int outside = 0;           ///< projections that the set does not contain
  hard_point<S, N> worst{};  ///< where `ulp` was met

  template <class Set, class Real>
  void record(Set const& set, hard_point<S, N> const& p, Eigen::Matrix<Real, N, 1> const& exact,
              Real const& smallest) {
    Eigen::Matrix<S, N, 1> const computed = set.project(p.x);
    double const distance = ulp_distance<S, N, Real>(computed, exact, smallest);
    if (!set.contains(computed)) ++outside;
    if (distance > ulp) {
      ulp = distance;
      worst = p;
    }
  }
};

/// Of make(l, u), a half line or an interval: points of all sizes and within a few ulp of both
/// bounds; l = −∞, u = ∞ and l = u among them.
template <class Make>
projection_errors<double, 1> bound_errors(Make const& make, bool two_sided, int count,
                                          unsigned seed) {
  double const inf = std::numeric_limits<double>::infinity();
  number_source<double> source(seed);
  projection_errors<double, 1> errors;
  for (int i = 0; i < count; ++i) {
    double l = i % 7 == 0 ? 0.0 : i % 11 == 0 ? -inf : source.any_size();
    double u = !two_sided || i % 13 == 0 ? inf
               : i % 5 == 0 && l > -inf  ? source.nudged(l)
                                         : source.any_size();
    if (l > u) std::swap(l, u);
    hard_point<double, 1> p{l, u, {}};
    p.x(0) = i % 3 == 0 ? source.any_size() : source.nudged(i % 3 == 1 ? l : u);
    if (!p.x.allFinite()) p.x(0) = source.any_size();
    auto const exact =
        naive::project_box<float_50, 1>(widen<float_50>(p.x), float_50(l), float_50(u));
    errors.record(make(l, u), p, exact, float_50(std::numeric_limits<double>::min()));
  }
  return errors;
}

template <class S, class Real, int N>
projection_errors<S, N> ball_errors(int count, unsigned seed) {
  number_source<S> source(seed);
  projection_errors<S, N> errors;
  for (int i = 0; i < count; ++i) {
    auto const p = hard_ball_point<S, N>(source, i);
    auto const exact = naive::project_ball<Real, N>(widen<Real>(p.x), Real(p.first));
    errors.record(slant::ball<N, S>(p.first), p, exact, Real((std::numeric_limits<S>::min)()));
  }
  return errors;
}

template <class S, class Real, int N>
projection_errors<S, N> cone_errors(int count, unsigned seed) {
  number_source<S> source(seed);
  projection_errors<S, N> errors;
  for (int i = 0; i < count; ++i) {
    auto const p = hard_cone_point<S, N>(source, i);
    auto const exact = naive::project_cone<Real, N>(widen<Real>(p.x), Real(p.first));
    errors.record(slant::second_order_cone<N, S>(p.first), p, exact,
                  Real((std::numeric_limits<S>::min)()));
  }
  return errors;
}

/// Nearest point of an ellipse in the type Real: bisection in `Coarse`, which may be narrower, and
/// Newton's method in Real down to the last digits. G is convex and decreasing, so from the left of
/// the root Newton's method rises to it, and from the right it lands on the left.
template <class Real, class Coarse, class S>
Eigen::Matrix<Real, 2, 1> precise_ellipse_projection(hard_point<S, 2> const& p) {
  Real const a(p.first), b(p.second), x(abs(Real(p.x(0)))), y(abs(Real(p.x(1))));
  if (naive::ellipse_secular<Real>(a, b, x, y, Real(0)) <= Real(0)) return widen<Real>(p.x);
  Real t(naive::ellipse_multiplier<Coarse>(Coarse(p.first), Coarse(p.second), Coarse(p.x(0)),
                                           Coarse(p.x(1))));
  Real const a2 = a * a, b2 = b * b, ax = a * x, by = b * y;
  Real const accuracy = sqrt(std::numeric_limits<Real>::epsilon());
  for (int i = 0; i < 10000; ++i) {
    Real const u = Real(1) / (a2 + t), v = Real(1) / (b2 + t);
    Real const X = ax * u, Y = by * v;
    Real const step = (X * X + Y * Y - Real(1)) / (Real(2) * (X * X * u + Y * Y * v));
    t += step;
    if (t < Real(0)) t = Real(0);
    // Quadratic convergence: the step after one of half the digits is exact.
    if (abs(step) * (u > v ? u : v) < accuracy * Real(1e-6)) break;
  }
  return {a2 * Real(p.x(0)) / (a2 + t), b2 * Real(p.x(1)) / (b2 + t)};
}

template <class S, class Real, class Coarse>
projection_errors<S, 2> ellipse_errors(int count, unsigned seed, double aspect = 8) {
  number_source<S> source(seed);
  projection_errors<S, 2> errors;
  for (int i = 0; i < count; ++i) {
    auto const p = hard_ellipse_point<S>(source, i, aspect);
    if (!(p.first > S(0) && p.second > S(0)) || !p.x.allFinite()) continue;
    auto const exact = precise_ellipse_projection<Real, Coarse, S>(p);
    errors.record(slant::ellipse<S>(p.first, p.second), p, exact,
                  Real((std::numeric_limits<S>::min)()));
  }
  return errors;
}

}  // namespace oracle
