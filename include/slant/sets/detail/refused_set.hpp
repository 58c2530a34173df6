// SPDX-License-Identifier: MIT
//
// What a factory of sets returns after a static_assert has refused its arguments: a set that can do
// everything, so that one mistake is one complaint. Nothing of it is defined.
#pragma once

#include <slant/concepts/convex_set.hpp>

namespace slant::detail {

struct refused_set {
  index size() const;
  void project(auto const& x, auto& y) const;
  bool contains(auto const& x) const;
  block_state state(auto const& x) const;
  template <class X>
  scalar_t<X> step_to_boundary(X const& x, auto const& d) const;
  template <class Y>
  scalar_t<Y> support(Y const& y) const;
};

}  // namespace slant::detail
