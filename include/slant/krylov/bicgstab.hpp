// SPDX-License-Identifier: MIT
//
// BiCGSTAB for A x = b with any square operator [van der Vorst 1992], the solver of the
// nonsymmetric systems in [T] and [K §3.3], with an optional right preconditioner M ≈ A⁻¹.
//
//     r = b − A x,  r̂ = r₀
//     p ← r + β (p − ω v),  v = A M p,  α = ρ / r̂ᵀv,  s = r − α v,
//     t = A M s,  ω = tᵀs / tᵀt,  x ← x + α M p + ω M s,  r ← s − ω t
//
// Two applications of A a step. Breakdowns are mended where that is possible, without NaN:
//   ρ = r̂ᵀr or r̂ᵀv vanishes relative to its factors: the shadow residual is renewed, r̂ = r;
//   r̂ᵀv vanishes nevertheless, as rᵀA r does for skew A: r̂ = r + (‖r‖/‖v‖) v, then r̂ᵀv = ‖r‖ ‖v‖;
//   tᵀs is small against ‖t‖ ‖s‖, so that ω nearly stops the recurrence: |ω| = κ ‖s‖/‖t‖ with
//   κ = 0.7 at least, since any ω ≠ 0 keeps it intact [Sleijpen, van der Vorst 1995].
// What is left is A v = 0 or a number out of range: status breakdown.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/krylov/linear_system.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// State of bicgstab.
template <class V, class WA, class WM>
struct bicgstab_state : detail::residual_state<V> {
  WA a_workspace;                           ///< temporaries of A
  WM m_workspace;                           ///< temporaries of M
  V shadow = this->r;                       ///< r̂
  V p = this->r, v = this->r, t = this->r;  ///< direction, A M p, A M s
  V preconditioned = this->r;               ///< M p or M s
  scalar_t<V> ρ{1}, α{1}, ω{1};             ///< the recurrence's coefficients
  bool restarted = true;                    ///< p starts anew from r
};

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class A, class V, class M = identity_operator>
class bicgstab : public detail::refused_method<std::remove_cvref_t<V>> {
  using vector_type = std::remove_cvref_t<V>;
  using law = detail::law_demand;

  static_assert(detail::vector_demands<vector_type>::told);
  static_assert(detail::operator_demands<std::remove_cvref_t<A>, vector_type, law::none>::told);
  static_assert(
      detail::preconditioner_demands<std::remove_cvref_t<M>, vector_type, law::none>::told);

 public:
  using bicgstab::refused_method::refused_method;
};

/// BiCGSTAB: solve(bicgstab{A, b}, x0, residual_below(1e-10)), or bicgstab{A, b, M}.
/// Requires linear_operator for A and M; laws are not asked for.
template <class A, class V, class M>
  requires vector<std::remove_cvref_t<V>> &&
           linear_operator<std::remove_cvref_t<A>, std::remove_cvref_t<V>> &&
           linear_operator<std::remove_cvref_t<M>, std::remove_cvref_t<V>>
class bicgstab<A, V, M> : public detail::preconditioned_system<A, V, M> {
  using system = detail::preconditioned_system<A, V, M>;

 public:
  using typename system::scalar;
  using typename system::vector_type;
  using state_type =
      bicgstab_state<vector_type, workspace_t<typename system::operator_type, vector_type>,
                     workspace_t<typename system::preconditioner_type, vector_type>>;
  using system::system;

  /// Throws bad_input if x0 or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start(x0, this->b());
    state_type s{{x0}, workspace(this->a(), x0), workspace(this->m(), x0)};
    detail::start_residual(this->a(), this->b(), s);
    return s;
  }

  /// start(s.x) in the place of s, which this method or one like it made earlier: for a sequence of
  /// systems with other A and b of the same sizes. No allocation; breakdown if A x is not finite.
  void restart(state_type& s) const {
    s.restarted = true;
    detail::restart_residual(this->a(), this->b(), s);
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    auto const ε = detail::epsilon<scalar>();
    if (!s.restarted) {
      scalar const ρ = inner_product(s.shadow, s.r);
      // ρ at rounding level says nothing about the residual: start anew instead of dividing by it.
      using std::abs;
      if (abs(ρ) <= ε * norm(s.shadow) * (s.residual_norm / s.unit)) {
        s.restarted = true;
      } else {
        scalar const β = (ρ / s.ρ) * (s.α / s.ω);
        s.ρ = ρ;
        vectors::axpy(-s.ω, s.v, s.p);
        vectors::waxpy(β, s.p, s.r, s.p);
      }
    }
    bool const renewed = s.restarted;
    if (renewed) renew_shadow(s);
    image(s, s.p, s.v);
    auto const usable_denominator = [&](scalar value) {
      return usable(value, ε * norm(s.shadow) * norm(s.v));
    };
    scalar denominator = inner_product(s.shadow, s.v);
    if (!renewed && !usable_denominator(denominator)) {
      renew_shadow(s);
      image(s, s.p, s.v);
      denominator = inner_product(s.shadow, s.v);
    }
    if (!usable_denominator(denominator)) denominator = turn_shadow(s);
    if (!usable_denominator(denominator)) return break_down(s);
    s.α = s.ρ / denominator;
    vectors::axpy(-(s.unit * s.α), s.preconditioned, s.x);  // M p
    vectors::axpy(-s.α, s.v, s.r);                          // r is now the half-step residual s
    s.restarted = false;
    s.updated = true;
    ++s.iteration;
    detail::note_residual(s);
    if (s.status != status::running) return;
    image(s, s.r, s.t);
    scalar const τ = norm(s.t);
    if (!usable(τ, scalar(0))) return break_down(s);
    s.ω = stabilised(inner_product(s.t, s.r) / τ, s.residual_norm / s.unit) / τ;
    vectors::axpy(-(s.unit * s.ω), s.preconditioned, s.x);  // M s
    vectors::axpy(-s.ω, s.t, s.r);
    detail::note_residual(s);
  }

  /// r from x, if steps have been updating it; the recurrence starts anew.
  bool refresh(state_type& s) const {
    s.restarted = true;
    return detail::refresh_residual(this->a(), this->b(), s, detail::note_residual<state_type>);
  }

 private:
  static bool usable(scalar value, scalar noise) {
    using std::abs;
    return abs(value) > noise && detail::is_finite(value);
  }
  static void renew_shadow(state_type& s) {
    vectors::copy(s.r, s.shadow);
    vectors::copy(s.r, s.p);
    s.ρ = inner_product(s.r, s.r);
    s.restarted = false;
  }
  /// r̂ = r + (‖r‖/‖v‖) v where v = A M r and rᵀv = 0; r̂ᵀv.
  static scalar turn_shadow(state_type& s) {
    scalar const stretch = norm(s.r) / norm(s.v);
    if (!usable(stretch, scalar(0))) return scalar(0);
    vectors::axpy(stretch, s.v, s.shadow);
    s.ρ = inner_product(s.shadow, s.r);
    return inner_product(s.shadow, s.v);
  }
  /// tᵀs/‖t‖ = ‖s‖ cos(t, s), with a cosine of at least κ.
  static scalar stabilised(scalar length, scalar size) {
    using std::abs;
    scalar const least = scalar(0.7) * size;
    if (!(abs(length) < least)) return length;
    return length < scalar(0) ? scalar(-least) : least;
  }
  static void break_down(state_type& s) { s.status = status::breakdown; }

  /// y = A M x; M x stays in s.preconditioned for the update of the iterate.
  void image(state_type& s, vector_type const& x, vector_type& y) const {
    slant::apply(this->m(), x, s.preconditioned, s.m_workspace);
    slant::apply(this->a(), s.preconditioned, y, s.a_workspace);
    ++s.work.operator_applications;
  }
};

template <class A, class V>
bicgstab(A&&, V&&) -> bicgstab<kept_t<A>, kept_t<V>>;
template <class A, class V, class M>
bicgstab(A&&, V&&, M&&) -> bicgstab<kept_t<A>, kept_t<V>, kept_t<M>>;

}  // namespace slant
