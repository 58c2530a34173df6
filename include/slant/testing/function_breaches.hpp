// SPDX-License-Identifier: MIT
//
// The laws of functions with a proximal map (concepts/proximable.hpp), sampled; needs no test
// framework (laws.hpp does). With x = prox_{ρφ}(z), v = (z − x)/ρ:
//
//     φ(w) ≥ φ(x) + vᵀ(w − x),    φ(x) + φ*(v) = vᵀx,    φ*(v) ≥ vᵀw − φ(w),
//     ‖x − y‖² ≤ ⟨z − w, x − y⟩ for y = prox_{ρφ}(w),
//     G = Gᵀ, 0 ⪯ G ⪯ I, the slanting limit, states of blocks; a product is its blocks.
#pragma once

#include <slant/concepts/proximable.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/testing/breach.hpp>
#include <slant/testing/parts/projection_breaches.hpp>
#include <slant/testing/parts/set_sampler.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace slant::testing {

namespace detail {

/// A function and the ρ of its proximal map.
template <class F, class S>
struct seen_function {
  F const& φ;
  S const& ρ;
};

template <class F, class S>
void check_subgradients(F const& φ, S const& ρ, set_probe<S> const& probe,
                        std::vector<typename set_probe<S>::dense> const& points, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  using point = point_t<F>;
  auto const value = [&φ](dense const& x) {
    point p = point::Zero(x.size());
    copy_entries(x, p);
    return S(slant::function_value(φ, p));
  };
  std::size_t finite = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    dense const& z = points[k];
    dense const x = probe.project(z), v = (z - x) / ρ;
    S const at_x = value(x);
    std::string const where = " at z = " + text_of(z) + ", rho = " + text_of(ρ);
    if (!(at_x < std::numeric_limits<S>::infinity())) {
      log("prox is in the domain", where);
      continue;
    }
    S const size = probe.magnitude(z) + slant::norm(x);
    // Of φ(x), and of v, each to the rounding of what they are made of.
    auto const allowed = [&](dense const& w) {
      S const reach = slant::norm(dense(w - x)) + size;
      return probe.rounding(size) / ρ * reach + probe.rounding(S(std::abs(at_x)));
    };
    S conjugate = std::numeric_limits<S>::infinity();
    if constexpr (has_conjugate<F, point>) {
      point p = point::Zero(v.size());
      copy_entries(v, p);
      conjugate = S(φ.conjugate(p));
    }
    if (conjugate < std::numeric_limits<S>::infinity()) {
      ++finite;
      S const product = v.dot(x), room = allowed(x) + probe.rounding(conjugate);
      log.expect(std::abs(at_x + conjugate - product) <= room, "Fenchel-Young", at_x, " + ",
                 conjugate, " is not ", product, where);
    }
    for (std::size_t j = 1; j <= 6; ++j) {
      dense const& other = points[(k + 7 * j) % points.size()];
      for (dense const& w : {other, probe.project(other), dense((other + x) / S(2))}) {
        S const there = value(w);
        if (!(there < std::numeric_limits<S>::infinity())) continue;
        S const slack = allowed(w) + probe.rounding(S(std::abs(there)));
        log.expect(there >= at_x + v.dot(w - x) - slack, "subgradient inequality", "w = ", w,
                   where);
        log.expect(conjugate >= v.dot(w) - there - slack, "conjugate is a bound", "w = ", w, where);
      }
      dense const y = probe.project(other);
      S const both = probe.rounding(size + probe.magnitude(other) + slant::norm(y));
      S const room = both * (slant::norm(dense(z - other)) + slant::norm(dense(x - y)) + both);
      log.expect((x - y).squaredNorm() <= (z - other).dot(x - y) + room, "firmly nonexpansive",
                 "w = ", other, where);
    }
    log.expect(probe.project_in_place(z) == x, "in place", where);
    log.expect(probe.project_over_nan(z) == x, "overwriting", where);
  }
  // Rounding of v takes it out of the domain here and there, in a product more often.
  std::size_t const share = has_visit<F> ? 1 : 3;
  log.expect(!has_conjugate<F, point> || 4 * finite >= share * points.size(),
             "conjugate is finite at subgradients", "rho = ", ρ);
}

template <class S>
void check_prox_states(set_probe<S> const& probe,
                       std::vector<typename set_probe<S>::dense> const& points, breach_log& log) {
  for (auto const& z : points) {
    auto const g = probe.slant(z);
    auto const s = probe.state(z);
    bool const nothing = (g.array() == S(0)).all(), all = g.isIdentity(S(0));
    log.expect(s == block_state::fixed ? nothing : s != block_state::free || all, "state and slant",
               "at z = ", z);
  }
}

template <class F, class S>
void check_function_blocks(F const& φ, S const& ρ, set_probe<S> const& probe,
                           std::vector<typename set_probe<S>::dense> const& points,
                           breach_log& log) {
  using dense = typename set_probe<S>::dense;
  for (auto const& z : points) {
    dense x = z;
    φ.visit([&](auto const& block, auto const& place) {
      auto const part = slant::prox(block, ρ, place.value(z));
      place.put(x, part);
    });
    log.expect(slant::norm(dense(x - probe.project(z))) <= probe.rounding(probe.magnitude(z)),
               "prox is blockwise", "at z = ", z);
  }
}

}  // namespace detail

/// The laws that a function breaks, with evidence; empty if none was seen to break. The function
/// takes Eigen vectors of the scalar it names (double if it names none).
template <class F>
  requires function_part<F>
[[nodiscard]] std::vector<breach> function_breaches(F const& φ, set_options const& options = {}) {
  using S = set_scalar_t<F>;
  using point = point_t<F>;
  breach_log log;
  for (S const& ρ : {S(1), S(1) / S(8), S(12)}) {
    // The proximal map for one ρ, as if it were a projection.
    auto const step = slant::at_step(φ, ρ);
    detail::seen_set const seen{step, point(point::Zero(slant::dimension_of(φ)))};
    auto probe = detail::probe_of(seen, options);
    detail::seen_function<F, S> const function{φ, ρ};
    if constexpr (has_prox_state<F, point>) {
      probe.state = {function, [](auto const& f, typename detail::set_probe<S>::dense const& z) {
                       point p = point::Zero(z.size());
                       detail::copy_entries(z, p);
                       return f.φ.state(f.ρ, p);
                     }};
    }
    auto const points = detail::set_sampler(probe).points();
    detail::check_subgradients(φ, ρ, probe, points, log);
    if (probe.slant) {
      detail::set_laws<S> const laws{probe, log};
      for (auto const& z : points) laws.check_slant_bounds(z);
      laws.check_slanting_limits(points);
      if (probe.state) detail::check_prox_states(probe, points, log);
    }
    if constexpr (has_visit<F>) detail::check_function_blocks(φ, ρ, probe, points, log);
  }
  return log.found();
}

}  // namespace slant::testing
