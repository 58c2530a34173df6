// SPDX-License-Identifier: MIT
//
// Points and directions for the check of a slanting function: random ones, and ones chosen to hurt,
// namely coordinate directions, ±y, ±F(y), and kinks found by bisection.
#pragma once

#include <slant/concepts/slanting_function.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace slant::testing::detail {

/// Reproducible random vectors of any kind and scalar.
class sampler {
 public:
  explicit sampler(unsigned seed) : engine_(seed) {}

  /// Like y, with n entries uniform in [−1, 1].
  template <class V>
  [[nodiscard]] plain_t<V> operator()(V const& y, index n) {
    using S = scalar_t<V>;
    constexpr int steps = 1 << 20;
    std::uniform_int_distribution<int> integer(-steps, steps);
    auto v = slant::like(y, n);
    for (index i = 0; i < n; ++i) slant::local(v)[i] = S(integer(engine_)) / S(steps);
    return v;
  }

 private:
  std::mt19937 engine_;
};

/// Scales v to the given length; false if v has no direction.
template <class V, class S>
[[nodiscard]] bool scale_to(V& v, S const& length) {
  S const size = slant::norm(v);
  if (!(size > S(0)) || !(size < std::numeric_limits<S>::infinity())) return false;
  slant::local(v) *= S(length / size);
  return true;
}

/// Not inlined for the reason given at slant::evaluate.
template <class G, class V>
[[gnu::noinline]] void apply_into(G const& g, V const& x, V& y) {
  slant::apply(g, x, y);
}

/// G x as a new vector with `rows` entries.
template <class G, class V>
[[nodiscard]] V apply_to(G const& g, V const& x, index rows) {
  auto y = slant::like(x, rows);
  apply_into(g, x, y);
  return y;
}

/// A slanting function as seen through its results only. So that the sampling is compiled once per
/// vector type, not once per function; the speed of an application is no concern here.
template <class V>
struct observed_function {
  index rows = 0;
  index cols = 0;
  std::function<V(V const& y)> value;              ///< F(y)
  std::function<V(V const& y, V const& x)> slope;  ///< F°(y) x
};

/// Refers to f.
template <class V, class F>
[[nodiscard]] observed_function<V> observe(F const& f) {
  return {f.rows(), f.cols(), [&f](V const& y) { return slant::evaluate(f, y); },
          [&f](V const& y, V const& x) { return apply_to(f.slant(y), x, f.rows()); }};
}

/// Directions of the given length at y: `random` random ones, ±e_i for up to eight i, ±y, ±F(y).
template <class V, class S>
[[nodiscard]] std::vector<V> directions_at(observed_function<V> const& f, V const& y,
                                           S const& length, int random, sampler& sample) {
  index const n = slant::local(y).size();
  std::vector<V> found;
  auto const take = [&](V v) {
    if (scale_to(v, length)) found.push_back(std::move(v));
  };
  auto const take_both = [&](V const& v) {
    V opposite = v;
    slant::local(opposite) *= S(-1);
    take(v);
    take(std::move(opposite));
  };
  for (int k = 0; k < random; ++k) take(sample(y, n));
  index const stride = std::max<index>(1, n / 8);
  for (index i = 0; i < n; i += stride) {
    V e = slant::like(y, n);
    slant::local(e).setZero();
    slant::local(e)[i] = S(1);
    take_both(e);
  }
  take_both(y);
  if (f.rows == f.cols) take_both(f.value(y));
  return found;
}

/// F(b) − F(a) − F°(b)(b − a), relative to ‖b − a‖, and ‖F°(b)(b − a)‖/‖b − a‖.
template <class S>
struct prediction {
  S defect;
  S slope;
  S step;  ///< ‖b − a‖
};

template <class V>
[[nodiscard]] auto predict(observed_function<V> const& f, V const& a, V const& value_a, V const& b)
    -> prediction<scalar_t<V>> {
  using S = scalar_t<V>;
  auto step = slant::like(a, slant::local(a).size());
  slant::local(step) = slant::local(b) - slant::local(a);
  auto const predicted = f.slope(b, step);
  auto defect = f.value(b);
  slant::local(defect) -= slant::local(value_a);
  slant::local(defect) -= slant::local(predicted);
  S const length = slant::norm(step);
  return {S(slant::norm(defect) / length), S(slant::norm(predicted) / length), length};
}

/// Searches a segment for the place where F is least linear.
template <class V>
class kink_search {
  using S = scalar_t<V>;
  static constexpr std::size_t parts = 8;

 public:
  explicit kink_search(observed_function<V> const& f) : f_(f) {}

  /// Two neighbouring points of [y − h, y + h] around that place. Each round cuts the segment into
  /// eight parts and keeps the worst one with its neighbours.
  [[nodiscard]] std::pair<V, V> operator()(V const& y, V const& h) const {
    using std::sqrt;
    V a = combination(y, S(-1), h);
    V b = combination(y, S(1), h);
    std::pair<V, V> found{a, b};
    S width(2);
    for (int k = 0; k < std::numeric_limits<S>::digits; ++k, width *= S(3) / S(parts)) {
      std::vector<V> points{a};
      V const whole = combination(b, S(-1), a);
      for (std::size_t i = 1; i < parts; ++i) {
        points.push_back(combination(a, S(i) / S(parts), whole));
      }
      points.push_back(b);
      // Below √ε differences of values are not accurate any more, jumps of F° are.
      bool const wide = width > sqrt(std::numeric_limits<S>::epsilon());
      std::size_t worst = 0;
      S largest(-1);
      for (std::size_t i = 0; i < parts; ++i) {
        S const bend =
            wide ? surprise(points[i], points[i + 1]) : jump(points[i], points[i + 1], h);
        if (bend > largest) {
          largest = bend;
          worst = i;
        }
      }
      if (!(slant::norm(combination(points[worst], S(-1), points[worst + 1])) > S(0))) break;
      found = {points[worst], points[worst + 1]};
      a = points[worst == 0 ? 0 : worst - 1];
      b = points[std::min(parts, worst + 2)];
    }
    return found;
  }

 private:
  /// p + t q.
  [[nodiscard]] static V combination(V p, S const& t, V const& q) {
    slant::local(p) += t * slant::local(q);
    return p;
  }
  /// Error of prediction, the smaller one of both ends: near a singular point one is always bad.
  [[nodiscard]] S surprise(V const& p, V const& q) const {
    S const forward = predict(f_, p, f_.value(p), q).defect;
    S const backward = predict(f_, q, f_.value(q), p).defect;
    return forward < backward ? forward : backward;
  }
  [[nodiscard]] S jump(V const& p, V const& q, V const& h) const {
    return slant::norm(combination(f_.slope(p, h), S(-1), f_.slope(q, h)));
  }

  observed_function<V> const& f_;
};

}  // namespace slant::testing::detail
