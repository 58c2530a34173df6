// SPDX-License-Identifier: MIT
//
// Random and adversarial points for the projections: all scales, both sides of every kink by a few
// units of the last place, points on axes, at apexes, at centres of curvature, and exact ties.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <random>

namespace oracle {

/// One projection problem: a set of up to two parameters and a point.
template <class S, int N>
struct hard_point {
  S first{0};
  S second{0};
  Eigen::Matrix<S, N, 1> x;
};

/// Draws the numbers that hard points are made of. Everything is drawn in double and then made a
/// number of type S, so the sequence is the same for every S up to rounding.
template <class S>
class number_source {
 public:
  explicit number_source(unsigned seed) : engine_(seed) {}

  /// 10^±150, in float 10^±15: half of the exponent range, so that squares exist.
  static double decades() { return std::numeric_limits<S>::max_exponent10 > 300 ? 150 : 15; }

  double uniform(double l, double u) { return std::uniform_real_distribution<>(l, u)(engine_); }
  int choice(int n) { return std::uniform_int_distribution<>(0, n - 1)(engine_); }
  bool coin() { return choice(2) == 0; }

  /// A number with all digits random, of either sign, of size 10^[l, u].
  S of_size(double l, double u) {
    double const exponent = uniform(l, u);
    S const size = S(std::pow(10.0, exponent)) * (S(1) + digits() / S(4));
    return coin() ? size : S(-size);
  }

  S positive_of_size(double l, double u) {
    using std::abs;
    return abs(of_size(l, u));
  }

  S any_size() { return of_size(-decades(), decades()); }

  /// Uniform in [0, 1) with as many random digits as S has.
  S digits() {
    S value(0), unit(1);
    for (int bits = 0; bits < std::numeric_limits<S>::digits; bits += 30) {
      unit /= S(1 << 30);
      value += S(choice(1 << 30)) * unit;
    }
    return value;
  }

  /// v, moved by at most `most` units of the last place.
  S nudged(S const& v, int most = 4) {
    return v * (S(1) + S(choice(2 * most + 1) - most) * std::numeric_limits<S>::epsilon());
  }

  template <int N>
  Eigen::Matrix<S, N, 1> direction() {
    using std::sqrt;
    Eigen::Matrix<S, N, 1> d;
    S squares(0);
    for (int i = 0; i < N; ++i) {
      d(i) = S(std::normal_distribution<>()(engine_)) +
             digits() * S(std::numeric_limits<double>::epsilon());
      squares += d(i) * d(i);
    }
    return d / S(sqrt(squares));
  }

 private:
  std::mt19937_64 engine_;
};

/// first = radius.
template <class S, int N>
hard_point<S, N> hard_ball_point(number_source<S>& source, int kind) {
  hard_point<S, N> p;
  S const scale = source.positive_of_size(-source.decades(), source.decades());
  p.first = scale;
  switch (kind % 7) {
    case 0:  // ordinary
      p.x = scale * source.of_size(-3, 3) * source.template direction<N>();
      break;
    case 1:  // radius and point of unrelated size
      p.x = source.any_size() * source.template direction<N>();
      break;
    case 2:  // within a few ulp of the sphere
      p.x = scale * source.template direction<N>();
      for (int i = 0; i < N; ++i) p.x(i) = source.nudged(p.x(i));
      break;
    case 3:  // components of unrelated size
      for (int i = 0; i < N; ++i) p.x(i) = source.any_size();
      break;
    case 4:  // on an axis
      p.x.setZero();
      p.x(source.choice(N)) = source.coin() ? source.nudged(scale) : source.any_size();
      break;
    case 5:  // radius zero
      p.first = S(0);
      p.x = source.any_size() * source.template direction<N>();
      break;
    default: {  // exactly on the sphere or one ulp off: multiples of (3, 4) and 5
      using std::ldexp;
      S const unit = ldexp(S(1), source.choice(61) - 30);
      p.x.setZero();
      p.x(0) = S(3) * unit;
      if (N > 1) p.x(N - 1) = S(-4) * unit;
      p.first = source.nudged((N > 1 ? S(5) : S(3)) * unit, 1);
    }
  }
  return p;
}

/// first, second = semi-axes a, b of aspect ratio up to 10^aspect.
template <class S>
hard_point<S, 2> hard_ellipse_point(number_source<S>& source, int kind, double aspect = 8) {
  using std::abs;
  using std::cos;
  using std::sin;
  using std::sqrt;
  hard_point<S, 2> p;
  S const a = source.positive_of_size(-source.decades(), source.decades());
  S const ratio = source.choice(4) == 0   ? S(S(1) / S(std::pow(10.0, aspect)))
                  : source.choice(8) == 0 ? S(1)
                                          : source.positive_of_size(-aspect, 0);
  S const b = a * ratio;
  // A point (a cos θ, b sin θ), often very near an axis.
  S const tilt = source.coin() ? source.positive_of_size(-17, 0)
                               : S(source.positive_of_size(-1, 0) * source.digits());
  S sine = tilt < S(1) ? tilt : S(1);
  S cosine = sqrt((S(1) - sine) * (S(1) + sine));
  if (source.coin()) std::swap(sine, cosine);
  S x(0), y(0);
  switch (kind % 9) {
    case 0:  // in units of the own axis
      x = a * source.of_size(-2, 2);
      y = b * source.of_size(-2, 2);
      break;
    case 1:  // in units of the longer axis
      x = a * source.of_size(-3, 3);
      y = a * source.of_size(-3, 3);
      break;
    case 2:  // within a few ulp of the curve
      x = source.nudged(a * cosine);
      y = source.nudged(b * sine);
      break;
    case 3:  // on an axis
      x = source.coin() ? a * source.of_size(-1, 1) : source.nudged(a);
      y = source.coin() ? b * source.of_size(-1, 1) : source.nudged(b);
      (source.coin() ? x : y) = S(0);
      break;
    case 4: {  // about the end of the longer axis, in units of a and in units of its curvature b²/a
      S const height = source.coin() ? a : b * ratio;
      x = a + height * source.of_size(-17, 0);
      y = b * source.of_size(source.coin() ? -12 : -2 * aspect, 2);
      break;
    }
    case 5: {  // on the evolute: centres of curvature, its cusps among them
      S const c = a - b;
      x = source.nudged(c * (a + b) / a * cosine * cosine * cosine);
      y = source.nudged(c * (a + b) / b * sine * sine * sine);
      if (source.choice(4) == 0) y = S(0);
      break;
    }
    case 6:  // of unrelated size
      x = source.any_size();
      y = source.any_size();
      break;
    case 7:  // around the distance at which the axes become negligible
      x = a * source.of_size(14, 18);
      y = source.coin() ? a * source.of_size(14, 18) : a * (a / b) * source.of_size(14, 18);
      break;
    default:  // at the corners of the surrounding box
      x = source.nudged(a, 1);
      y = source.coin() ? source.nudged(b, 1) : S(0);
  }
  if (source.coin()) x = -x;
  if (source.coin()) y = -y;
  bool const upright = source.coin();
  p.first = upright ? b : a;
  p.second = upright ? a : b;
  p.x << (upright ? y : x), (upright ? x : y);
  return p;
}

/// first = μ.
template <class S, int N>
hard_point<S, N> hard_cone_point(number_source<S>& source, int kind) {
  using std::sqrt;
  hard_point<S, N> p;
  p.first = source.choice(4) == 0    ? S(1)
            : source.choice(16) == 0 ? S(0)
                                     : source.positive_of_size(-6, 6);
  if (source.choice(16) == 0)
    p.first = source.positive_of_size(-source.decades(), source.decades());
  S const scale = source.positive_of_size(-source.decades() / 2, source.decades() / 2);
  p.x = scale * source.template direction<N>();
  S squares(0);
  for (int i = 1; i < N; ++i) squares += (p.x(i) / scale) * (p.x(i) / scale);
  S const ρ = sqrt(squares) * scale;
  switch (kind % 6) {
    case 0:
      break;
    case 1:  // axis and tangent of unrelated size
      p.x(0) = source.of_size(-source.decades() / 2, source.decades() / 2);
      break;
    case 2:  // within a few ulp of the mantle
      if (p.first > S(0)) p.x(0) = source.nudged(ρ / p.first);
      break;
    case 3:  // within a few ulp of the polar cone: n + μρ cancels
      p.x(0) = source.nudged(-p.first * ρ);
      break;
    case 4:  // near the polar cone by any number of digits
      p.x(0) = -p.first * ρ * (S(1) + source.of_size(-16, 0));
      break;
    default:  // on the axis or in the plane through the apex
      if (source.coin()) {
        p.x.template tail<N - 1>().setZero();
      } else {
        p.x(0) = S(0);
      }
  }
  return p;
}

}  // namespace oracle
