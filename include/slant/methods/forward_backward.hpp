// SPDX-License-Identifier: MIT
//
// Forward–backward splitting, the proximal gradient method, with extrapolation:
//
//     minimise   q(x) + φ(x),      q(x) = ½ xᵀA x − bᵀx,   r(x) = A x − b
//
//     y  = x + θ (x − x₋),   θ = (t₋ − 1)/t,   t = (1 + √(1 + 4 t₋²))/2
//     x₊ = prox_{αφ}(y − α r(y)),   α ≤ 1/σ_max                     [Beck, Teboulle 2009, FISTA]
//     t  = 1 again  where  (y − x₊)ᵀ(x₊ − x) > 0                    [O'Donoghue, Candès 2015]
//
// r is affine, so r(y) follows from r(x) and r(x₋): one product by A a step. q + φ falls like 1/k²,
// R-linearly where A is definite. With φ the indicator of a set this is the projected gradient
// method. It converges from everywhere and needs nothing of φ but its proximal map; where φ has a
// slanting operator symmetric_newton is faster.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/problems/quadratic_program.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// min ½ xᵀA x − bᵀx + φ(x), A symmetric positive semidefinite, φ with a proximal map or a set.
template <class QP>
concept forward_backward_problem =
    composite_problem<QP> && psd_operator<typename QP::operator_type, typename QP::vector_type>;

/// Options of forward_backward.
template <class S>
struct forward_backward_options {
  std::optional<S> step_length{};  ///< α in (0, 1/σ_max]; not given: see krylov/spectrum.hpp
  bool extrapolate = true;         ///< θ as above; false: θ = 0
  index patience = 1000;  ///< steps in which neither ‖r̃‖ nor q falls that mean stalled

  [[gnu::cold]] void validate() const {
    if (step_length) detail::check_positive("step_length", *step_length);
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
  }
};

/// State of forward_backward: x with its gradient r and r̃ = (x − prox_{αφ}(x − α r))/α.
template <class QP>
struct forward_backward_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  vector_type previous = this->x;           ///< x₋
  vector_type previous_gradient = this->x;  ///< r(x₋), in multiples of unit
  vector_type y = this->x;                  ///< where the last step began
  progress_watch<scalar> progress;
  scalar momentum{1};  ///< t
  index iteration = 0;
  slant::status status = slant::status::running;

  using gradient_point<QP>::gradient_point;

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_of(
        status, {.stalled = "the reduced gradient has not fallen any more: " + this->accuracy()});
  }
};

/// Arguments that lack something end here and are told so; see problems/quadratic_program.hpp.
template <class QP>
class forward_backward
    : public detail::refused_program<QP, forward_backward_state<std::remove_cvref_t<QP>>,
                                     forward_backward_options<detail::program_scalar_t<QP>>> {
  static_assert(detail::composite_demands<std::remove_cvref_t<QP>>::told);

 public:
  using forward_backward::refused_method::refused_method;
};

template <class QP>
forward_backward(QP&&, forward_backward_options<detail::program_scalar_t<QP>> = {})
    -> forward_backward<kept_t<QP>>;

/// The method at the top of this file: solve(forward_backward{qp}, x0, reduced_gradient_below(1e-6)
/// || at_most(5000)). Begins at prox_{αφ}(x0). One application of A a step and, only if no
/// step_length is given, those for the bound of σ_max at the start. Statuses of its own: converged
/// (r̃ = 0), stalled, breakdown.
template <class QP>
  requires forward_backward_problem<std::remove_cvref_t<QP>>
class forward_backward<QP> {
 public:
  using problem = std::remove_cvref_t<QP>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = forward_backward_options<scalar>;
  using state_type = forward_backward_state<problem>;

  /// Throws bad_input for options out of range.
  explicit forward_backward(held<QP> qp, options o = {})
      : qp_(std::move(qp)), options_(std::move(o)) {
    options_.validate();
  }

  /// Throws bad_input if x0 or A x0 is not finite or of the wrong size, or if 1/σ_max is not a
  /// finite number.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start_in_set(x0, qp_.get().b());
    state_type s(qp_.get(), x0);
    static_cast<void>(s.set_step_length(qp_.get(), options_.step_length, scalar(1)));
    if (s.begin(qp_.get(), x0)) s.status = status::converged;
    detail::judge_reduced_gradient(s);
    return s;
  }

  /// One step.
  void step(state_type& s) const {
    if (s.status != status::running) return;
    auto const& qp = qp_.get();
    scalar const θ = next_extrapolation(s);
    // y and z = y − α r(y), in s.y and s.trial.
    vectors::waxpby(scalar(1) + θ, s.x, -θ, s.previous, s.y);
    vectors::waxpby(scalar(1) + θ, s.r, -θ, s.previous_gradient, s.trial);
    vectors::waxpby(-s.step_length * s.unit, s.trial, scalar(1), s.y, s.trial);
    std::swap(s.x, s.previous);
    std::swap(s.r, s.previous_gradient);
    slant::project(s.step_of(qp), slant::local(s.trial), slant::local(s.x));
    vectors::difference(s.y, s.x, s.y);
    vectors::difference(s.x, s.previous, s.trial);
    bool const turns = inner_product(s.y, s.trial) > scalar(0);
    if (s.gradient_and_unit(qp) || turns) s.momentum = scalar(1);
    s.reduce(qp);
    ++s.iteration;
    detail::judge_reduced_gradient(s);
    auto const energy = [&] { return s.energy(qp); };
    if (s.status == status::running &&
        s.progress.stalled(s.iteration, s.reduced_gradient_norm, options_.patience, energy,
                           s.rounding())) {
      s.status = status::stalled;
    }
  }

 private:
  /// θ for this step; t and x₋ become those of the next one.
  scalar next_extrapolation(state_type& s) const {
    using std::sqrt;
    if (!options_.extrapolate) return scalar(0);
    if (s.momentum == scalar(1)) {  // x₋ = x
      vectors::copy(s.x, s.previous);
      vectors::copy(s.r, s.previous_gradient);
    }
    scalar const before = s.momentum;
    s.momentum = (scalar(1) + sqrt(scalar(1) + scalar(4) * before * before)) / scalar(2);
    return (before - scalar(1)) / s.momentum;
  }

  held<QP> qp_;
  options options_;
};

}  // namespace slant
