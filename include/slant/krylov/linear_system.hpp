// SPDX-License-Identifier: MIT
//
// What the solvers of A x = b have in common: checking the data, the first residual, its norm.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/linear_operator.hpp>

namespace slant::detail {

template <class A, class V>
void check_linear_system(A const& a, V const& b) {
  auto const n = index(slant::local(b).size());
  check_size("A.rows()", index(a.rows()), n);
  check_size("A.cols()", index(a.cols()), n);
  check_finite("b", b);
}

/// Norm of the residual in s.r and what follows from it for the status.
template <class State>
void note_residual(State& s) {
  using S = scalar_t<decltype(s.r)>;
  s.residual_norm = norm(s.r);
  if (s.residual_norm == S(0)) s.status = status::converged;
  if (!is_finite(s.residual_norm)) s.status = status::breakdown;
}

/// s.r = A s.x − b, the scale ‖b‖ (or ‖A x₀‖ if b = 0); one application, none if x₀ = 0.
template <class A, class V, class State>
void start_residual(A const& a, V const& b, State& s) {
  using S = scalar_t<V>;
  auto& r = s.r;
  s.residual_scale = norm(b);
  if (norm(s.x) == S(0)) {
    slant::local(r) = -slant::local(b);
  } else {
    slant::apply(a, s.x, r, s.a_workspace);
    ++s.work.operator_applications;
    if (s.residual_scale == S(0)) s.residual_scale = norm(r);
    slant::local(r) -= slant::local(b);
    check_finite("A x0 - b", r);
  }
  note_residual(s);
}

}  // namespace slant::detail
