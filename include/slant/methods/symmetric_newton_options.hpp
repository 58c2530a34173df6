// SPDX-License-Identifier: MIT
//
// Options of symmetric_newton, with a set or with another convex function, and the step lengths
// that they mean.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/krylov/spectrum.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/operators/identity.hpp>
#include <slant/sets/curved_face.hpp>

#include <optional>
#include <type_traits>

namespace slant {

/// Options of symmetric_newton; the defaults are those of README's tables.
template <scalar S = double>
struct symmetric_newton_options {
  /// ρ in x − P_Λ(x − ρ r), in units of 1/A; none: step_factor / mean(diag A).
  std::optional<S> step_length{};
  /// > 0, of the order 1. An undamped step leaves r = 0 on blocks that were free and x on its bound
  /// where it was fixed, so that signs decide what is free next and not ρ; damped steps mix the
  /// two. Measured on bricks (k = 4 … 16): ¼ and ½ alike, 1 up to a quarter more products. On the
  /// wire from zero, with A⁻¹ as preconditioner, 2 needs half of the steps that ½ needs.
  S step_factor = S(0.5);
  mean_diagonal_options mean_diagonal{};  ///< how mean(diag A) is estimated, if it is needed
  /// Inner accuracy. The exponent 3/2 makes the steps superlinear of that order; η_max is what a
  /// step deserves that will be shortened; with a goal the last step is not solved too well.
  eisenstat_walker forcing{.γ = 0.9, .exponent = 1.5, .η_max = 0.5, .η_first = 0.3};
  index inner_steps = 1000;  ///< conjugate gradient steps of one Newton step at most
  S sufficient = S(0.1);  ///< c in (0, 1): a step of length β lowers ‖F‖ by c β ‖F‖ at least
  /// Of envelope_newton with a preconditioner that knows faces: ‖x − x*‖_A, as ‖Π(r + v)‖_M
  /// estimates it, at which x is good enough; 0: never.
  S energy_goal = S(0);
  index halvings = 30;  ///< β = 1, ½, …: so often at most
  /// Steps in which ‖F‖ does not fall that mean stalled; of envelope_newton for a definite A steps in
  /// which neither ‖F‖ nor the envelope does.
  index patience = 100;
  kprgp_options<S> descent{.patience = 200};  ///< of the method that takes over where Newton fails

  [[gnu::cold]] void validate() const {
    if (step_length) detail::check_positive("step_length", *step_length);
    detail::check_positive("step_factor", step_factor);
    if (inner_steps < 1) throw bad_input("inner_steps", detail::show(inner_steps), "at least 1");
    detail::check_fraction("sufficient", sufficient);
    if (halvings < 0) throw bad_input("halvings", detail::show(halvings), "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
    mean_diagonal.validate();
    forcing.validate();
    descent.validate();
  }
};

namespace detail {

/// ρ of a state, `factor`/mean(diag A) if the options name none, and s = mean(diag M). What knows
/// the inverse on each face is not weighed against the curvature of its boundary. Not inlined:
/// g++ 12 would see *step_length read where there is none.
template <class QP, class M, class S, class State>
[[gnu::noinline]] void set_sizes(QP const& qp, M const& m, symmetric_newton_options<S> const& o,
                                 S const& factor, State& s) {
  using face = curved_face<S>;
  if (o.step_length) {
    s.step_length = *o.step_length;
  } else {
    auto const step = mean_step(qp.a(), s.x, factor, o.mean_diagonal);
    s.step_length = step.length;
    s.work.setup_applications += step.applications;
  }
  if constexpr (std::is_same_v<M, identity_operator> ||
                preconditions_faces<M, typename QP::vector_type, face>) {
    s.preconditioner_size = s.step_length / factor;
  } else {
    s.preconditioner_size = mean_diagonal(m, s.x, o.mean_diagonal).value;
  }
}

}  // namespace detail

}  // namespace slant
