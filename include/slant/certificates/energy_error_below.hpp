// SPDX-License-Identifier: MIT
//
// The stopping rule on the error itself: ‖x − x*‖_A ≤ tolerance · ‖x*‖_A as far as a certificate
// shows it, for any method.
//
//     auto const certificate = slant::energy_certificate(qp, M);
//     slant::solve(method, x0, slant::energy_error_below(1e-8, certificate) ||
//     slant::at_most(500));
//
// A certificate costs about as much as a step, so it is asked only where it may say yes: when the
// quantity that the method watches anyway (reduced gradient, residual, step; relative; with the
// violation of equality constraints, if there are any) has fallen to the tolerance, and after a no
// when that has fallen by the factor that was missing. A method that ends by itself is judged too:
// `converged` becomes `stalled` where the certificate disagrees, with the error reached in the
// reason.
#pragma once

#include <slant/certificates/energy_error.hpp>
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/step_below.hpp>
#include <slant/iteration/stopping.hpp>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// certificate(x) → energy_error<S>.
template <class Certificate, class V>
concept certifies = requires(Certificate& c, V const& x) {
  { c(x).relative() <= c(x).bound };
};

namespace detail {

/// The quantity that the method watches anyway, relative; 0 if it has none.
template <class S, class State>
[[nodiscard]] S watched_measure(State const& s) {
  auto const ratio = [](auto const& size, auto const& scale) {
    return scale > std::remove_cvref_t<decltype(scale)>(0) ? S(size / scale) : S(0);
  };
  if constexpr (has_reduced_gradient_norm<State> && has_feasibility_norm<State>) {
    return std::max<S>(ratio(s.reduced_gradient_norm, s.gradient_scale),
                       ratio(s.feasibility_norm, s.feasibility_scale));
  } else if constexpr (has_reduced_gradient_norm<State>) {
    return ratio(s.reduced_gradient_norm, s.gradient_scale);
  } else if constexpr (has_residual_norm<State>) {
    return ratio(s.residual_norm, s.residual_scale);
  } else if constexpr (has_step_norm<State>) {
    return ratio(s.step_norm, s.x_norm);
  } else {
    return S(0);
  }
}

/// By what factor that should fall after an error that is too large. Not beyond a hundredth: far
/// from the solution the two have little to do with each other.
template <class S>
[[nodiscard]] S missing_factor(S const& tolerance, S const& error) {
  S const missing = tolerance / error;
  return missing > S(0.01) ? S(missing / S(2)) : S(0.01);
}

}  // namespace detail

/// The rule at the top of this file; the certificate is kept as the library keeps parts. The
/// relative error is that of the last certificate: `error()`.
template <class S, class Certificate>
class energy_error_below : public rule {
 public:
  energy_error_below(S tolerance, Certificate certificate)
      : tolerance_(detail::checked_tolerance(tolerance)),
        threshold_(tolerance),
        certificate_(std::move(certificate)) {}

  template <class State>
    requires certifies<Certificate, std::remove_cvref_t<decltype(std::declval<State>().x)>>
  status operator()(State const& s) {
    S const measure = detail::watched_measure<S>(s);
    bool const at_rest = s.status != status::running;
    if (!at_rest && !(measure <= threshold_)) return status::running;
    if (s.status == status::unbounded) return s.status;  // its direction has been confirmed
    error_ = certificate_(s.x);
    S const relative = error_.relative();
    if (relative <= tolerance_) return status::converged;
    if (at_rest) return s.status == status::converged ? status::stalled : s.status;
    threshold_ = measure * detail::missing_factor<S>(tolerance_, relative);
    return status::running;
  }
  template <class State>
  [[gnu::cold]] std::string reason(State const& s) const {
    if (s.status == status::unbounded) return detail::own_words(s);
    return error_.sentence() + (error_.relative() <= tolerance_ ? ", at most " : "; asked was ") +
           detail::show(tolerance_);
  }
  /// What the last certificate said.
  [[nodiscard]] energy_error<S> const& error() const { return error_; }

 private:
  S tolerance_;
  S threshold_;
  Certificate certificate_;
  energy_error<S> error_{};
};

}  // namespace slant
