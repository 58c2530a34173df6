// SPDX-License-Identifier: MIT
//
// The laws of convex sets, sampled; needs no test framework (laws.hpp does).
// Those of projections, and of each capability the set has: slanting operator, step to the
// boundary, support function, inequality form, states, blocks. parts/projection_breaches.hpp states
// them one by one, with what sampling cannot see.
#pragma once

#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/testing/breach.hpp>
#include <slant/testing/parts/projection_breaches.hpp>
#include <slant/testing/parts/set_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace slant::testing::detail {

// --- product breaches ----------------------------------------------------------------------------
//
// Laws of a product Λ₁ × … × Λ_m:
//     visit numbers the blocks 0, 1, …, block_count − 1 and their places share out all components;
//     projection, slant, membership, step and support are those of the blocks.

template <class C>
void check_places(C const& set, breach_log& log) {
  index const n = slant::dimension_of(set);
  std::vector<int> owners(std::size_t(n), 0);
  index next = 0;
  bool in_order = true;
  set.visit([&](auto const& block, auto const& place) {
    in_order = in_order && place.index() == next && place.size() == slant::dimension_of(block);
    ++next;
    for (index j = 0; j < place.size(); ++j) {
      index const c = place.component(j);
      if (c >= 0 && c < n) ++owners[std::size_t(c)];
    }
  });
  log.expect(in_order && next == slant::block_count(set), "visit numbers the blocks", "visited ",
             next, " of ", slant::block_count(set));
  for (index i = 0; i < n; ++i) {
    log.expect(owners[std::size_t(i)] == 1, "places share out the components", "component ", i,
               " belongs to ", owners[std::size_t(i)], " blocks");
  }
}

/// The same set, block by block.
template <class C, class S>
[[nodiscard]] set_probe<S> blockwise_probe(C const& set, set_probe<S> const& whole) {
  using dense = typename set_probe<S>::dense;
  set_probe<S> probe = whole;
  probe.project = {set, [](C const& s, dense const& x) {
                     dense y = x;
                     s.visit([&](auto const& block, auto const& place) {
                       auto const part = slant::project(block, place.value(x));
                       place.put(y, part);
                     });
                     return y;
                   }};
  probe.contains = {set, [](C const& s, dense const& x) {
                      bool inside = true;
                      s.visit([&](auto const& block, auto const& place) {
                        inside = inside && block.contains(place.value(x));
                      });
                      return inside;
                    }};
  if (whole.slant) {
    probe.slant = {set, [](C const& s, dense const& x) {
                     typename set_probe<S>::matrix g(x.size(), x.size());
                     g.setZero();
                     s.visit([&](auto const& block, auto const& place) {
                       if constexpr (requires { block.slant(place.value(x)); }) {
                         auto const b =
                             matrix_of(block.slant(place.value(x)), place.value(x), place.size());
                         for (index i = 0; i < place.size(); ++i) {
                           for (index j = 0; j < place.size(); ++j) {
                             g(place.component(i), place.component(j)) = b(i, j);
                           }
                         }
                       }
                     });
                     return g;
                   }};
  }
  if (whole.step) {
    probe.step = {
        set, [](C const& s, dense const& x, dense const& d) {
          S step = std::numeric_limits<S>::infinity();
          s.visit([&](auto const& block, auto const& place) {
            if constexpr (requires { block.step_to_boundary(place.value(x), place.value(d)); }) {
              S const one = block.step_to_boundary(place.value(x), place.value(d));
              if (one < step) step = one;
            }
          });
          return step;
        }};
  }
  if (whole.support) {
    probe.support = {set, [](C const& s, dense const& y) {
                       S sum(0);
                       s.visit([&](auto const& block, auto const& place) {
                         if constexpr (requires { block.support(place.value(y)); }) {
                           sum += block.support(place.value(y));
                         }
                       });
                       return sum;
                     }};
  }
  return probe;
}

/// Equal up to the accepted error; equal infinities are equal.
template <class S>
[[nodiscard]] bool agree(S const& a, S const& b, S const& allowed) {
  return a == b || (a - b <= allowed && b - a <= allowed);
}

[[nodiscard]] inline std::string name_of(block_state s) {
  return s == block_state::free ? "free" : s == block_state::sliding ? "sliding" : "fixed";
}

/// The laws of blocks, and that a product is what they are.
template <class S>
struct block_laws : set_laws<S> {
  using typename set_laws<S>::dense;
  using set_laws<S>::probe;
  using set_laws<S>::log;

  void check_blockwise(set_probe<S> const& blocks, dense const& x, dense const& d) const {
    dense const p = probe.project(x);
    S const size = probe.magnitude(x) + slant::norm(p);
    log.expect(slant::norm(dense(blocks.project(x) - p)) <= probe.rounding(size),
               "projection is blockwise", "at x = ", x);
    log.expect(probe.contains(x) == blocks.contains(x), "membership is blockwise", "at x = ", x);
    if (probe.slant) {
      log.expect((probe.slant(x) - blocks.slant(x)).norm() <= probe.rounding(S(1)),
                 "slant is blockwise", "at x = ", x);
    }
    if (probe.step) {
      S const step = blocks.step(p, d);
      log.expect(agree(probe.step(p, d), step, probe.rounding(step)), "step is blockwise",
                 "at x = ", p, ", d = ", d);
    }
    if (probe.support) {
      S const support = blocks.support(d),
              allowed = probe.rounding(slant::norm(d) * size + support);
      log.expect(agree(probe.support(d), support, allowed), "support is blockwise", "at y = ", d);
    }
  }

  // --- state breaches ----------------------------------------------------------------------------
  //
  // Laws of the state of a point x ∈ Λ, one block:
  //     free      in the interior; not for P(y), y outside
  //     sliding   P moves at every point near y, where x = P(y), y outside
  //     fixed     P is constant near some point next to y (y itself may be at a kink of P)
  // and a point with a whole neighbourhood in Λ is free: one that reaches 1/256 of the size of
  // things. So the band around the boundary that is not free may be as wide as that, and must be as
  // wide as the rounding error of P.

  /// x ± ρ e_j all lie in the set: so does the neighbourhood they span.
  [[nodiscard]] bool has_neighbourhood(dense const& x, S const& ρ) const {
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
  [[nodiscard]] bool moves_near(dense const& y, S const& radius, S const& noise,
                                set_sampler<S>& sample) const {
    auto const p = probe.project(y);
    S farthest(0);
    for (int k = 0; k < 4; ++k) {
      auto const q = probe.project(y + radius * sample.box());
      farthest = std::max(farthest, S((p - q).cwiseAbs().maxCoeff()));
    }
    return farthest > noise;
  }

  void check_state(std::vector<dense> const& points) const {
    set_sampler<S> sample(probe);
    for (auto const& y : points) {
      dense const x = probe.project(y);
      block_state const state = probe.state(x);
      auto const expect = [&](bool holds, char const* law) {
        log.expect(holds, law, name_of(state), " at x = P(y), y = ", y);
      };
      S const size = probe.extent(y) + slant::norm(x);
      S const gap = slant::norm(dense(y - x));
      S const noticeable = size / S(1 << 8);
      if (gap <= noticeable) {
        S const ρ = std::max(size, S(probe.options.size)) / S(1 << 8);
        expect(state == block_state::free || !has_neighbourhood(x, ρ), "free in the interior");
        continue;
      }
      expect(state != block_state::free, "not free on the boundary");
      if (state == block_state::free) continue;
      using std::sqrt;
      S const ε = S(4) * std::numeric_limits<S>::epsilon();
      S const small = gap * S(8) * S(sqrt(std::numeric_limits<S>::epsilon()));
      bool always = true;
      bool ever = false;
      for (int k = 0; k < 8 * probe.options.directions; ++k) {
        dense const nearby = y + gap / S(64) * sample.box();
        always = always && moves_near(nearby, small, ε * probe.magnitude(x), sample);
        ever = ever || moves_near(nearby, S(gap / S(64)), ε * probe.extent(x), sample);
      }
      expect(state != block_state::sliding || ever, "sliding leaves motion");
      expect(state != block_state::fixed || !always, "fixed leaves no motion");
    }
  }

  /// All laws but those of products, and those of points at which a single block has to be looked
  /// at: kinks and states.
  void check_set(std::vector<dense> const& points) const {
    this->check_single_points(points);
    this->check_pairs(points);
    if (probe.slant) {
      for (auto const& x : points) this->check_slant_bounds(x);
    }
    if (probe.step || probe.support) this->check_boundary(points);
    if (probe.inequalities > 0 && probe.options.interior) this->check_inequality_form(points);
  }

  void check_block(std::vector<dense> const& points) const {
    if (probe.slant) this->check_slanting_limits(points);
    if (probe.state) check_state(points);
  }

  /// That a product is what its blocks are, and that they are what they say, each at its own scale.
  template <class C>
  void check_product(C const& set, std::vector<dense> const& points) const {
    check_places(set, log);
    auto const blocks = blockwise_probe(set, probe);
    set_sampler<S> sample(probe);
    for (auto const& x : points) {
      for (int k = 0; k < 3; ++k) check_blockwise(blocks, x, sample.direction(k));
    }
    set.visit([&](auto const& block, auto const& place) {
      seen_set const seen{block, place.value(points[0])};
      auto const part = probe_of(seen, probe.options);
      std::vector<dense> parts;
      for (auto const& x : points) parts.push_back(place.value(x));
      block_laws{{part, log}}.check_block(parts);
    });
  }
};

}  // namespace slant::testing::detail

namespace slant::testing {

// --- set breaches --------------------------------------------------------------------------------

/// The laws that a set breaks, with evidence; empty if none was seen to break. `prototype` is any
/// vector of the kind the set takes.
template <class C, vector V>
  requires convex_set<C, V>
[[nodiscard]] std::vector<breach> set_breaches(C const& set, V const& prototype,
                                               set_options const& options = {}) {
  detail::seen_set const seen{set, prototype};
  auto const probe = detail::probe_of(seen, options);
  auto const points = detail::set_sampler(probe).points();
  breach_log log;
  detail::block_laws<scalar_t<V>> const laws{{probe, log}};
  laws.check_set(points);
  if constexpr (has_visit<C>) {
    laws.check_product(set, points);
  } else {
    laws.check_block(points);
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
