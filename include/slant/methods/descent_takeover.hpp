// SPDX-License-Identifier: MIT
//
// A method that converges from everywhere takes over where a faster one fails: KPRGP, until its
// iterate is better than the point of failure by a factor. Since KPRGP converges to the solution
// from every x ∈ Λ [K Theorem 1] this happens after finitely many of its steps; so failures cannot
// follow one another without the residual tending to zero.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/iteration/report.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/kprgp_options.hpp>
#include <slant/methods/kprgp_state.hpp>

#include <optional>
#include <type_traits>
#include <utility>

namespace slant {

/// KPRGP at work on a point s that derives from gradient_point<QP>. Nothing is computed or
/// allocated before the first failure, σ_max included.
template <class QP>
class descent_takeover {
 public:
  using scalar = typename QP::scalar;
  using options = kprgp_options<scalar>;
  /// Refers to the problem; one that forgets its types is as good as a reference.
  using method_type = kprgp<std::conditional_t<forgets_types<QP>, QP, QP const&>>;

  [[nodiscard]] bool at_work() const { return at_work_; }
  /// No longer at work: the problem has changed.
  void leave() { at_work_ = false; }
  /// How often it had to take over.
  [[nodiscard]] index count() const { return count_; }
  /// The state of KPRGP, once there was need for it.
  [[nodiscard]] std::optional<kprgp_state<QP>> const& state() const { return state_; }

  /// Starts at s.x; will hand back a point with ‖r̃‖ ≤ goal. Allocates. Status breakdown if KPRGP
  /// finds A or A x unusable, which it would refuse as input.
  template <class State>
  [[gnu::cold]] status begin(QP const& qp, options o, State& s, scalar const& goal) {
    scalar const σ = state_ ? state_->σ : scalar(0);
    if (state_) o.step_length = state_->step_length;  // σ_max is known by now
    try {
      state_.emplace(method_type{qp, std::move(o)}.start(s.x));
    } catch (bad_input const&) {
      return status::breakdown;
    }
    if (σ > scalar(0)) state_->σ = σ;
    s.work.setup_applications += state_->work.setup_applications;
    s.work.operator_applications += state_->work.operator_applications;
    goal_ = goal;
    at_work_ = true;
    ++count_;
    return follow(qp, s);
  }

  /// r from x, if KPRGP has been updating it; whether it has. One product.
  template <class State>
  [[gnu::cold]] bool refresh(QP const& qp, options const& o, State& s) {
    if (!method_type{qp, o}.refresh(*state_)) return false;
    ++s.work.operator_applications;
    s.status = follow(qp, s);
    return true;
  }

  /// One step of KPRGP.
  template <class State>
  [[gnu::cold]] status step(QP const& qp, options const& o, State& s) {
    index const before = state_->work.operator_applications;
    method_type const method{qp, o};
    method.step(*state_);
    copy(qp, s);
    // r̃ = 0 counts if r was computed from x.
    if (s.reduced_gradient_norm == scalar(0) && method.refresh(*state_)) copy(qp, s);
    s.work.operator_applications += state_->work.operator_applications - before;
    return judged(s);
  }

 private:
  /// s.x, s.r and s.reduced become those of KPRGP's iterate, which is no longer at work if that is
  /// good enough.
  template <class State>
  status follow(QP const& qp, State& s) {
    copy(qp, s);
    return judged(s);
  }
  template <class State>
  void copy(QP const& qp, State& s) {
    vectors::copy(state_->x, s.x);
    vectors::copy(state_->r, s.r);
    // In that of a start far away it might vanish.
    if (s.unit != state_->unit) s.progress.forget_energy();
    s.unit = state_->unit;
    s.size_of_b = state_->size_of_b;
    s.since_refresh = state_->since_refresh;
    s.reduce(qp);
  }
  /// By the reduced gradient of s, whose step length is another one.
  template <class State>
  status judged(State const& s) {
    if (s.reduced_gradient_norm == scalar(0)) return status::converged;
    if (state_->status == status::running) at_work_ = s.reduced_gradient_norm > goal_;
    return state_->status == status::converged ? status::stalled : state_->status;
  }

  std::optional<kprgp_state<QP>> state_;
  scalar goal_{0};
  bool at_work_ = false;
  index count_ = 0;
};

}  // namespace slant
