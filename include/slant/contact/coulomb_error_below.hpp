// SPDX-License-Identifier: MIT
//
// The stopping rule for contact with Coulomb friction, by whatever method: neither the law nor, in
// the energy norm, Tresca's problem with the slip bounds F λ_ν is violated by more than a
// tolerance.
//
//     contact::coulomb_certificate certificate(problem, factor, K, data, F, 1e-8);
//     auto const check = [&](auto const& λ) { return certificate(λ); };
//     slant::solve(method, x0, contact::coulomb_error_below(1e-8, check) || slant::at_most(100));
//
// Methods over contact::coulomb_cones keep their multipliers contact by contact:
//
//     auto const check = [&](auto const& x) { return certificate(cones.by_directions(x)); };
//
// A residual relative to ‖b‖, b = B K⁻¹f − c, is no such rule: bodies that nearly move rigidly make
// b as large as their motion, and relative to it any forces are a solution. Here it only says when
// to look, as in energy_error_below; a method that ends by itself is judged too, and `converged`
// becomes `stalled` where the check disagrees, with what it has found in the reason.
#pragma once

#include <slant/certificates/energy_error_below.hpp>
#include <slant/contact/coulomb_certificate.hpp>
#include <slant/iteration/stopping.hpp>

#include <string>
#include <utility>

namespace slant::contact {

/// The rule at the top of this file. check(x) → coulomb_error<S>; kept as the library keeps parts.
template <class S, class Check>
class coulomb_error_below : public rule {
 public:
  /// Throws bad_input unless the tolerance is in [0, 1).
  coulomb_error_below(S tolerance, Check check)
      : tolerance_(slant::detail::checked_tolerance(tolerance)),
        threshold_(tolerance),
        check_(std::move(check)) {}

  template <class State>
    requires requires(Check& c, State const& s) { c(s.x).relative() <= c(s.x).law.relative; }
  status operator()(State const& s) {
    S const measure = slant::detail::watched_measure<S>(s);
    bool const at_rest = s.status != status::running;
    if (!at_rest && !(measure <= threshold_)) return status::running;
    bool const is_verdict = s.status == status::converged || s.status == status::stalled;
    if (at_rest && !is_verdict) return s.status;
    error_ = check_(s.x);
    S const relative = error_.relative();
    is_judged_ = true;
    if (relative <= tolerance_) return status::converged;
    if (at_rest) return status::stalled;
    threshold_ = measure * slant::detail::missing_factor<S>(tolerance_, relative);
    return status::running;
  }
  template <class State>
  [[gnu::cold]] std::string reason(State const& s) const {
    if (!is_judged_) return slant::detail::own_words(s);
    return error_.sentence() + (error_.relative() <= tolerance_ ? ", at most " : "; asked was ") +
           slant::detail::show(tolerance_);
  }
  /// What the last look has found.
  [[nodiscard]] coulomb_error<S> const& error() const { return error_; }

 private:
  S tolerance_;
  S threshold_;
  Check check_;
  coulomb_error<S> error_{};
  bool is_judged_ = false;
};

}  // namespace slant::contact
