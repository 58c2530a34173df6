// SPDX-License-Identifier: MIT
//
// Laws of the smooth inequality form f(x) ≤ 0 of a block:
//     x ∈ Λ ⟺ f(x) ≤ 0 (away from the boundary),   gradient and Hessian against differences,
//     Σ νᵢ ∇²fᵢ symmetric,   ∇fᵢ(x)ᵀ(z − x) ≤ 0 for z ∈ Λ where fᵢ(x) = 0.
// The last is all that convexity of the set implies: ‖x_t‖² − μ²x_n² ≤ 0, x_n ≥ 0 describes a cone,
// although the first function is not convex.
#pragma once

#include <slant/testing/detail/set_sampler.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace slant::testing::detail {

template <class S>
void check_inequality_sign(set_probe<S> const& probe, typename set_probe<S>::dense const& x,
                           breach_log& log) {
  using dense = typename set_probe<S>::dense;
  using matrix = typename set_probe<S>::matrix;
  dense const f = probe.inequality(x);
  matrix const g = probe.inequality_gradient(x);
  S const size = probe.magnitude(x);
  if (probe.contains(x)) {
    for (index i = 0; i < f.size(); ++i) {
      S const allowed = probe.rounding(size) * (g.col(i).norm() + probe.rounding(size));
      if (!(f[i] <= allowed)) {
        log("f(x) <= 0 in the set", "f = " + text_of(f) + " at x = " + text_of(x));
      }
    }
  } else if (probe.distance(x) > S(1 << 10) * probe.rounding(size)) {
    bool positive = false;
    for (index i = 0; i < f.size(); ++i) positive = positive || f[i] > S(0);
    if (!positive) log("f(x) > 0 outside", "f = " + text_of(f) + " at x = " + text_of(x));
  }
}

template <class S>
void check_inequality_slopes(set_probe<S> const& probe, typename set_probe<S>::dense const& x,
                             typename set_probe<S>::dense const& d,
                             typename set_probe<S>::dense const& ν, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  using matrix = typename set_probe<S>::matrix;
  using std::abs;
  using std::cbrt;
  S const size = slant::norm(x);
  S const length = slant::norm(d);
  if (!(length > S(0)) || !(size > S(0))) return;
  S const ε = std::numeric_limits<S>::epsilon();
  S const t = S(cbrt(ε)) * size / length;
  auto const value = [&](dense const& p) { return dense(probe.inequality(p)); };
  auto const gradient = [&](dense const& p) { return matrix(probe.inequality_gradient(p)); };
  dense const ahead = x + t * d;
  dense const behind = x - t * d;
  dense const f = value(x);
  dense const f_ahead = value(ahead);
  dense const f_behind = value(behind);
  matrix const g = gradient(x);
  matrix const g_ahead = gradient(ahead);
  matrix const g_behind = gradient(behind);
  S const tolerance = S(probe.options.rounding) * S(cbrt(ε)) * S(cbrt(ε));
  for (index i = 0; i < f.size(); ++i) {
    if (!(f_ahead[i] - f_behind[i] - (f_ahead[i] - f_behind[i]) == S(0)))
      continue;  // an infinite bound
    S const scale = S(abs(f[i])) + S(abs(f_ahead[i])) + S(abs(f_behind[i])) +
                    (g.col(i).norm() + g_ahead.col(i).norm()) * size;
    S const error = S(abs(S((f_ahead[i] - f_behind[i]) / S(2) - t * g.col(i).dot(d))));
    if (!(error <= tolerance * S(cbrt(ε)) * scale)) {
      log("gradient of the inequality", "f" + text_of(i) + " at x = " + text_of(x));
    }
  }
  matrix const h = probe.inequality_hessian(x, ν);
  dense const difference = (g_ahead - g_behind).lazyProduct(ν) / S(2);
  S const scale = (g.norm() + g_ahead.norm()) * ν.norm() + h.norm() * size;
  if (!(slant::norm(dense(difference - t * h.lazyProduct(d))) <= tolerance * S(cbrt(ε)) * scale)) {
    log("Hessian of the inequality", "at x = " + text_of(x));
  }
  S const rounding = probe.rounding(h.norm());
  if (!((h - h.transpose()).norm() <= rounding)) {
    log("Hessian is symmetric", "at x = " + text_of(x));
  }
}

/// Gradients on the boundary point out of the set.
template <class S>
void check_outward(set_probe<S> const& probe, typename set_probe<S>::dense const& x,
                   std::vector<typename set_probe<S>::dense> const& members, breach_log& log) {
  using std::abs;
  auto const f = probe.inequality(x);
  auto const g = probe.inequality_gradient(x);
  for (index i = 0; i < f.size(); ++i) {
    if (!(S(abs(f[i])) <= probe.rounding(probe.extent(x)) * g.col(i).norm())) continue;
    for (auto const& z : members) {
      S const slope = g.col(i).dot(z - x);
      S const size = probe.magnitude(x) + slant::norm(z);
      if (!(slope <= probe.rounding(size) * g.col(i).norm())) {
        log("gradient points outwards", "at x = " + text_of(x) + ", z = " + text_of(z));
      }
    }
  }
}

template <class S>
void check_inequality_form(set_probe<S> const& probe,
                           std::vector<typename set_probe<S>::dense> const& points,
                           breach_log& log) {
  using dense = typename set_probe<S>::dense;
  set_sampler<S> sample(probe);
  std::vector<dense> members;
  for (auto const& x : points) members.push_back(probe.project(x));
  for (auto const& x : points) {
    check_inequality_sign(probe, x, log);
    check_outward(probe, probe.project(x), members, log);
    for (int k = 0; k < probe.options.directions; ++k) {
      dense ν(probe.inequalities);
      for (index i = 0; i < ν.size(); ++i) ν[i] = S(1) + sample.number();
      check_inequality_slopes(probe, x, sample.direction(k), ν, log);
    }
  }
}

}  // namespace slant::testing::detail
