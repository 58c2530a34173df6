// SPDX-License-Identifier: MIT
//
// Conjugate gradients for A x = b, A symmetric positive definite, with an optional symmetric
// positive definite preconditioner M ≈ A⁻¹ [Hestenes, Stiefel 1952].
//
//     r = A x − b
//     z = M r,  p ← z − γ p,  x ← x − α p,  r ← r − α A p
//
// One application of A and one of M a step.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/linear_system.hpp>
#include <slant/operators/identity.hpp>

#include <concepts>
#include <string>
#include <type_traits>

namespace slant {

/// State of cg.
template <class V, class WA, class WM>
struct cg_state : detail::residual_state<V> {
  WA a_workspace;                               ///< temporaries of A
  WM m_workspace;                               ///< temporaries of M
  V z = this->r;                                ///< preconditioned residual M r
  conjugate_directions<V> directions{this->r};  ///< p, Ap, pᵀAp

  /// Why the method has ended the run.
  [[nodiscard]] std::string reason() const {
    if (this->status == slant::status::breakdown && directions.live &&
        !(directions.curvature > scalar_t<V>(0))) {
      return "pᵀA p = " + detail::show(directions.curvature) +
             " for a direction p, where a positive definite A has a number > 0";
    }
    return "the method reports: " + std::string(to_string(this->status));
  }
};

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class A, class V, class M = identity_operator>
class cg : public detail::refused_method<std::remove_cvref_t<V>> {
  using vector_type = std::remove_cvref_t<V>;
  using law = detail::law_demand;

  static_assert(detail::vector_demands<vector_type>::told);
  static_assert(detail::operator_demands<std::remove_cvref_t<A>, vector_type, law::definite>::told);
  static_assert(
      detail::preconditioner_demands<std::remove_cvref_t<M>, vector_type, law::definite>::told);

 public:
  using cg::refused_method::refused_method;
};

/// Conjugate gradients: solve(cg{A, b}, x0, residual_below(1e-10)), or cg{A, b, M}.
/// Requires spd_operator for A and M. Status breakdown if pᵀAp ≤ 0 shows that A is not definite.
template <class A, class V, class M>
  requires vector<std::remove_cvref_t<V>> &&
           spd_operator<std::remove_cvref_t<A>, std::remove_cvref_t<V>> &&
           spd_operator<std::remove_cvref_t<M>, std::remove_cvref_t<V>>
class cg<A, V, M> : public detail::preconditioned_system<A, V, M> {
  using system = detail::preconditioned_system<A, V, M>;

 public:
  using typename system::scalar;
  using typename system::vector_type;
  using state_type = cg_state<vector_type, workspace_t<typename system::operator_type, vector_type>,
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
    s.directions.live = false;
    detail::restart_residual(this->a(), this->b(), s);
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    auto& d = s.directions;
    if constexpr (std::same_as<typename system::preconditioner_type, identity_operator>) {
      d.advance(s.r);
    } else {
      slant::apply(this->m(), s.r, s.z, s.m_workspace);
      d.advance(s.z);
    }
    d.image(this->a(), s.a_workspace);
    ++s.work.operator_applications;
    if (!(d.curvature > scalar(0))) {
      s.status = status::breakdown;
      return;
    }
    scalar const α = inner_product(s.r, d.p) / d.curvature;
    vectors::axpy(-(s.unit * α), d.p, s.x);
    vectors::axpy(-α, d.Ap, s.r);
    s.updated = true;
    detail::note_residual(s);
    ++s.iteration;
  }

  /// r from x, if steps have been updating it; the next direction is r itself.
  bool refresh(state_type& s) const {
    s.directions.live = false;
    return detail::refresh_residual(this->a(), this->b(), s, detail::note_residual<state_type>);
  }
};

template <class A, class V>
cg(A&&, V&&) -> cg<kept_t<A>, kept_t<V>>;
template <class A, class V, class M>
cg(A&&, V&&, M&&) -> cg<kept_t<A>, kept_t<V>, kept_t<M>>;

}  // namespace slant
