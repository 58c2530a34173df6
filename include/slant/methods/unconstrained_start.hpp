// SPDX-License-Identifier: MIT
//
// A first point for min ½ xᵀA x − bᵀx over Λ: what conjugate gradients make of the problem without
// its constraints in a few steps, brought back to Λ.
//
//     x⁰ = P_Λ(x̂),    ‖M^½ (b − A x̂)‖ ≤ tolerance · ‖M^½ b‖
//
// In contact, x̂ are the forces of a bond in both directions: where they pull, the bodies will part;
// where they are small, they will stick. Measured on bricks (k = 8 … 20, three loads): 3 to 15
// products for a start from which symmetric_newton needs a fifth to a quarter fewer ones in all; on
// single scenes from half as many to a few more.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/operators/identity.hpp>

#include <utility>

namespace slant {

/// A point to start from, and what it cost.
template <class V>
struct start_point {
  V x;                 ///< in Λ
  index applications;  ///< products by A, or by its rounded twin
};

namespace detail {

/// Conjugate gradients for A x = b from zero; stops early where A has no curvature.
template <class A, class M, class V>
[[nodiscard]] index few_cg_steps(A const& a, M const& m, V const& b, V& x,
                                 scalar_t<V> const& tolerance, index most) {
  using S = scalar_t<V>;
  index const n = slant::local(b).size();
  // In units in which b is of the order 1, so that no square leaves the range.
  S const unit = unit_near(slant::norm(b));
  V r = b, z = like(b, n), p = like(b, n), Ap = like(b, n);
  vectors::divide(unit, r);
  auto wa = slant::workspace(a, b);
  auto wm = slant::workspace(m, b);
  slant::apply(m, r, z, wm);
  vectors::copy(z, p);
  S size = slant::inner_product(r, z);
  S const enough = tolerance * tolerance * size;
  index k = 0;
  while (k < most && size > enough) {
    slant::apply(a, p, Ap, wa);
    ++k;
    S const bend = slant::inner_product(p, Ap);
    if (!(bend > S(0)) || !is_finite(bend)) break;
    S const α = size / bend;
    vectors::axpy(α, p, x);
    vectors::axpy(-α, Ap, r);
    slant::apply(m, r, z, wm);
    S const next = slant::inner_product(r, z);
    vectors::waxpy(next / size, p, z, p);
    size = next;
  }
  vectors::scale(unit, x);
  return k;
}

}  // namespace detail

/// The start at the top of this file, with M ≈ A⁻¹ as symmetric_newton takes it; rounded products
/// are good enough where A has them. Throws bad_input if tolerance is not in (0, 1), most < 0, or M
/// has not the size of the problem.
template <class QP, class M>
  requires preconditioner_for<M, QP>
[[nodiscard]] auto unconstrained_start(QP const& qp, M const& m,
                                       typename QP::scalar tolerance = typename QP::scalar(0.01),
                                       index most = 40) -> start_point<typename QP::vector_type> {
  using V = typename QP::vector_type;
  if (!(tolerance > 0 && tolerance < 1)) {
    throw bad_input("tolerance", detail::show(tolerance), "a number in (0, 1)");
  }
  if (most < 0) throw bad_input("most", detail::show(most), "a number >= 0");
  detail::check_size("rows of the preconditioner", index(m.rows()), qp.size());
  V x = like(qp.b(), qp.size()), start = like(qp.b(), qp.size());
  vectors::set_zero(x);
  index k = 0;
  if constexpr (has_rounded<typename QP::operator_type, V>) {
    k = detail::few_cg_steps(qp.a().rounded(), m, qp.b(), x, tolerance, most);
  } else {
    k = detail::few_cg_steps(qp.a(), m, qp.b(), x, tolerance, most);
  }
  // A number out of range says that x̂ is of no use: zero is as good a start as any.
  if (!detail::is_finite(slant::norm(x))) vectors::set_zero(x);
  slant::project(qp.set(), slant::local(x), slant::local(start));
  return {std::move(start), k};
}

/// Without a preconditioner.
template <class QP>
[[nodiscard]] auto unconstrained_start(QP const& qp,
                                       typename QP::scalar tolerance = typename QP::scalar(0.01),
                                       index most = 40) {
  return unconstrained_start(qp, identity_operator(qp.size()), tolerance, most);
}

}  // namespace slant
