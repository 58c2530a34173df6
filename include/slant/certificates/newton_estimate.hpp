// SPDX-License-Identifier: MIT
//
// An estimate of ‖x − x*‖_A from the gradient g = A x − b at x ∈ Λ, by a Newton step. In the bound
//
//     e ≤ ½ (δ + √(δ² + 4γ)),     δ = ‖g − s‖_{A⁻¹} certificates/energy_error.hpp
//
// s may be the balanced part of g + A D for any D: then g − s = −A D + rest, and
//
//     δ ≤ ‖D‖_A + ‖rest‖_{A⁻¹}.
//
// D is the Newton step: next to the solution it is x* − x, the rest vanishes, and so does what is
// estimated too high. It goes to x₁ = P_Λ(x − ρ g) and from there on the face of x₁ by conjugate
// gradients (face_correction.hpp). The inequality holds for every D; estimated are what more of
// these iterations would add, and ‖rest‖_{A⁻¹} unless the caller has a bound of it.
//
// Cost: one application of A, and one for each iteration, some 10.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/face_correction.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/block_queries.hpp>
#include <slant/sets/curved_face.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace slant {

/// Where x is, and what the estimate may use.
template <class V>
struct estimated_point {
  using scalar = scalar_t<V>;

  V const& x;          ///< of Λ
  V const& gradient;   ///< A x − b
  V const& stiffness;  ///< of the size of diag(A)⁻¹
  scalar ρ;            ///< its size as one number, the step of the projection
  index most;          ///< iterations
  /// For an A that may be singular: what the gradient was computed from.
  std::optional<gradient_size<scalar>> sizes;
  /// false: what the iterations have left of the gradient is part of the rest, for few iterations
  /// and a norm_of that bounds. true: what more of them would add is estimated.
  bool trusts_iterations = true;
};

/// The estimate at the top of this file for programs qp with a preconditioner like m. Refers to qp.
template <class QP, class M>
class newton_estimate {
 public:
  using vector_type = typename QP::vector_type;
  using scalar = typename QP::scalar;

  newton_estimate(QP const& qp, M const& m)
      : qp_(&qp),
        face_(qp.set()),
        correction_(qp.b(), m),
        projected_(qp.b()),
        step_(qp.b()),
        image_(qp.b()),
        balanced_(qp.b()),
        rest_(qp.b()),
        trial_(qp.b()),
        weight_(qp.b()) {}

  /// Infinite where nothing is known: A shows no curvature along the gradient on the face.
  /// norm_of(d) → ‖d‖_{A⁻¹}, asked once at most.
  template <class WA, class Norm>
  [[nodiscard]] scalar operator()(estimated_point<vector_type> const& at, M const& m, WA& of_a,
                                  Norm const& norm_of) {
    vectors::waxpy(-at.ρ, at.gradient, at.x, trial_);
    slant::project(qp_->set(), slant::local(trial_), slant::local(projected_));
    face_.assign(qp_->set(), slant::local(trial_), scalar(1));
    vectors::difference(projected_, at.x, step_);
    vectors::set_zero(image_);
    if (slant::norm(step_) > scalar(0)) {
      slant::apply(qp_->a(), step_, image_, of_a);
      ++applications_;
    }
    vectors::sum(at.gradient, image_, rest_);
    applications_ +=
        correction_.compute(qp_->a(), of_a, m, rest_, face_, at.ρ, at.ρ, at.most, at.sizes);
    if (!correction_.found || !detail::is_finite(correction_.energy)) {
      return std::numeric_limits<scalar>::infinity();
    }
    if (!at.trusts_iterations) {
      vectors::set_zero(correction_.remainder);
      correction_.missing = scalar(0);
    }
    return put_together(at, norm_of);
  }
  /// Applications of A so far.
  [[nodiscard]] index applications() const { return applications_; }

 private:
  /// The bound for x from s balanced at x, or for x₁ from s balanced there and ‖x₁ − x‖_A on top: a
  /// point inside Λ has a gap of the first order that x₁ has not. Curved blocks are balanced with a
  /// part of the gradient or by the gap alone. What the diagonal of A says is best is taken.
  template <class Norm>
  [[nodiscard]] scalar put_together(estimated_point<vector_type> const& at, Norm const& norm_of) {
    vectors::add(correction_.image, image_);
    vectors::sum(at.gradient, image_, balanced_);
    vectors::subtract(correction_.image, image_);
    scalar const way = detail::root_of_product(step_, image_);
    detail::bound_split<scalar> best;
    consider(best, at, projected_, correction_.energy, correction_.bend, way);
    vectors::add(correction_.t, step_);
    vectors::add(correction_.image, image_);
    vectors::set_zero(trial_);
    face_.add_curvature(scalar(1) / at.ρ, step_, trial_);
    consider(best, at, at.x, detail::root_of_product(step_, image_),
             detail::root_of_product(step_, trial_), scalar(0));
    if (!detail::is_finite(best.bound)) return best.bound;
    scalar const δ =
        detail::root_of_squares<scalar>(best.moved, correction_.missing) + norm_of(rest_);
    return error_bound_of_root<scalar>(δ, best.root_of_gap) + best.above;
  }

  void consider(detail::bound_split<scalar>& best, estimated_point<vector_type> const& at,
                vector_type const& x, scalar const& moved, scalar const& bend,
                scalar const& above) {
    detail::consider_split(best, qp_->set(), face_, x, balanced_, correction_.remainder,
                           at.stiffness, moved, bend, above, rest_, weight_, trial_);
  }

  QP const* qp_;
  index applications_ = 0;
  curved_face<scalar> face_;
  face_correction<vector_type, M> correction_;
  vector_type projected_, step_, image_, balanced_, rest_, trial_, weight_;
};

}  // namespace slant
