// SPDX-License-Identifier: MIT
//
// The laws of convex sets, sampled; needs no test framework (set_laws.hpp does).
//
//     P(P(x)) = P(x),   contains(P(x)),   ‖P(x) − P(y)‖² ≤ ⟨x − y, P(x) − P(y)⟩,
//     ⟨x − P(x), z − P(x)⟩ ≤ 0 for z ∈ Λ,
// and of each capability the set has: slanting operator, step to the boundary, support function,
// inequality form, states, blocks. The files in detail/ state them one by one, with what sampling
// cannot see.
#pragma once

#include <slant/sets/blocks.hpp>
#include <slant/testing/breach.hpp>
#include <slant/testing/detail/boundary_breaches.hpp>
#include <slant/testing/detail/inequality_breaches.hpp>
#include <slant/testing/detail/product_breaches.hpp>
#include <slant/testing/detail/projection_breaches.hpp>
#include <slant/testing/detail/set_sampler.hpp>
#include <slant/testing/detail/slant_breaches.hpp>
#include <slant/testing/detail/state_breaches.hpp>

#include <vector>

namespace slant::testing {

namespace detail {

/// All laws but those of products, and those of points at which a single block has to be looked at:
/// kinks and states.
template <class S>
void check_set(set_probe<S> const& probe, std::vector<typename set_probe<S>::dense> const& points,
               breach_log& log) {
  check_single_points(probe, points, log);
  check_pairs(probe, points, log);
  if (probe.slant) {
    for (auto const& x : points) check_slant_bounds(probe, x, log);
  }
  if (probe.step || probe.support) check_boundary(probe, points, log);
  if (probe.inequalities > 0 && probe.options.interior) check_inequality_form(probe, points, log);
}

template <class S>
void check_block(set_probe<S> const& probe, std::vector<typename set_probe<S>::dense> const& points,
                 breach_log& log) {
  if (probe.slant) check_slanting_limits(probe, points, log);
  if (probe.state) check_state(probe, points, log);
}

/// That a product is what its blocks are, and that they are what they say, each at its own scale.
template <class C, class S>
void check_product(C const& set, set_probe<S> const& probe,
                   std::vector<typename set_probe<S>::dense> const& points, breach_log& log) {
  using dense = typename set_probe<S>::dense;
  check_places(set, log);
  auto const blocks = blockwise_probe(set, probe);
  set_sampler<S> sample(probe);
  for (auto const& x : points) {
    for (int k = 0; k < 3; ++k) check_blockwise(probe, blocks, x, sample.direction(k), log);
  }
  set.visit([&](auto const& block, auto const& place) {
    auto const part = probe_of(block, place.value(points[0]), probe.options);
    std::vector<dense> parts;
    for (auto const& x : points) parts.push_back(place.value(x));
    check_block(part, parts, log);
  });
}

}  // namespace detail

/// The laws that a set breaks, with evidence; empty if none was seen to break. `prototype` is any
/// vector of the kind the set takes.
template <class C, vector V>
  requires convex_set<C, V>
[[nodiscard]] std::vector<breach> set_breaches(C const& set, V const& prototype,
                                               set_options const& options = {}) {
  auto const probe = detail::probe_of(set, prototype, options);
  auto const points = detail::set_sampler(probe).points();
  breach_log log;
  detail::check_set(probe, points, log);
  if constexpr (has_visit<C>) {
    detail::check_product(set, probe, points, log);
  } else {
    detail::check_block(probe, points, log);
  }
  return log.found();
}

/// The same for a set of Eigen vectors of the scalar it names (double if it names none).
template <class C>
  requires convex_set<C, point_t<C>>
[[nodiscard]] std::vector<breach> set_breaches(C const& set, set_options const& options = {}) {
  return slant::testing::set_breaches(set, point_t<C>(point_t<C>::Zero(slant::dimension_of(set))),
                                      options);
}

}  // namespace slant::testing
