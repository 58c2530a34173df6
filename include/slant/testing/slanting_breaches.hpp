// SPDX-License-Identifier: MIT
//
// The laws of slanting functions, sampled; needs no test framework (slanting_laws.hpp does).
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
#include <slant/testing/breach.hpp>
#include <slant/testing/detail/slanting_protocol.hpp>
#include <slant/testing/detail/slanting_samples.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace slant::testing {

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
class slanting_limits {
  using S = scalar_t<V>;
  static constexpr std::size_t scales = 6;

 public:
  slanting_limits(observed_function<V> const& f, V const& y, S const& length,
                  slanting_options const& options, sampler& sample, breach_log& report)
      : f_(f), y_(y), length_(length), options_(options), sample_(sample), report_(report) {}

  void run() {
    auto const directions = directions_at(f_, y_, length_, options_.directions, sample_);
    auto const value = f_.value(y_);
    for (auto const& h : directions) {
      bounded(h);
      steepness_ = std::max<S>(steepness_, steepness(y_, value, h));
    }
    for (auto const& h : directions) limit(y_, h, "at y");
    for (int k = 0; k < options_.kink_searches; ++k) kink();
  }

 private:
  static std::string text(S const& value) {
    return slant::detail::show(static_cast<double>(value));
  }
  static S epsilon() { return std::numeric_limits<S>::epsilon(); }
  /// Fraction of the direction at scale k: ε^¼ … √ε.
  static S fraction(std::size_t k) {
    using std::pow;
    S const exponent = (S(1) + S(static_cast<int>(k)) / S(static_cast<int>(scales - 1))) / S(4);
    return S(pow(epsilon(), exponent));
  }
  [[nodiscard]] V moved(V const& p, V const& h, S const& t) const {
    V q = p;
    slant::local(q) += t * slant::local(h);
    return q;
  }
  /// Not <=, so that NaN counts as too large.
  [[nodiscard]] static bool exceeds(S const& value, S const& bound) { return !(value <= bound); }

  /// ‖F°‖ does not grow towards y in any direction. Each direction is judged alone: an admissible
  /// large F° where one component stays at its kink must not cover growth elsewhere.
  void bounded(V const& h) {
    V const other = sample_(y_, f_.cols);
    std::array<S, scales> slope{};
    bool grows = true;
    std::string evidence;
    for (std::size_t k = 0; k < scales; ++k) {
      V const p = moved(y_, h, fraction(k));
      for (auto const* x : {&h, &other}) {
        S const along = slant::norm(f_.slope(p, *x)) / slant::norm(*x);
        if (exceeds(along, slope[k])) slope[k] = along;
      }
      if (k > 0) grows = grows && exceeds(slope[k], slope[k - 1] * S(5) / S(4));
      evidence += (k == 0 ? "norms towards y: " : ", ") + text(slope[k]);
    }
    bool const finite = slope.back() - slope.back() == S(0);
    grows = grows && exceeds(slope.back(), S(8) * slope.front());
    if (!finite || grows) report_("slant bounded", evidence);
  }

  /// ‖ΔF‖/‖h‖ over the longest step, which rounding hardly touches. So what is taken for rounding
  /// below does not depend on F°, which may be wrong.
  [[nodiscard]] S steepness(V const& y, V const& value, V const& h) const {
    V const p = moved(y, h, fraction(0));
    V change = f_.value(p);
    slant::local(change) -= slant::local(value);
    V step = p;
    slant::local(step) -= slant::local(y);
    return S(slant::norm(change) / slant::norm(step));
  }

  void limit(V const& y, V const& h, std::string const& where) {
    using std::pow;
    auto const value = f_.value(y);
    S const unit = S(options_.rounding) * epsilon();
    S const slope = std::max<S>(steepness_, steepness(y, value, h));
    S const noise = unit * (slant::norm(value) + slope * slant::norm(y));
    std::array<S, scales> error{};
    bool good = false;
    std::string evidence = where;
    for (std::size_t k = 0; k < scales; ++k) {
      auto const p = predict(f_, y, value, moved(y, h, fraction(k)));
      error[k] = p.defect;
      bool decays = k > 0;
      for (std::size_t j = 0; j < k; ++j) {
        S const ratio = fraction(k) / fraction(j);
        decays = decays && error[k] <= S(pow(ratio, S(options_.order))) * error[j];
      }
      // If a kink is between the last two scales, only the last one can be good.
      if (k + 2 >= scales) good = good || decays || error[k] <= noise / p.step + unit * slope;
      evidence += (k == 0 ? ", |h|: error " : ", ") + text(p.step) + ": " + text(p.defect);
    }
    if (!good) report_("slanting limit", evidence);
  }

  void kink() {
    V h = sample_(y_, f_.cols);
    if (!scale_to(h, S(2) * length_)) return;
    auto const [a, b] = kink_search<V>(f_)(y_, h);
    V opposite = h;
    slant::local(opposite) *= S(-1);
    for (auto const* p : {&a, &b}) {
      limit(*p, h, "at a kink");
      limit(*p, opposite, "at a kink");
    }
  }

  observed_function<V> const& f_;
  V const& y_;
  S length_;
  slanting_options options_;
  sampler& sample_;
  breach_log& report_;
  S steepness_{};  ///< the largest one at y
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
  V elsewhere = sample(y, slant::local(y).size());
  slant::local(elsewhere) = slant::local(y) + length * slant::local(elsewhere);
  detail::slanting_protocol<F, V> const protocol(f, y, elsewhere, S(options.rounding), sample,
                                                 report);
  if (!protocol.sizes()) return report.found();
  protocol.overwriting();
  protocol.linear();
  protocol.renewal();
  auto const observed = detail::observe<V>(f);
  detail::slanting_limits<V>(observed, y, length, options, sample, report).run();
  return report.found();
}

}  // namespace slant::testing
