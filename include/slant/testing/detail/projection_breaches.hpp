// SPDX-License-Identifier: MIT
//
// Laws of every projection:
//     P(P(x)) = P(x),   contains(P(x)),   contains(x) ⇒ P(x) = x,
//     ‖P(x) − P(y)‖² ≤ ⟨x − y, P(x) − P(y)⟩  (so P is nonexpansive),
//     ⟨x − P(x), z − P(x)⟩ ≤ 0 for z ∈ Λ,
//     P(x) = x and contains(x) for every x, if the set says that it is the whole space,
//     project(x, x) in place and project(x, y) into a y full of NaN give the same as P(x).
// contains(P(x)) must hold exactly, whatever rounding left of P(x); what else `contains` accepts
// may be off the set by the rounding that set_options allows.
#pragma once

#include <slant/testing/detail/set_sampler.hpp>

#include <vector>

namespace slant::testing::detail {

template <class S>
void check_single_points(set_probe<S> const& probe,
                         std::vector<typename set_probe<S>::dense> const& points, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  for (auto const& x : points) {
    dense const p = probe.project(x);
    S const allowed = probe.rounding(probe.magnitude(x) + slant::norm(p));
    if (!(slant::norm(dense(probe.project(p) - p)) <= allowed)) {
      log("idempotence", "P(P(x)) is off P(x) by " +
                             text_of(slant::norm(dense(probe.project(p) - p))) +
                             " at x = " + text_of(x));
    }
    if (!probe.contains(p)) log("contains(P(x))", "false at x = " + text_of(x));
    if (probe.contains(x) && !(slant::norm(dense(p - x)) <= allowed)) {
      log("contains(x) implies P(x) = x",
          "x is moved by " + text_of(slant::norm(dense(p - x))) + " at x = " + text_of(x));
    }
    if (probe.unconstrained && !(slant::norm(dense(p - x)) <= allowed)) {
      log("whole_space implies P(x) = x",
          "x is moved by " + text_of(slant::norm(dense(p - x))) + " at x = " + text_of(x));
    }
    if (probe.unconstrained && !probe.contains(x)) {
      log("whole_space implies contains(x)", "false at x = " + text_of(x));
    }
    if (!(probe.project_in_place(x) == p)) log("in place", "differs at x = " + text_of(x));
    if (!(probe.project_over_nan(x) == p)) log("overwriting", "differs at x = " + text_of(x));
  }
}

template <class S>
void check_pairs(set_probe<S> const& probe, std::vector<typename set_probe<S>::dense> const& points,
                 breach_log& log) {
  using dense = typename set_probe<S>::dense;
  set_sampler<S> sample(probe);
  for (auto const& x : points) {
    dense const p = probe.project(x);
    S const size = probe.magnitude(x) + slant::norm(p);
    auto const check = [&](dense const& y) {
      dense const q = probe.project(y);
      S const scale = size + slant::norm(y) + slant::norm(q);
      // Each of x, y, P(x), P(y) carries a rounding error relative to its size.
      S const allowed = probe.rounding(scale) * (slant::norm(dense(x - y)) +
                                                 slant::norm(dense(p - q)) + probe.rounding(scale));
      if (!((p - q).squaredNorm() <= (x - y).dot(p - q) + allowed)) {
        log("nonexpansiveness", "x = " + text_of(x) + ", y = " + text_of(y));
      }
      S const product = (x - p).dot(q - p);
      S const slack = probe.rounding(scale) * (slant::norm(dense(x - p)) +
                                               slant::norm(dense(q - p)) + probe.rounding(scale));
      if (!(product <= slack)) {
        log("variational inequality", "(x - P(x)).(z - P(x)) = " + text_of(product) +
                                          " at x = " + text_of(x) + ", z = " + text_of(q));
      }
    };
    for (int k = 0; k < 6; ++k) check(points[std::size_t(sample.below(index(points.size())))]);
    for (S const& step : {S(1) / S(10), S(1) / S(1 << 14)}) {
      check(x + step * size * sample.direction(0));
      check(p + step * (x - p));
    }
  }
}

}  // namespace slant::testing::detail
