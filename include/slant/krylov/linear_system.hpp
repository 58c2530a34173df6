// SPDX-License-Identifier: MIT
//
// What the solvers of A x = b have in common: checking the data, the first residual, its norm.
#pragma once

#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/operators/identity.hpp>

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <utility>

namespace slant::detail {

/// Throws bad_input unless A is n × n and b has n finite entries.
template <class A, class V>
void check_linear_system(A const& a, V const& b) {
  auto const n = index(slant::local(b).size());
  check_size("A.rows()", index(a.rows()), n);
  check_size("A.cols()", index(a.cols()), n);
  check_finite("b", b);
}

/// Throws bad_input unless x0 has as many entries as b, all of them finite.
template <class V>
void check_start(V const& x0, V const& b) {
  check_size("x0", index(slant::local(x0).size()), index(slant::local(b).size()));
  check_finite("x0", x0);
}

/// What the states of these solvers have in common. The residual is what the method makes zero: r,
/// or what a face or a projection leaves of it.
template <class V>
struct residual_state {
  V x;                            ///< iterate
  V r;                            ///< A x − b, in multiples of unit
  scalar_t<V> unit{1};            ///< a power of two, see base/scaling.hpp
  scalar_t<V> residual_norm{0};   ///< of the residual
  scalar_t<V> residual_scale{0};  ///< ‖b‖, or ‖A x₀‖ if b = 0
  scalar_t<V> computed_norm = detail::infinity<scalar_t<V>>();  ///< at the last refresh
  bool updated = false;  ///< r was updated since it was computed from x
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::work work{};

  residual_state(V const& x0) : x(x0), r(like(x0, slant::local(x0).size())) {}
};

/// The norm of the residual, ‖·‖ / unit, and what follows from it for the status.
template <class State, class S>
void note_norm(State& s, S const& size) {
  s.residual_norm = s.unit * size;
  if (s.residual_norm == S(0)) s.status = status::converged;
  if (!is_finite(s.residual_norm)) s.status = status::breakdown;
}
void note_residual(auto& s) {
  note_norm(s, norm(s.r));
}

/// s.r = (A s.x − b) / s.unit, the unit, and the scale ‖b‖ (or ‖A x₀‖ if b = 0); one application,
/// none if x₀ = 0. check(A x₀) is called in between.
template <class A, class V, class State, class Check>
void first_residual(A const& a, V const& b, State& s, Check check) {
  using S = scalar_t<V>;
  auto& r = s.r;
  s.residual_scale = norm(b);
  if (norm(s.x) == S(0)) {
    s.unit = unit_near(s.residual_scale);
    vectors::scale(S(-1) / s.unit, b, r);
  } else {
    slant::apply(a, s.x, r, s.a_workspace);
    ++s.work.operator_applications;
    check(r);
    S const image = norm(r);
    if (s.residual_scale == S(0)) s.residual_scale = image;
    s.unit = unit_near(std::max<S>(s.residual_scale, image));
    vectors::subtract(b, r);
    vectors::scale(S(1) / s.unit, r);
  }
  note_residual(s);
}

/// The first residual of a run; bad_input if A x₀ is not finite.
template <class A, class V, class State>
void start_residual(A const& a, V const& b, State& s) {
  first_residual(a, b, s, [](auto const& image) { check_finite("A x0", image); });
}

/// What start would make of s.x, in place: no allocation, and no exception, since an A x that is
/// not finite is a breakdown of whoever iterates around this.
template <class A, class V, class State>
void restart_residual(A const& a, V const& b, State& s) {
  using S = scalar_t<V>;
  s.unit = S(1);
  s.computed_norm = detail::infinity<S>();
  s.updated = false;
  s.iteration = 0;
  s.status = slant::status::running;
  s.work = {};
  first_residual(a, b, s, [](auto const&) {});
}

/// s.r from s.x, if it has been updated instead; whether it has. One application; note(s) then
/// takes the new norm down. Stalled if that is no smaller than half of what it was the last time: x
/// has no more digits to give.
template <class A, class V, class State, class Note>
bool refresh_residual(A const& a, V const& b, State& s, Note note) {
  using S = scalar_t<V>;
  if (!s.updated) return false;
  slant::apply(a, s.x, s.r, s.a_workspace);
  ++s.work.operator_applications;
  vectors::subtract(b, s.r);
  vectors::scale(S(1) / s.unit, s.r);
  s.updated = false;
  s.status = status::running;
  note(s);
  bool const better = s.residual_norm < s.computed_norm / S(2);
  if (s.status == status::running && !better) s.status = status::stalled;
  s.computed_norm = s.residual_norm;
  return true;
}

/// A x = b with a preconditioner M ≈ A⁻¹, checked. Each part is kept as kept_t says.
template <class A, class V, class M>
class preconditioned_system {
 public:
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = std::remove_cvref_t<V>;
  using preconditioner_type = std::remove_cvref_t<M>;
  using scalar = scalar_t<vector_type>;

  /// Throws bad_input if sizes do not match or b is not finite.
  preconditioned_system(held<A> a, held<V> b)
    requires std::same_as<preconditioner_type, identity_operator>
      : a_(std::move(a)), b_(std::move(b)), m_(identity_operator(slant::local(b_.get()).size())) {
    check_linear_system(a_.get(), b_.get());
  }
  preconditioned_system(held<A> a, held<V> b, held<M> m)
      : a_(std::move(a)), b_(std::move(b)), m_(std::move(m)) {
    check_linear_system(a_.get(), b_.get());
    check_size("rows of the preconditioner", index(m_.get().rows()), slant::local(b_.get()).size());
    check_size("columns of the preconditioner", index(m_.get().cols()),
               slant::local(b_.get()).size());
  }

 protected:
  [[nodiscard]] operator_type const& a() const noexcept { return a_.get(); }
  [[nodiscard]] vector_type const& b() const noexcept { return b_.get(); }
  [[nodiscard]] preconditioner_type const& m() const noexcept { return m_.get(); }

 private:
  held<A> a_;
  held<V> b_;
  held<M> m_;
};

}  // namespace slant::detail
