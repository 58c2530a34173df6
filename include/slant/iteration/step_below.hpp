// SPDX-License-Identifier: MIT
//
// A stopping rule for methods of Newton's kind: their steps are as small as the error was before
// them. ‖dy‖ says more about y than ‖F(y)‖ where F is badly scaled, and less where the steps are
// small for another reason.
#pragma once

#include <slant/iteration/stopping.hpp>

#include <string>
#include <type_traits>

namespace slant {

template <class State>
concept has_step_norm = requires(State const& s) { s.step_norm <= s.x_norm; };

/// ‖y⁺ − y‖ ≤ tolerance · (‖y⁺‖ + offset), for methods whose state has step_norm (that of a whole
/// step, infinite before the first) and x_norm. Without an offset as in [K §3.2]; [T (SSNM)] has 1,
/// which has the unit of y and makes small solutions look exact.
template <class S>
class step_below : public rule {
 public:
  explicit step_below(S tolerance, S offset = S(0))
      : tolerance_(detail::checked_tolerance(tolerance)), offset_(offset) {
    if (!(offset >= S(0)) || !detail::is_finite(offset)) {
      throw bad_input("offset", detail::show(offset), "a number >= 0, in units of y");
    }
  }
  template <has_step_norm State>
  status operator()(State const& s) const {
    using N = std::remove_cvref_t<decltype(s.x_norm)>;
    return detail::is_below(s.step_norm, tolerance_, N(s.x_norm + N(offset_)));
  }
  template <has_step_norm State>
  [[gnu::cold]] std::string reason(State const& s) const {
    std::string text = "relative step " + detail::show(s.step_norm) + " / ";
    text += offset_ == S(0) ? detail::show(s.x_norm)
                            : "(" + detail::show(s.x_norm) + " + " + detail::show(offset_) + ")";
    return text + " is at most " + detail::show(tolerance_);
  }

 private:
  S tolerance_;
  S offset_;
};

}  // namespace slant
