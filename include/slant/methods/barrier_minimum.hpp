// SPDX-License-Identifier: MIT
//
// The reduced system of an interior-point step [K (43)],
//
//     J_SC t = −g₀,     J_SC = A + W,
//
// by conjugate gradients with the preconditioner P_SC = D + W, D ≈ diag(A). A t comes along, so
// whoever takes the step knows the gradient at its end: one product by A a step of the iteration
// and none besides, also for a start t₀ ≠ 0, whose image is known from the step that made it. Of
// its multiples the one with the least energy is taken, which is never worse than 0.
//
// With M ≈ A⁻¹ at hand the preconditioner is, D ≈ diag(M)⁻¹,
//
//     P⁻¹ = P_SC⁻¹ (D M D + W) P_SC⁻¹:
//
// M where nothing is near its bound (W = 0), W⁻¹ where it is (W → ∞), P_SC⁻¹ for M = D⁻¹, and
// definite in between.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/methods/curved_minimum.hpp>
#include <slant/methods/recession.hpp>
#include <slant/operators/identity.hpp>

#include <type_traits>

namespace slant {

/// The solution t, its image, and what the iteration works in.
template <class V, class M>
class barrier_minimum {
 public:
  using scalar = scalar_t<V>;

  V t;                ///< the step
  V image;            ///< A t
  V direction;        ///< the last direction of the iteration
  V direction_image;  ///< A times it
  bool flat = false;  ///< it has no curvature

  barrier_minimum(V const& prototype, index n, M const& m)
      : t(like(prototype, n)),
        image(like(prototype, n)),
        direction(like(prototype, n)),
        direction_image(like(prototype, n)),
        g_(like(prototype, n)),
        z_(like(prototype, n)),
        near_(like(prototype, preconditioned ? n : 0)),
        far_(like(prototype, preconditioned ? n : 0)),
        m_workspace_(workspace(m, prototype)) {
    forget();
  }

  /// No step is known yet.
  void forget() {
    vectors::set_zero(t);
    vectors::set_zero(image);
    known_ = false;
  }

  /// t with ‖g₀ + J_SC t‖ ≤ target, or the last one after at most `most` steps. t has the units of
  /// g₀ over those of A; d is the diagonal of D, trace that of A. `warm`: begins at a multiple of
  /// the t that is there.
  template <class A, class WA, class B>
  inner_result<scalar> solve(A const& a, WA& a_workspace, M const& m, B const& barrier, V const& d,
                             V const& g0, scalar const& target, index most, bool warm,
                             scalar const& trace) {
    vectors::copy(g0, g_);
    barrier.keep_fixed(g_);
    if (warm && known_) {
      begin_at_multiple(barrier);
    } else {
      forget();
    }
    known_ = true;
    flat = false;
    scalar size = norm(g_), gz(0);
    bool finite = detail::is_finite(size);
    index k = 0;
    while (k < most && size > target) {
      precondition(m, barrier, d);
      scalar const next = inner_product(g_, z_);
      finite = finite && detail::is_finite(next);
      if (!(next > scalar(0))) break;
      if (k == 0) {
        vectors::negate(z_, direction);
      } else {
        vectors::waxpby(next / gz, direction, scalar(-1), z_, direction);
      }
      gz = next;
      slant::apply(a, direction, direction_image, a_workspace);
      ++k;
      add_stiffness(barrier, direction, direction_image, z_);
      scalar const bend = inner_product(direction, z_);
      finite = finite && detail::is_finite(bend);
      if (!(bend > scalar(0))) {  // a direction without curvature: the step ends here
        // W is semidefinite up to rounding; is A?
        flat = true;
        finite = finite && -inner_product(direction, direction_image) <=
                               scalar(64) * flatness(direction, trace);
        break;
      }
      scalar const α = gz / bend;
      vectors::axpy(α, direction, t);
      vectors::axpy(α, direction_image, image);
      vectors::axpy(α, z_, g_);
      size = norm(g_);
    }
    return {k, size, finite && detail::is_finite(size)};
  }

 private:
  static constexpr bool preconditioned = !std::is_same_v<M, identity_operator>;

  /// z = P⁻¹ g.
  template <class B>
  void precondition(M const& m, B const& barrier, V const& d) {
    if constexpr (preconditioned) {
      slant::apply(barrier.preconditioner(), g_, near_);
      vectors::multiply(d, near_, far_);
      slant::apply(m, far_, z_, m_workspace_);
      vectors::multiply(d, z_, far_);
      barrier.stiffness().apply_add(scalar(1), near_, far_);
      slant::apply(barrier.preconditioner(), far_, z_);
      barrier.keep_fixed(z_);
    } else {
      static_cast<void>(m);
      static_cast<void>(d);
      slant::apply(barrier.preconditioner(), g_, z_);
    }
  }

  /// y = J_SC x for x with the image Ax.
  template <class B>
  void add_stiffness(B const& barrier, V const& x, V const& Ax, V& y) const {
    vectors::copy(Ax, y);
    barrier.stiffness().apply_add(scalar(1), x, y);
    barrier.keep_fixed(y);
  }

  /// t ← θ t with the θ that minimises g₀ᵀt + ½ tᵀJ_SC t, and g with it.
  template <class B>
  void begin_at_multiple(B const& barrier) {
    add_stiffness(barrier, t, image, z_);
    scalar const bend = inner_product(t, z_), slope = -inner_product(g_, t);
    if (!(bend > scalar(0)) || !detail::is_finite(bend) || !detail::is_finite(slope)) {
      forget();
      return;
    }
    scalar const θ = slope / bend;
    vectors::scale(θ, t);
    vectors::scale(θ, image);
    vectors::axpy(θ, z_, g_);
  }

  V g_;           // g₀ + J_SC t
  V z_;           // preconditioned g, then J_SC p
  V near_, far_;  // parts of the preconditioned g
  workspace_t<M, V> m_workspace_;
  bool known_ = false;
};

}  // namespace slant
