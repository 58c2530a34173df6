// SPDX-License-Identifier: MIT
//
// Projections onto sets with arbitrary parameters, at arbitrary points: the laws of a projection,
// in long double.
#include "numbers.hpp"

#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/half_line.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <string>

namespace properties::projections {

using wide = long double;
template <int N>
using point = Eigen::Matrix<double, N, 1>;
template <int N>
using wide_point = Eigen::Matrix<wide, N, 1>;

constexpr wide ε = std::numeric_limits<double>::epsilon();

template <int N>
wide length(wide_point<N> const& x) {
  wide sum = 0;
  for (wide const entry : x) sum = std::hypot(sum, entry);
  return sum;
}

template <int N>
point<N> any_point() {
  return vector_of(N, number);
}

/// P(P(x)) = P(x);   P(x) ∈ Λ;   ⟨x − P(x), P(y) − P(x)⟩ ≤ 0;   ‖P(x) − P(y)‖ ≤ ‖x − y‖.
template <class Set>
void keep_laws(Set const& set) {
  constexpr int n = Set::dimension;
  point<n> const x = any_point<n>(), y = any_point<n>();
  point<n> const p = set.project(x), q = set.project(y), again = set.project(p);
  wide_point<n> const X = x.template cast<wide>(), Y = y.template cast<wide>(),
                      P = p.template cast<wide>(), Q = q.template cast<wide>();
  wide const size = length<n>(X) + length<n>(Y), inside = length<n>(P) + length<n>(Q);
  RC_ASSERT(p.allFinite());
  RC_ASSERT(set.contains(p));
  RC_ASSERT(length<n>(again.template cast<wide>() - P) <= 8 * ε * length<n>(P));
  RC_ASSERT(length<n>(P - Q) <= length<n>(X - Y) + 16 * ε * (size + inside));
  // Lengths to 1: products of squares of 1e150 stay in the range of long double, barely.
  wide const outside = length<n>(X - P), between = length<n>(Q - P);
  if (outside > 0 && between > 0) {
    wide cosine = 0;
    for (int i = 0; i < n; ++i) cosine += (X[i] - P[i]) / outside * ((Q[i] - P[i]) / between);
    RC_ASSERT(cosine <= 32 * ε * (size + inside) * (1 / outside + 1 / between));
  }
}

bool check(std::string const& name, void (*property)()) {
  return rc::check("projection onto " + name, property);
}

double positive() {
  return std::fabs(*number());
}

}  // namespace properties::projections

namespace properties {

bool projections_keep_their_laws() {
  using namespace projections;
  bool good = check("a half line", [] { keep_laws(slant::half_line<>(*number())); });
  good = check("an interval",
               [] {
                 double const a = *number(), b = *number();
                 keep_laws(slant::interval<>(std::min(a, b), std::max(a, b)));
               }) &&
         good;
  good = check("a disc", [] { keep_laws(slant::ball<2>(positive())); }) && good;
  good = check("a ball", [] { keep_laws(slant::ball<3>(positive())); }) && good;
  good = check("a cone", [] { keep_laws(slant::second_order_cone<3>(positive())); }) && good;
  good = check("an ellipse",
               [] {
                 double const a = positive(), b = positive();
                 keep_laws(slant::ellipse<>(a, b));
               }) &&
         good;
  good = rc::check("a disc in other units is the same disc, to the last bit",
                   [] {
                     double const radius = std::fabs(*quarter());
                     point<2> const x = vector_of(2, quarter);
                     double const unit = std::ldexp(1.0, *rc::gen::inRange(-400, 400));
                     point<2> const p = slant::ball<2>(radius).project(x);
                     point<2> const scaled =
                         slant::ball<2>(unit * radius).project(point<2>(unit * x));
                     RC_ASSERT(scaled == unit * p);
                   }) &&
         good;
  return good;
}

}  // namespace properties
