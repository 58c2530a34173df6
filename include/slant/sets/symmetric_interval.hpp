// SPDX-License-Identifier: MIT
//
// The interval |x| <= g: the friction set of a node of a plane problem, with one parameter like the
// disc of a spatial one.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/sets/interval.hpp>

namespace slant {

/// { x ∈ R : −g <= x <= g }, an interval in all but its parameter. g = 0 and g = ∞ are legal.
template <scalar S = double>
class symmetric_interval : public interval<S> {
 public:
  symmetric_interval() = default;

  /// @throws bad_input if g is NaN or negative.
  explicit symmetric_interval(S const& g) : interval<S>(S(-checked(g)), g) {}

  [[nodiscard]] symmetric_interval with(S const& g) const { return symmetric_interval(g); }
  [[nodiscard]] S const& radius() const { return this->upper(); }

 private:
  [[nodiscard]] static S const& checked(S const& g) {
    if (!(g >= S(0))) throw bad_input("radius", detail::show(g), "a number >= 0");
    return g;
  }
};

}  // namespace slant
