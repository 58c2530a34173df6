// SPDX-License-Identifier: MIT
//
// A stopping rule for methods whose iterates satisfy equality constraints only in the limit. It
// says nothing about optimality: reduced_gradient_below(1e-8) && feasibility_below(1e-8).
#pragma once

#include <slant/iteration/stopping.hpp>

#include <string>

namespace slant {

template <class State>
concept has_feasibility_norm =
    requires(State const& s) { s.feasibility_norm <= s.feasibility_scale; };

/// ‖G x − e‖ ≤ tolerance · scale, for methods whose state has feasibility_norm and
/// feasibility_scale.
template <class S>
class feasibility_below : public rule {
 public:
  explicit feasibility_below(S tolerance) : tolerance_(detail::checked_tolerance(tolerance)) {}
  template <has_feasibility_norm State>
  status operator()(State const& s) const {
    return detail::is_below(s.feasibility_norm, tolerance_, s.feasibility_scale);
  }
  template <has_feasibility_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    return "relative distance from the equality constraints " + detail::show(s.feasibility_norm) +
           " / " + detail::show(s.feasibility_scale) + " is at most " + detail::show(tolerance_);
  }

 private:
  S tolerance_;
};

}  // namespace slant
