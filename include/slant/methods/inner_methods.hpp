// SPDX-License-Identifier: MIT
//
// Methods that solve the inner problems of others. The outer method changes b from time to time and
// knows σ, an upper bound of the largest eigenvalue of A.
//
// Minimal definition.   make(qp, constraints, ρ, σ) → a method for qp, whose states derive from
//                       gradient_point, with resume(state) after a change of b;  validate().
#pragma once

#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// KPRGP.
template <class S = double>
struct kprgp_inner {
  kprgp_options<S> options{};  ///< step_length, if not given: step_factor / σ

  void validate() const { options.validate(); }
  template <class QP, class C>
  [[nodiscard]] auto make(QP const& qp, C const&, S const&, S const& σ) const {
    auto own = options;
    if (!own.step_length) own.step_length = own.step_factor / σ;
    return kprgp<QP const&>{qp, own};
  }
};

/// The symmetric semismooth Newton method, with a preconditioner M ≈ A⁻¹ of the A without
/// constraints; M must outlive it.
template <class S = double, class M = identity_operator>
struct newton_inner {
  symmetric_newton_options<S> options{};  ///< descent.step_length, if not given: from σ
  M const* preconditioner = nullptr;      ///< only with M other than the identity

  void validate() const {
    options.validate();
    if (!std::is_same_v<M, identity_operator> && preconditioner == nullptr) {
      throw bad_input("preconditioner", "none", "the operator M");
    }
  }
  template <class QP, class C>
  [[nodiscard]] auto make(QP const& qp, C const& constraints, S const& ρ, S const& σ) const {
    auto own = options;
    if (!own.descent.step_length) own.descent.step_length = own.descent.step_factor / σ;
    if constexpr (std::is_same_v<M, identity_operator>) {
      return symmetric_newton<QP const&, identity_operator>{qp, own};
    } else {
      auto m = projected_preconditioner(*preconditioner, constraints, ρ);
      return symmetric_newton<QP const&, decltype(m)>{qp, std::move(m), own};
    }
  }
};

}  // namespace slant
