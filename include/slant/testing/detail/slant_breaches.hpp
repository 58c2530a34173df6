// SPDX-License-Identifier: MIT
//
// Laws of the slanting operator of a projection:
//     G = Gᵀ,   0 ⪯ G ⪯ I,   ‖P(y+h) − P(y) − G(y+h) h‖ = o(‖h‖),   renewal in place = new.
//
// The limit is sampled at kinks, which are found by bisection for the largest jump of G between two
// points, and along random, coordinate, normal and crossing directions. h shrinks from ε^¼ to √ε
// times the size of y; the error relative to ‖h‖ must fall like ‖h‖^¼ at least, or the error reach
// rounding. A G that is wrong within √ε of a kink only, or by less than √ε, passes; boundaries
// curved more strongly than 1/(√ε ‖y‖) cannot be sampled.
#pragma once

#include <slant/testing/detail/set_sampler.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace slant::testing::detail {

/// Cholesky's elimination meets positive pivots only. (Eigen's would double the time to compile.)
template <class M>
[[nodiscard]] bool is_definite(M m) {
  for (index k = 0; k < m.rows(); ++k) {
    if (!(m(k, k) > 0)) return false;
    for (index i = k + 1; i < m.rows(); ++i) {
      auto const factor = m(i, k) / m(k, k);
      for (index j = k + 1; j <= i; ++j) m(i, j) -= factor * m(j, k);
    }
  }
  return true;
}

template <class S>
void check_slant_bounds(set_probe<S> const& probe, typename set_probe<S>::dense const& x,
                        breach_log& log) {
  using matrix = typename set_probe<S>::matrix;
  matrix const g = probe.slant(x);
  S const ε = S(64) * S(int(g.rows()) + 1) * std::numeric_limits<S>::epsilon();
  if (!((g - g.transpose()).cwiseAbs().maxCoeff() <= ε)) {
    log("slant is symmetric", "at x = " + text_of(x));
  }
  // For symmetric G:  0 ⪯ G ⪯ I  ⟺  G − G² ⪰ 0.
  matrix excess = (g + g.transpose()) / S(2) - g.transpose().lazyProduct(g);
  excess.diagonal().array() += ε;
  if (!is_definite(excess)) {
    log("0 <= slant <= I", "an eigenvalue of G - G^2 is negative at x = " + text_of(x));
  }
  if (probe.renewed_slant && !(probe.renewed_slant(x) == g)) {
    log("slant in place", "differs at x = " + text_of(x));
  }
}

/// Lengths of h, longest first, and ‖P(y+h) − P(y) − G(y+h) h‖ for each.
template <class S>
struct limit_samples {
  static constexpr std::size_t count = 6;
  std::array<S, count> length{};
  std::array<S, count> error{};

  /// error/length vanishes with the length, or is rounding of the given size.
  [[nodiscard]] bool vanishes(S const& rounding) const {
    using std::pow;
    // An error that does not depend on h: y is at some distance of that order from a kink, and even
    // shorter h would be needed. The error of a wrong G is proportional to h.
    bool plateau = false;
    for (std::size_t k = count - 3; k < count; ++k) {
      plateau = plateau || error[k] >= S(4) / S(5) * error[k - 1];
      S const decay = S(pow(S(length[k] / length[0]), S(S(5) / S(4))));
      if (error[k] <= rounding || error[k] <= decay * error[0]) return true;
    }
    return plateau;
  }
};

/// The limit along one direction.
template <class S>
void check_slanting_limit(set_probe<S> const& probe, typename set_probe<S>::dense const& y,
                          typename set_probe<S>::dense const& direction, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  using std::pow;
  S const length = slant::norm(direction);
  if (!(length > S(0))) return;
  S size = probe.extent(y);
  if (!(size > S(0))) size = S(probe.options.size);
  dense const p = probe.project(y);
  limit_samples<S> samples;
  std::string evidence;
  for (std::size_t k = 0; k < samples.count; ++k) {
    S const exponent = S(1) / S(4) + S(int(k)) / S(4 * int(samples.count - 1));
    S const fraction = S(pow(std::numeric_limits<S>::epsilon(), exponent));
    dense const moved = y + (fraction * size / length) * direction;
    dense const h = moved - y;
    samples.length[k] = slant::norm(h);
    samples.error[k] =
        slant::norm(dense(probe.project(moved) - p - probe.slant(moved).lazyProduct(h)));
    evidence += (k == 0 ? "|h|, error: " : "; ") + text_of(samples.length[k]) + ", " +
                text_of(samples.error[k]);
  }
  if (!samples.vanishes(S(4) * probe.rounding(probe.magnitude(y)))) {
    log("slanting limit", evidence + " at y = " + text_of(y) + ", h ~ " + text_of(direction));
  }
}

/// Moves a and b to neighbouring points between which G jumps, by bisection; false if it is smooth.
template <class S>
[[nodiscard]] bool bisect_for_kink(set_probe<S> const& probe, typename set_probe<S>::dense& a,
                                   typename set_probe<S>::dense& b) {
  using dense = typename set_probe<S>::dense;
  auto at_a = probe.slant(a);
  auto at_b = probe.slant(b);
  for (int k = 0; k < 4 * std::numeric_limits<S>::digits; ++k) {
    dense const middle = (a + b) / S(2);
    auto const at_middle = probe.slant(middle);
    bool const left = (at_middle - at_a).squaredNorm() >= (at_b - at_middle).squaredNorm();
    (left ? b : a) = middle;
    (left ? at_b : at_a) = at_middle;
  }
  // Without a jump the search ends anywhere, perhaps close to a kink but not at one.
  using std::sqrt;
  return (at_b - at_a).norm() > S(sqrt(std::numeric_limits<S>::epsilon()));
}

template <class S>
void check_slanting_limits(set_probe<S> const& probe,
                           std::vector<typename set_probe<S>::dense> const& points,
                           breach_log& log) {
  using dense = typename set_probe<S>::dense;
  set_sampler<S> sample(probe);
  for (auto const& x : points) {
    dense const p = probe.project(x);
    for (auto const& y : {x, p}) {
      for (int k = 0; k < probe.options.directions; ++k) {
        check_slanting_limit(probe, y, sample.direction(k), log);
      }
      check_slanting_limit(probe, y, dense(x - p), log);
      check_slanting_limit(probe, y, dense(p - x), log);
    }
    // Not the points themselves: a segment along a boundary has its kinks everywhere.
    dense a = x + probe.extent(x) / S(64) * sample.box();
    dense b = points[std::size_t(sample.below(index(points.size())))];
    b += probe.extent(b) / S(64) * sample.box();
    dense const across = b - a;
    if (!bisect_for_kink(probe, a, b)) continue;
    check_slant_bounds(probe, a, log);
    for (auto const& y : {a, b}) {
      check_slanting_limit(probe, y, across, log);
      check_slanting_limit(probe, y, dense(S(-1) * across), log);
      check_slanting_limit(probe, y, sample.direction(0), log);
    }
  }
}

}  // namespace slant::testing::detail
