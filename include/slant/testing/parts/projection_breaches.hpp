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

#include <slant/testing/parts/set_sampler.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
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

/// Checks of what a set says of itself, at points that are handed in.
template <class S>
struct set_laws {
  using dense = typename set_probe<S>::dense;
  using matrix = typename set_probe<S>::matrix;

  set_probe<S> const& probe;
  breach_log& log;

  void check_single_points(std::vector<dense> const& points) const {
    for (auto const& x : points) {
      dense const p = probe.project(x);
      S const allowed = probe.rounding(probe.magnitude(x) + slant::norm(p));
      S const again = slant::norm(dense(probe.project(p) - p)), way = slant::norm(dense(p - x));
      bool const inside = probe.contains(x), everywhere = probe.unconstrained;
      log.expect(again <= allowed, "idempotence", "P(P(x)) is off P(x) by ", again, " at x = ", x);
      log.expect(probe.contains(p), "contains(P(x))", "false at x = ", x);
      log.expect(!inside || way <= allowed, "contains(x) implies P(x) = x", "x is moved by ", way,
                 " at x = ", x);
      log.expect(!everywhere || way <= allowed, "whole_space implies P(x) = x", "x is moved by ",
                 way, " at x = ", x);
      log.expect(!everywhere || inside, "whole_space implies contains(x)", "false at x = ", x);
      log.expect(probe.project_in_place(x) == p, "in place", "differs at x = ", x);
      log.expect(probe.project_over_nan(x) == p, "overwriting", "differs at x = ", x);
    }
  }

  void check_pairs(std::vector<dense> const& points) const {
    set_sampler<S> sample(probe);
    for (auto const& x : points) {
      dense const p = probe.project(x);
      S const size = probe.magnitude(x) + slant::norm(p);
      auto const check = [&](dense const& y) {
        dense const q = probe.project(y);
        S const scale = size + slant::norm(y) + slant::norm(q);
        // Each of x, y, P(x), P(y) carries a rounding error relative to its size.
        S const allowed =
            probe.rounding(scale) *
            (slant::norm(dense(x - y)) + slant::norm(dense(p - q)) + probe.rounding(scale));
        log.expect((p - q).squaredNorm() <= (x - y).dot(p - q) + allowed, "nonexpansiveness",
                   "x = ", x, ", y = ", y);
        S const product = (x - p).dot(q - p);
        S const slack = probe.rounding(scale) * (slant::norm(dense(x - p)) +
                                                 slant::norm(dense(q - p)) + probe.rounding(scale));
        log.expect(product <= slack, "variational inequality", "(x - P(x)).(z - P(x)) = ", product,
                   " at x = ", x, ", z = ", q);
      };
      for (int k = 0; k < 6; ++k) check(points[std::size_t(sample.below(index(points.size())))]);
      for (S const& step : {S(1) / S(10), S(1) / S(1 << 14)}) {
        check(x + step * size * sample.direction(0));
        check(p + step * (x - p));
      }
    }
  }

  // --- slant breaches ----------------------------------------------------------------------------
  //
  // Laws of the slanting operator of a projection:
  //     G = Gᵀ,   0 ⪯ G ⪯ I,   ‖P(y+h) − P(y) − G(y+h) h‖ = o(‖h‖),   renewal in place = new.
  //
  // The limit is sampled at kinks, which are found by bisection for the largest jump of G between
  // two points, and along random, coordinate, normal and crossing directions. h shrinks from ε^¼ to
  // √ε times the size of y; the error relative to ‖h‖ must fall like ‖h‖^¼ at least, or the error
  // reach rounding. A G that is wrong within √ε of a kink only, or by less than √ε, passes;
  // boundaries curved more strongly than 1/(√ε ‖y‖) cannot be sampled.

  void check_slant_bounds(dense const& x) const {
    matrix const g = probe.slant(x);
    S const ε = S(64) * S(int(g.rows()) + 1) * std::numeric_limits<S>::epsilon();
    log.expect((g - g.transpose()).cwiseAbs().maxCoeff() <= ε, "slant is symmetric", "at x = ", x);
    // For symmetric G:  0 ⪯ G ⪯ I  ⟺  G − G² ⪰ 0.
    matrix excess = (g + g.transpose()) / S(2) - g.transpose().lazyProduct(g);
    excess.diagonal().array() += ε;
    log.expect(is_definite(excess), "0 <= slant <= I",
               "an eigenvalue of G - G^2 is negative at x = ", x);
    log.expect(!probe.renewed_slant || probe.renewed_slant(x) == g, "slant in place",
               "differs at x = ", x);
  }

  /// The limit along one direction.
  void check_slanting_limit(dense const& y, dense const& direction) const {
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
    log.expect(samples.vanishes(S(4) * probe.rounding(probe.magnitude(y))), "slanting limit",
               evidence, " at y = ", y, ", h ~ ", direction);
  }

  /// Moves a and b to neighbouring points between which G jumps, by bisection; false if it is
  /// smooth.
  [[nodiscard]] bool bisect_for_kink(dense& a, dense& b) const {
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

  void check_slanting_limits(std::vector<dense> const& points) const {
    set_sampler<S> sample(probe);
    for (auto const& x : points) {
      dense const p = probe.project(x);
      for (auto const& y : {x, p}) {
        for (int k = 0; k < probe.options.directions; ++k) {
          check_slanting_limit(y, sample.direction(k));
        }
        check_slanting_limit(y, dense(x - p));
        check_slanting_limit(y, dense(p - x));
      }
      // Not the points themselves: a segment along a boundary has its kinks everywhere.
      dense a = x + probe.extent(x) / S(64) * sample.box();
      dense b = points[std::size_t(sample.below(index(points.size())))];
      b += probe.extent(b) / S(64) * sample.box();
      dense const across = b - a;
      if (!bisect_for_kink(a, b)) continue;
      check_slant_bounds(a);
      for (auto const& y : {a, b}) {
        check_slanting_limit(y, across);
        check_slanting_limit(y, dense(S(-1) * across));
        check_slanting_limit(y, sample.direction(0));
      }
    }
  }

  // --- boundary breaches -------------------------------------------------------------------------
  //
  // Laws of step_to_boundary and support:
  //     x + α d ∈ Λ for α a little below the step, x + β d ∉ Λ for β a little above;
  //     yᵀz ≤ support(y) for z ∈ Λ, and points P(t y) come arbitrarily close to it;
  //     support(0) = 0.
  //
  // What sampling cannot see: a step that is too short by a few ε^¼ of the size of the set, or by a
  // thousandth, and a support that is too large by √(rounding ε), which is 1e-7 in double precision
  // with the usual set_options. From y far off, P(y) is known no better.

  void check_step(dense const& x, dense const& d) const {
    S const step = probe.step(x, d);
    auto const expect = [&](bool holds, char const* law) {
      log.expect(holds, law, "step ", step, " at x = ", x, ", d = ", d);
    };
    expect(step >= S(0), "step_to_boundary >= 0");
    if (!(step >= S(0))) return;
    S const length = slant::norm(d);
    bool const finite = step < std::numeric_limits<S>::infinity();
    if (!(length > S(0))) {
      expect(!finite, "step_to_boundary is infinite for d = 0");
      return;
    }
    S size = probe.extent(x);
    if (!(size > S(0))) size = S(probe.options.size);
    auto const expect_inside = [&](S const& α) {
      S const accepted = probe.rounding(probe.magnitude(x) + α * length);
      expect(probe.distance(x + α * d) <= accepted, "step_to_boundary stays inside");
    };
    if (!finite) {
      expect_inside(size / length);
      expect_inside(S(1000) * size / length);
      return;
    }
    expect_inside(step);
    // A ray that stays close to the boundary for ever leaves the set very far off or not at all.
    if (!(S(1000) * step * length < size / probe.rounding(S(1)))) return;
    using std::sqrt;
    // Where d is tangential the set is left by the square of the way only.
    S const margin = S(8) * S(sqrt(S(sqrt(std::numeric_limits<S>::epsilon()))));
    S const beyond = S(1001) / S(1000) * step + margin * size / length;
    dense const far = x + beyond * d;
    expect(!probe.contains(far), "step_to_boundary reaches the boundary");
    if (!probe.early_step) return;
    for (S const& enough : {S(step / S(2)), S(S(2) * step + size / length)}) {
      S const early = probe.early_step(x, d, enough);
      log.expect(early >= step && (early < enough) == (step < enough),
                 "step_to_boundary with early exit", early, " instead of step ", step,
                 " at x = ", x, ", d = ", d);
    }
  }

  void check_support(dense const& y, std::vector<dense> const& members,
                     set_sampler<S>& sample) const {
    S const value = probe.support(y);
    auto const expect = [&](bool holds, char const* law, auto const&... more) {
      log.expect(holds, law, "support ", value, " at y = ", y, more...);
    };
    S const length = slant::norm(y);
    if (!(length > S(0))) {
      expect(value == S(0), "support(0) = 0");
      return;
    }
    for (auto const& z : members) {
      expect(y.dot(z) <= value + probe.rounding(length * probe.magnitude(z)), "support is a bound",
             ", z = ", z);
    }
    // P(t y) maximises yᵀz − ‖z‖²/(2 t): it falls short of the support by at most ‖z*‖²/(2 t).
    auto const far = [&](S const& t) { return dense(probe.project((t / length) * y)); };
    S const unit = probe.magnitude(dense::Zero(y.size()));
    if (value < std::numeric_limits<S>::infinity()) {
      using std::sqrt;
      // From this many radii away, rounding of P(t y) is as large as what t y falls short by.
      S const radii = S(1) / S(sqrt(probe.rounding(S(1))));
      S radius = slant::norm(far(S(1000) * unit)) + unit;
      for (int k = 0; k < 3; ++k) radius = slant::norm(far(radii * radius)) + unit;
      S const reach = radii * radius;
      S const missing = value - y.dot(far(reach));
      S const allowed = length * radius * (radius / reach) + probe.rounding(reach * length);
      expect(missing <= allowed, "support is attained", ", missing ", missing);
    } else {
      // Where an unbounded set begins to be unbounded in the direction y is a matter of rounding,
      // so directions nearby may show it as well.
      S const reach = S(1000) * (slant::norm(far(S(1000) * unit)) + unit);
      S const farthest = slant::norm(far(reach)) + unit;
      bool unbounded = false;
      for (int k = 0; k < 24 && !unbounded; ++k) {
        dense const v = y + S(k == 0 ? 0 : 1) / S(8) * length * sample.box();
        auto const along = [&](S const& t) { return S(v.dot(probe.project((t / length) * v))); };
        S const gain = along(S(1000) * reach) - along(reach);
        unbounded = gain > length * farthest / S(100);
      }
      expect(unbounded, "support is infinite only if unbounded");
    }
  }

  /// Step and support, for directions of all kinds.
  void check_boundary(std::vector<dense> const& points) const {
    set_sampler<S> sample(probe);
    std::vector<dense> members;
    for (auto const& x : points) members.push_back(probe.project(x));
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::vector<dense> directions{points[i] - members[i], members[i] - points[i],
                                    dense::Zero(probe.size)};
      for (int k = 0; k < probe.options.directions; ++k) directions.push_back(sample.direction(k));
      for (auto const& d : directions) {
        if (probe.step) check_step(members[i], d);
        if (probe.support) check_support(d, members, sample);
      }
    }
  }

  // --- inequality breaches -----------------------------------------------------------------------
  //
  // Laws of the smooth inequality form f(x) ≤ 0 of a block:
  //     x ∈ Λ ⟺ f(x) ≤ 0 (away from the boundary),   gradient and Hessian against differences,
  //     Σ νᵢ ∇²fᵢ symmetric,   ∇fᵢ(x)ᵀ(z − x) ≤ 0 for z ∈ Λ where fᵢ(x) = 0.
  // The last is all that convexity of the set implies: ‖x_t‖² − μ²x_n² ≤ 0, x_n ≥ 0 describes a
  // cone, although the first function is not convex.

  void check_inequality_sign(dense const& x) const {
    dense const f = probe.inequality(x);
    matrix const g = probe.inequality_gradient(x);
    S const size = probe.magnitude(x);
    if (probe.contains(x)) {
      for (index i = 0; i < f.size(); ++i) {
        S const allowed = probe.rounding(size) * (g.col(i).norm() + probe.rounding(size));
        log.expect(f[i] <= allowed, "f(x) <= 0 in the set", "f = ", f, " at x = ", x);
      }
    } else if (probe.distance(x) > S(1 << 10) * probe.rounding(size)) {
      bool positive = false;
      for (index i = 0; i < f.size(); ++i) positive = positive || f[i] > S(0);
      log.expect(positive, "f(x) > 0 outside", "f = ", f, " at x = ", x);
    }
  }

  void check_inequality_slopes(dense const& x, dense const& d, dense const& ν) const {
    using std::abs;
    using std::cbrt;
    S const size = slant::norm(x);
    S const length = slant::norm(d);
    if (!(length > S(0)) || !(size > S(0))) return;
    S const ε = std::numeric_limits<S>::epsilon();
    S const t = S(cbrt(ε)) * size / length;
    dense const ahead = x + t * d, behind = x - t * d;
    dense const f = probe.inequality(x);
    dense const f_ahead = probe.inequality(ahead), f_behind = probe.inequality(behind);
    matrix const g = probe.inequality_gradient(x);
    matrix const g_ahead = probe.inequality_gradient(ahead);
    matrix const g_behind = probe.inequality_gradient(behind);
    S const tolerance = S(probe.options.rounding) * S(cbrt(ε)) * S(cbrt(ε));
    for (index i = 0; i < f.size(); ++i) {
      if (!(f_ahead[i] - f_behind[i] - (f_ahead[i] - f_behind[i]) == S(0)))
        continue;  // an infinite bound
      S const scale = S(abs(f[i])) + S(abs(f_ahead[i])) + S(abs(f_behind[i])) +
                      (g.col(i).norm() + g_ahead.col(i).norm()) * size;
      S const error = S(abs(S((f_ahead[i] - f_behind[i]) / S(2) - t * g.col(i).dot(d))));
      log.expect(error <= tolerance * S(cbrt(ε)) * scale, "gradient of the inequality", "f", i,
                 " at x = ", x);
    }
    matrix const h = probe.inequality_hessian(x, ν);
    dense const difference = (g_ahead - g_behind).lazyProduct(ν) / S(2);
    S const scale = (g.norm() + g_ahead.norm()) * ν.norm() + h.norm() * size;
    S const error = slant::norm(dense(difference - t * h.lazyProduct(d)));
    log.expect(error <= tolerance * S(cbrt(ε)) * scale, "Hessian of the inequality", "at x = ", x);
    log.expect((h - h.transpose()).norm() <= probe.rounding(h.norm()), "Hessian is symmetric",
               "at x = ", x);
  }

  /// Gradients on the boundary point out of the set.
  void check_outward(dense const& x, std::vector<dense> const& members) const {
    using std::abs;
    auto const f = probe.inequality(x);
    auto const g = probe.inequality_gradient(x);
    for (index i = 0; i < f.size(); ++i) {
      if (!(S(abs(f[i])) <= probe.rounding(probe.extent(x)) * g.col(i).norm())) continue;
      for (auto const& z : members) {
        S const slope = g.col(i).dot(z - x);
        S const size = probe.magnitude(x) + slant::norm(z);
        log.expect(slope <= probe.rounding(size) * g.col(i).norm(), "gradient points outwards",
                   "at x = ", x, ", z = ", z);
      }
    }
  }

  void check_inequality_form(std::vector<dense> const& points) const {
    set_sampler<S> sample(probe);
    std::vector<dense> members;
    for (auto const& x : points) members.push_back(probe.project(x));
    for (auto const& x : points) {
      check_inequality_sign(x);
      check_outward(probe.project(x), members);
      for (int k = 0; k < probe.options.directions; ++k) {
        dense ν(probe.inequalities);
        for (index i = 0; i < ν.size(); ++i) ν[i] = S(1) + sample.number();
        check_inequality_slopes(x, sample.direction(k), ν);
      }
    }
  }
};

}  // namespace slant::testing::detail
