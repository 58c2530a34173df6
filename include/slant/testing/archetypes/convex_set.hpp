// SPDX-License-Identifier: MIT
//
// The least that is a convex set: a size, a projection in place and a test of membership, for one
// type of vector. No block structure, no static dimension, no capability. Its points are the
// vectors without negative entries.
#pragma once

#include <slant/concepts/convex_set.hpp>
#include <slant/testing/archetypes/vector.hpp>

#include <algorithm>
#include <limits>

namespace slant::testing::archetype {

template <class V>
class basic_convex_set {
 public:
  explicit basic_convex_set(index n) : size_(n) {}

  [[nodiscard]] index size() const { return size_; }
  void project(V const& x, V& y) const {
    slant::local(y) = slant::local(x).cwiseMax(scalar_t<V>(0));
  }
  [[nodiscard]] bool contains(V const& x) const {
    return (slant::local(x).array() >= scalar_t<V>(0)).all();
  }

 private:
  index size_;
};

/// The same with states: what an active-set method asks for, with one block.
template <class V>
class basic_separable_set : public basic_convex_set<V> {
 public:
  using basic_convex_set<V>::basic_convex_set;

  [[nodiscard]] block_state state(V const& x) const {
    auto const positive = (slant::local(x).array() > scalar_t<V>(0)).count();
    return positive == this->size() ? block_state::free
           : positive > 0           ? block_state::sliding
                                    : block_state::fixed;
  }
};

/// The same with steps to the boundary: what KPRGP asks for.
template <class V>
class basic_active_set_set : public basic_separable_set<V> {
 public:
  using basic_separable_set<V>::basic_separable_set;

  [[nodiscard]] scalar_t<V> step_to_boundary(V const& x, V const& d) const {
    auto step = std::numeric_limits<scalar_t<V>>::infinity();
    for (index i = 0; i < this->size(); ++i) {
      auto const& from = slant::local(x);
      auto const& along = slant::local(d);
      if (along(i) < scalar_t<V>(0)) step = std::min(step, -from(i) / along(i));
    }
    return step;
  }
};

using convex_set = basic_convex_set<vector>;
using separable_set = basic_separable_set<vector>;
using active_set_set = basic_active_set_set<vector>;

static_assert(slant::convex_set<convex_set, vector>);
static_assert(!slant::separable_set<convex_set, vector>);
static_assert(slant::separable_set<separable_set, vector>);
static_assert(!has_slant<separable_set, vector> && !has_visit<separable_set>);
static_assert(!has_step_to_boundary<separable_set, vector>);
static_assert(has_step_to_boundary<active_set_set, vector>);

}  // namespace slant::testing::archetype
