// SPDX-License-Identifier: MIT
//
// Laws of a product Λ₁ × … × Λ_m:
//     visit numbers the blocks 0, 1, …, block_count − 1 and their places share out all components;
//     projection, slant, membership, step and support are those of the blocks.
#pragma once

#include <slant/sets/blocks.hpp>
#include <slant/testing/detail/set_sampler.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace slant::testing::detail {

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
  if (!in_order || next != slant::block_count(set)) {
    log("visit numbers the blocks",
        "visited " + text_of(next) + " of " + text_of(slant::block_count(set)));
  }
  for (index i = 0; i < n; ++i) {
    if (owners[std::size_t(i)] != 1) {
      log("places share out the components",
          "component " + text_of(i) + " belongs to " + text_of(owners[std::size_t(i)]) + " blocks");
    }
  }
}

/// The same set, block by block.
template <class C, class S>
[[nodiscard]] set_probe<S> blockwise_probe(C const& set, set_probe<S> const& whole) {
  using dense = typename set_probe<S>::dense;
  set_probe<S> probe = whole;
  probe.project = [&set](dense const& x) {
    dense y = x;
    set.visit([&](auto const& block, auto const& place) {
      auto const part = slant::project(block, place.value(x));
      place.put(y, part);
    });
    return y;
  };
  probe.contains = [&set](dense const& x) {
    bool inside = true;
    set.visit([&](auto const& block, auto const& place) {
      inside = inside && block.contains(place.value(x));
    });
    return inside;
  };
  if (whole.slant) {
    probe.slant = [&set](dense const& x) {
      typename set_probe<S>::matrix g(x.size(), x.size());
      g.setZero();
      set.visit([&](auto const& block, auto const& place) {
        if constexpr (requires { block.slant(place.value(x)); }) {
          auto const b = matrix_of(block.slant(place.value(x)), place.value(x), place.size());
          for (index i = 0; i < place.size(); ++i) {
            for (index j = 0; j < place.size(); ++j) {
              g(place.component(i), place.component(j)) = b(i, j);
            }
          }
        }
      });
      return g;
    };
  }
  if (whole.step) {
    probe.step = [&set](dense const& x, dense const& d) {
      S step = std::numeric_limits<S>::infinity();
      set.visit([&](auto const& block, auto const& place) {
        if constexpr (requires { block.step_to_boundary(place.value(x), place.value(d)); }) {
          S const s = block.step_to_boundary(place.value(x), place.value(d));
          if (s < step) step = s;
        }
      });
      return step;
    };
  }
  if (whole.support) {
    probe.support = [&set](dense const& y) {
      S sum(0);
      set.visit([&](auto const& block, auto const& place) {
        if constexpr (requires { block.support(place.value(y)); }) {
          sum += block.support(place.value(y));
        }
      });
      return sum;
    };
  }
  return probe;
}

/// Equal up to the accepted error; equal infinities are equal.
template <class S>
[[nodiscard]] bool agree(S const& a, S const& b, S const& allowed) {
  return a == b || (a - b <= allowed && b - a <= allowed);
}

template <class S>
void check_blockwise(set_probe<S> const& probe, set_probe<S> const& blocks,
                     typename set_probe<S>::dense const& x, typename set_probe<S>::dense const& d,
                     breach_log& log) {
  using dense = typename set_probe<S>::dense;
  dense const p = probe.project(x);
  S const size = probe.magnitude(x) + slant::norm(p);
  if (!(slant::norm(dense(blocks.project(x) - p)) <= probe.rounding(size))) {
    log("projection is blockwise", "at x = " + text_of(x));
  }
  if (probe.contains(x) != blocks.contains(x)) {
    log("membership is blockwise", "at x = " + text_of(x));
  }
  if (probe.slant && !((probe.slant(x) - blocks.slant(x)).norm() <= probe.rounding(S(1)))) {
    log("slant is blockwise", "at x = " + text_of(x));
  }
  if (probe.step) {
    S const step = blocks.step(p, d);
    if (!agree(probe.step(p, d), step, probe.rounding(step))) {
      log("step is blockwise", "at x = " + text_of(p) + ", d = " + text_of(d));
    }
  }
  if (probe.support) {
    S const support = blocks.support(d);
    if (!agree(probe.support(d), support, probe.rounding(slant::norm(d) * size + support))) {
      log("support is blockwise", "at y = " + text_of(d));
    }
  }
}

}  // namespace slant::testing::detail
