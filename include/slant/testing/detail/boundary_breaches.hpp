// SPDX-License-Identifier: MIT
//
// Laws of step_to_boundary and support:
//     x + α d ∈ Λ for α a little below the step, x + β d ∉ Λ for β a little above;
//     yᵀz ≤ support(y) for z ∈ Λ, and points P(t y) come arbitrarily close to it;
//     support(0) = 0.
//
// What sampling cannot see: a step that is too short by a few ε^¼ of the size of the set, or by a
// thousandth, and a support that is too large by √(rounding ε), which is 1e-7 in double precision
// with the usual set_options. From y far off, P(y) is known no better.
#pragma once

#include <slant/testing/detail/set_sampler.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace slant::testing::detail {

template <class S>
void check_step(set_probe<S> const& probe, typename set_probe<S>::dense const& x,
                typename set_probe<S>::dense const& d, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  S const step = probe.step(x, d);
  std::string const where = " at x = " + text_of(x) + ", d = " + text_of(d);
  std::string const claim = "step " + text_of(step);
  if (!(step >= S(0))) {
    log("step_to_boundary >= 0", claim + where);
    return;
  }
  S const length = slant::norm(d);
  bool const finite = step < std::numeric_limits<S>::infinity();
  if (!(length > S(0))) {
    if (finite) log("step_to_boundary is infinite for d = 0", claim + where);
    return;
  }
  S size = probe.extent(x);
  if (!(size > S(0))) size = S(probe.options.size);
  auto const outside_by = [&](S const& α) { return probe.distance(x + α * d); };
  auto const accepted = [&](S const& α) { return probe.rounding(probe.magnitude(x) + α * length); };
  if (!finite) {
    for (S const& α : {size / length, S(1000) * size / length}) {
      if (!(outside_by(α) <= accepted(α))) log("step_to_boundary stays inside", claim + where);
    }
    return;
  }
  if (!(outside_by(step) <= accepted(step))) log("step_to_boundary stays inside", claim + where);
  // A ray that stays close to the boundary for ever leaves the set very far off or not at all.
  if (!(S(1000) * step * length < size / probe.rounding(S(1)))) return;
  using std::sqrt;
  // Where d is tangential the set is left by the square of the way only.
  S const margin = S(8) * S(sqrt(S(sqrt(std::numeric_limits<S>::epsilon()))));
  S const beyond = S(1001) / S(1000) * step + margin * size / length;
  dense const far = x + beyond * d;
  if (probe.contains(far)) log("step_to_boundary reaches the boundary", claim + where);
  if (!probe.early_step) return;
  for (S const& enough : {S(step / S(2)), S(S(2) * step + size / length)}) {
    S const early = probe.early_step(x, d, enough);
    if (!(early >= step) || (early < enough) != (step < enough)) {
      log("step_to_boundary with early exit", text_of(early) + " instead of " + claim + where);
    }
  }
}

template <class S>
void check_support(set_probe<S> const& probe, typename set_probe<S>::dense const& y,
                   std::vector<typename set_probe<S>::dense> const& members, set_sampler<S>& sample,
                   breach_log& log) {
  using dense = typename set_probe<S>::dense;
  S const value = probe.support(y);
  std::string const claim = "support " + text_of(value) + " at y = " + text_of(y);
  S const length = slant::norm(y);
  if (!(length > S(0))) {
    if (!(value == S(0))) log("support(0) = 0", claim);
    return;
  }
  for (auto const& z : members) {
    if (!(y.dot(z) <= value + probe.rounding(length * probe.magnitude(z)))) {
      log("support is a bound", claim + ", z = " + text_of(z));
    }
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
    if (!(missing <= allowed)) log("support is attained", claim + ", missing " + text_of(missing));
  } else {
    // Where an unbounded set begins to be unbounded in the direction y is a matter of rounding, so
    // directions nearby may show it as well.
    S const reach = S(1000) * (slant::norm(far(S(1000) * unit)) + unit);
    S const farthest = slant::norm(far(reach)) + unit;
    bool unbounded = false;
    for (int k = 0; k < 24 && !unbounded; ++k) {
      dense const v = y + S(k == 0 ? 0 : 1) / S(8) * length * sample.box();
      auto const along = [&](S const& t) { return S(v.dot(probe.project((t / length) * v))); };
      S const gain = along(S(1000) * reach) - along(reach);
      unbounded = gain > length * farthest / S(100);
    }
    if (!unbounded) log("support is infinite only if unbounded", claim);
  }
}

/// Step and support, for directions of all kinds.
template <class S>
void check_boundary(set_probe<S> const& probe,
                    std::vector<typename set_probe<S>::dense> const& points, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  set_sampler<S> sample(probe);
  std::vector<dense> members;
  for (auto const& x : points) members.push_back(probe.project(x));
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<dense> directions{points[i] - members[i], members[i] - points[i],
                                  dense::Zero(probe.size)};
    for (int k = 0; k < probe.options.directions; ++k) directions.push_back(sample.direction(k));
    for (auto const& d : directions) {
      if (probe.step) check_step(probe, members[i], d, log);
      if (probe.support) check_support(probe, d, members, sample, log);
    }
  }
}

}  // namespace slant::testing::detail
