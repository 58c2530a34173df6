// SPDX-License-Identifier: MIT
//
// The laws of slanting functions, sampled; needs no test framework (laws.hpp does).
//
//     F° bounded near y,     ‖F(y+h) − F(y) − F°(y+h) h‖ = o(‖h‖)          [T Def 1.3, K Def 1]
//     F°(y) linear, of size rows() × cols();   value and apply overwrite;   renewal = new
// What F°(y) promises as an operator is the matter of check_operator_laws(F.slant(y)).
//
// How a limit is sampled: h shrinks from ε^¼ to √ε times its length. The error of prediction,
// relative to ‖h‖, must fall below rounding or at least like t^order. A wrong derivative leaves it
// constant; an F° that blows up shows in its growth. What rounding hides no sample can see: in
// double precision an F° wrong by 1e-7 relative passes, and one wrong only within 1e-8 of a kink.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/testing/breach.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace slant::testing::detail {

// --- slanting samples ----------------------------------------------------------------------------
//
// Points and directions for the check of a slanting function: random ones, and ones chosen to hurt,
// namely coordinate directions, ±y, ±F(y), and kinks found by bisection.

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

/// p + t q.
template <class V>
[[nodiscard]] V moved(V p, scalar_t<V> const& t, V const& q) {
  slant::local(p) += t * slant::local(q);
  return p;
}

/// Not inlined for the reason given at slant::evaluate.
template <class G, class V>
[[gnu::noinline]] void apply_into(G const& g, V const& x, V& y) {
  slant::apply(g, x, y);
}

/// A slanting function as seen through its results only. So that the sampling is compiled once per
/// vector type, not once per function; the speed of an application is no concern here.
template <class V>
struct observed_function {
  index rows = 0;
  index cols = 0;
  ability<std::array<index, 2>(V const& y)> slope_size;        ///< of F°(y)
  ability<void(V const& y, V& to)> evaluate;                   ///< F(y)
  ability<void(V const& y, V const& x, V& to)> apply;          ///< F°(y) x
  ability<V(V const& y, V const& z, V const& x)> apply_again;  ///< F°(y) x, after F°(y) z
  /// F°(y) x by an F°(z) renewed at y; by the same one, renewed at z and after F(y); this F(y). All in
  /// one workspace.
  ability<std::array<V, 3>(V const& z, V const& y, V const& x)> renew;

  [[nodiscard]] V value(V const& y) const {
    V to = slant::like(y, rows);
    evaluate(y, to);
    return to;
  }
  [[nodiscard]] V slope(V const& y, V const& x) const {
    V to = slant::like(x, rows);
    apply(y, x, to);
    return to;
  }
};

/// Refers to f.
template <class V, class F>
[[nodiscard]] observed_function<V> observe(F const& function) {
  observed_function<V> seen;
  seen.rows = function.rows();
  seen.cols = function.cols();
  seen.slope_size = {function, [](F const& f, V const& y) {
                       auto const g = f.slant(y);
                       return std::array<index, 2>{index(g.rows()), index(g.cols())};
                     }};
  seen.evaluate = {function, [](F const& f, V const& y, V& to) {
                     auto w = slant::workspace(f, y);
                     slant::evaluate(f, y, to, w);
                   }};
  seen.apply = {function,
                [](F const& f, V const& y, V const& x, V& to) { apply_into(f.slant(y), x, to); }};
  seen.apply_again = {function, [](F const& f, V const& y, V const& z, V const& x) {
                        V v = slant::like(y, f.rows());
                        auto const g = f.slant(y);
                        apply_into(g, z, v);
                        apply_into(g, x, v);
                        return v;
                      }};
  seen.renew = {function, [](F const& f, V const& z, V const& y, V const& x) {
                  auto w = slant::workspace(f, y);
                  V v = slant::like(y, f.rows());
                  std::array<V, 3> seen_there{v, v, v};
                  auto& [renewed, after_value, value] = seen_there;
                  auto g = f.slant(z);
                  slant::evaluate(f, z, v, w);  // what this leaves in w must not be taken for F(y)
                  slant::update_slant(f, y, g, w);
                  apply_into(g, x, renewed);
                  slant::update_slant(f, z, g, w);
                  slant::evaluate(f, y, value, w);
                  slant::update_slant_after_value(f, y, g, w);
                  apply_into(g, x, after_value);
                  return seen_there;
                }};
  return seen;
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
  V const step = moved(b, S(-1), a);
  V const predicted = f.slope(b, step);
  V const defect = moved(moved(f.value(b), S(-1), value_a), S(-1), predicted);
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
    V a = moved(y, S(-1), h);
    V b = moved(y, S(1), h);
    std::pair<V, V> found{a, b};
    S width(2);
    for (int k = 0; k < std::numeric_limits<S>::digits; ++k, width *= S(3) / S(parts)) {
      std::vector<V> points{a};
      V const whole = moved(b, S(-1), a);
      for (std::size_t i = 1; i < parts; ++i) {
        points.push_back(moved(a, S(i) / S(parts), whole));
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
      if (!(slant::norm(moved(points[worst], S(-1), points[worst + 1])) > S(0))) break;
      found = {points[worst], points[worst + 1]};
      a = points[worst == 0 ? 0 : worst - 1];
      b = points[std::min(parts, worst + 2)];
    }
    return found;
  }

 private:
  /// Error of prediction, the smaller one of both ends: near a singular point one is always bad.
  [[nodiscard]] S surprise(V const& p, V const& q) const {
    S const forward = predict(f_, p, f_.value(p), q).defect;
    S const backward = predict(f_, q, f_.value(q), p).defect;
    return forward < backward ? forward : backward;
  }
  [[nodiscard]] S jump(V const& p, V const& q, V const& h) const {
    return slant::norm(moved(f_.slope(p, h), S(-1), f_.slope(q, h)));
  }

  observed_function<V> const& f_;
};

// --- slanting protocol ---------------------------------------------------------------------------
//
// What can be asked of a slanting function at one point, without limits: sizes, overwriting,
// linearity of F°(y), and renewal of F°(y) in place.

/// Looks at F at y; `elsewhere` is another point, `rounding` a number of ε.
template <class V>
struct slanting_protocol {
  using S = scalar_t<V>;

  observed_function<V> const& f;
  V const& y;
  V const& elsewhere;
  S rounding;
  sampler& sample;
  breach_log& report;

  /// Without the right sizes nothing else can be asked.
  [[nodiscard]] bool sizes() const {
    auto const [rows, cols] = f.slope_size(y);
    index const n = slant::local(y).size();
    bool const fit = rows == f.rows && cols == f.cols && f.cols == n;
    report.expect(fit, "sizes", rows, " x ", cols, " for F of ", f.rows, " values, ", f.cols,
                  " arguments, at y with ", n);
    return fit;
  }

  void overwriting() const {
    V const x = sample(y, f.cols);
    V into_zero = slant::like(y, f.rows);
    V into_nan = into_zero;
    auto const fill = [&] {
      slant::local(into_zero).setZero();
      slant::local(into_nan).setConstant(std::numeric_limits<S>::quiet_NaN());
    };
    fill();
    f.evaluate(y, into_zero);
    f.evaluate(y, into_nan);
    expect("value overwrites", into_zero, into_nan, S(0));
    fill();
    f.apply(y, x, into_zero);
    f.apply(y, x, into_nan);
    expect("slant overwrites", into_zero, into_nan, S(0));
    expect("slant applied again", into_zero, f.apply_again(y, sample(y, f.cols), x), S(0));
  }

  void linear() const {
    V const x = sample(y, f.cols);
    V const z = sample(y, f.cols);
    V const gx = f.slope(y, x);
    V const gz = f.slope(y, z);
    V mixed = x;
    slant::local(mixed) = S(3) / S(4) * slant::local(x) - S(5) / S(4) * slant::local(z);
    V mixed_g = gx;
    slant::local(mixed_g) = S(3) / S(4) * slant::local(gx) - S(5) / S(4) * slant::local(gz);
    expect("slant is linear", f.slope(y, mixed), mixed_g,
           tolerance() * (slant::norm(gx) + slant::norm(gz)));
  }

  void renewal() const {
    for (int k = 0; k < 4; ++k) {
      V const x = sample(y, f.cols);
      V const expected = f.slope(y, x);
      S const bound = tolerance() * slant::norm(expected);
      auto const [renewed, after_value, value] = f.renew(elsewhere, y, x);
      expect("renewed slant = new slant", expected, renewed, bound);
      expect("slant after value = new slant", expected, after_value, bound);
      expect("value with a used workspace", value, f.value(y), S(0));
    }
  }

 private:
  [[nodiscard]] S tolerance() const { return rounding * std::numeric_limits<S>::epsilon(); }
  /// ‖a − b‖ <= bound, and not NaN.
  void expect(char const* law, V const& a, V const& b, S const& bound) const {
    S const size = slant::norm(moved(a, S(-1), b));
    report.expect(size <= bound, law, "difference ", static_cast<double>(size));
  }
};

}  // namespace slant::testing::detail

namespace slant::testing {

// --- slanting breaches ---------------------------------------------------------------------------

/// How thoroughly slanting functions are sampled.
struct slanting_options {
  unsigned seed = 1;    ///< of all random choices
  int directions = 6;   ///< random directions at each point, besides the adversarial ones
  double length = 0;    ///< of the directions, in units of y; 0: ‖y‖, or 1 where y = 0
  double order = 0.25;  ///< slowest decay of the relative error of prediction that is accepted
  double rounding = 16;  ///< accepted rounding error, in units of ε (‖F‖ + L ‖y‖), L = ‖ΔF‖/‖h‖
  int kink_searches = 4;  ///< segments through y that are searched for kinks
};

namespace detail {

/// The limit and the boundedness of F° near y.
template <class V>
struct slanting_limits {
  using S = scalar_t<V>;
  static constexpr std::size_t scales = 6;

  observed_function<V> const& f;
  V const& y;
  S length;
  slanting_options const& options;
  sampler& sample;
  breach_log& report;
  S steepest{};  ///< at y

  void run() {
    auto const directions = directions_at(f, y, length, options.directions, sample);
    auto const value = f.value(y);
    for (auto const& h : directions) {
      bounded(h);
      steepest = std::max<S>(steepest, steepness(y, value, h));
    }
    for (auto const& h : directions) limit(y, h, "at y");
    for (int k = 0; k < options.kink_searches; ++k) kink();
  }

 private:
  static std::string text(S const& value) { return text_of(static_cast<double>(value)); }
  static S epsilon() { return std::numeric_limits<S>::epsilon(); }
  /// Fraction of the direction at scale k: ε^¼ … √ε.
  static S fraction(std::size_t k) {
    using std::pow;
    S const exponent = (S(1) + S(static_cast<int>(k)) / S(static_cast<int>(scales - 1))) / S(4);
    return S(pow(epsilon(), exponent));
  }
  /// Not <=, so that NaN counts as too large.
  [[nodiscard]] static bool exceeds(S const& value, S const& bound) { return !(value <= bound); }

  /// ‖F°‖ does not grow towards y in any direction. Each direction is judged alone: an admissible
  /// large F° where one component stays at its kink must not cover growth elsewhere.
  void bounded(V const& h) {
    V const other = sample(y, f.cols);
    std::array<S, scales> slope{};
    bool grows = true;
    std::string evidence;
    for (std::size_t k = 0; k < scales; ++k) {
      V const p = moved(y, fraction(k), h);
      for (auto const* x : {&h, &other}) {
        S const along = slant::norm(f.slope(p, *x)) / slant::norm(*x);
        if (exceeds(along, slope[k])) slope[k] = along;
      }
      if (k > 0) grows = grows && exceeds(slope[k], slope[k - 1] * S(5) / S(4));
      evidence += (k == 0 ? "norms towards y: " : ", ") + text(slope[k]);
    }
    bool const finite = slope.back() - slope.back() == S(0);
    grows = grows && exceeds(slope.back(), S(8) * slope.front());
    report.expect(finite && !grows, "slant bounded", evidence);
  }

  /// ‖ΔF‖/‖h‖ over the longest step, which rounding hardly touches. So what is taken for rounding
  /// below does not depend on F°, which may be wrong.
  [[nodiscard]] S steepness(V const& at, V const& value, V const& h) const {
    V const p = moved(at, fraction(0), h);
    return S(slant::norm(moved(f.value(p), S(-1), value)) / slant::norm(moved(p, S(-1), at)));
  }

  void limit(V const& at, V const& h, std::string const& where) {
    using std::pow;
    auto const value = f.value(at);
    S const unit = S(options.rounding) * epsilon();
    S const slope = std::max<S>(steepest, steepness(at, value, h));
    S const noise = unit * (slant::norm(value) + slope * slant::norm(at));
    std::array<S, scales> error{};
    bool good = false;
    std::string evidence = where;
    for (std::size_t k = 0; k < scales; ++k) {
      auto const p = predict(f, at, value, moved(at, fraction(k), h));
      error[k] = p.defect;
      bool decays = k > 0;
      for (std::size_t j = 0; j < k; ++j) {
        S const ratio = fraction(k) / fraction(j);
        decays = decays && error[k] <= S(pow(ratio, S(options.order))) * error[j];
      }
      // If a kink is between the last two scales, only the last one can be good.
      if (k + 2 >= scales) good = good || decays || error[k] <= noise / p.step + unit * slope;
      evidence += (k == 0 ? ", |h|: error " : ", ") + text(p.step) + ": " + text(p.defect);
    }
    report.expect(good, "slanting limit", evidence);
  }

  void kink() {
    V h = sample(y, f.cols);
    if (!scale_to(h, S(2) * length)) return;
    auto const [a, b] = kink_search<V>(f)(y, h);
    V opposite = h;
    slant::local(opposite) *= S(-1);
    for (auto const* p : {&a, &b}) {
      limit(*p, h, "at a kink");
      limit(*p, opposite, "at a kink");
    }
  }
};

}  // namespace detail

/// The laws of slanting functions that F is found to break near y; empty if none is. y should be
/// given where it is hardest, on kinks; others are searched for on segments through y.
template <class F, vector V>
  requires slanting_function<F, V>
[[nodiscard]] std::vector<breach> slanting_breaches(F const& f, V const& y,
                                                    slanting_options const& options = {}) {
  using S = scalar_t<V>;
  breach_log report;
  detail::sampler sample(options.seed);
  S const size = slant::norm(y);
  S const length = options.length > 0 ? S(options.length) : size > S(0) ? size : S(1);
  V const elsewhere = detail::moved(y, length, V(sample(y, slant::local(y).size())));
  auto const observed = detail::observe<V>(f);
  detail::slanting_protocol<V> const protocol{observed, y,     elsewhere, S(options.rounding),
                                              sample,   report};
  if (!protocol.sizes()) return report.found();
  protocol.overwriting();
  protocol.linear();
  protocol.renewal();
  detail::slanting_limits<V>{observed, y, length, options, sample, report}.run();
  return report.found();
}

}  // namespace slant::testing
