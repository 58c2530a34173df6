// SPDX-License-Identifier: MIT
//
// Laws of the state of a point x ∈ Λ, one block:
//     free      in the interior; not for P(y), y outside
//     sliding   P moves at every point near y, where x = P(y), y outside
//     fixed     P is constant near some point next to y (y itself may be at a kink of P)
// and a point with a whole neighbourhood in Λ is free: one that reaches 1/256 of the size of
// things. So the band around the boundary that is not free may be as wide as that, and must be as
// wide as the rounding error of P.
#pragma once

#include <slant/testing/detail/set_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace slant::testing::detail {

[[nodiscard]] inline std::string name_of(block_state s) {
  return s == block_state::free ? "free" : s == block_state::sliding ? "sliding" : "fixed";
}

/// x ± ρ e_j all lie in the set: so does the neighbourhood they span.
template <class S>
[[nodiscard]] bool has_neighbourhood(set_probe<S> const& probe,
                                     typename set_probe<S>::dense const& x, S const& ρ) {
  for (index j = 0; j < x.size(); ++j) {
    auto moved = x;
    moved[j] = x[j] + ρ;
    if (!probe.contains(moved)) return false;
    moved[j] = x[j] - ρ;
    if (!probe.contains(moved)) return false;
  }
  return true;
}

/// P is not constant, up to noise, within a distance of about `radius` of y.
template <class S>
[[nodiscard]] bool moves_near(set_probe<S> const& probe, typename set_probe<S>::dense const& y,
                              S const& radius, S const& noise, set_sampler<S>& sample) {
  auto const p = probe.project(y);
  S farthest(0);
  for (int k = 0; k < 4; ++k) {
    auto const q = probe.project(y + radius * sample.box());
    farthest = std::max(farthest, S((p - q).cwiseAbs().maxCoeff()));
  }
  return farthest > noise;
}

template <class S>
void check_state(set_probe<S> const& probe, std::vector<typename set_probe<S>::dense> const& points,
                 breach_log& log) {
  using dense = typename set_probe<S>::dense;
  set_sampler<S> sample(probe);
  for (auto const& y : points) {
    dense const x = probe.project(y);
    block_state const state = probe.state(x);
    std::string const claim = name_of(state) + " at x = P(y), y = " + text_of(y);
    S const size = probe.extent(y) + slant::norm(x);
    S const gap = slant::norm(dense(y - x));
    S const noticeable = size / S(1 << 8);
    if (gap <= noticeable) {
      S const ρ = std::max(size, S(probe.options.size)) / S(1 << 8);
      if (state != block_state::free && has_neighbourhood(probe, x, ρ)) {
        log("free in the interior", claim);
      }
      continue;
    }
    if (state == block_state::free) {
      log("not free on the boundary", claim);
      continue;
    }
    using std::sqrt;
    S const ε = S(4) * std::numeric_limits<S>::epsilon();
    S const small = gap * S(8) * S(sqrt(std::numeric_limits<S>::epsilon()));
    bool always = true;
    bool ever = false;
    for (int k = 0; k < 8 * probe.options.directions; ++k) {
      dense const nearby = y + gap / S(64) * sample.box();
      always = always && moves_near(probe, nearby, small, ε * probe.magnitude(x), sample);
      ever = ever || moves_near(probe, nearby, S(gap / S(64)), ε * probe.extent(x), sample);
    }
    if (state == block_state::sliding && !ever) log("sliding leaves motion", claim);
    if (state == block_state::fixed && always) log("fixed leaves no motion", claim);
  }
}

}  // namespace slant::testing::detail
