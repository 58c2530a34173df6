// SPDX-License-Identifier: MIT
//
// Descent without end. For a semidefinite A the function q(x) = ½ xᵀA x − bᵀx has no minimum over Λ
// if there is a direction d with
//
//     A d = 0,   rᵀd < 0,   x + t d ∈ Λ for all t ≥ 0.
//
// In floating point: A d is below its own rounding error, the slope bᵀd above its. A curvature
// dᵀA d below its rounding error is a reason to look, no proof: it only bounds ‖A d‖ by √ε σ ‖d‖.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/flat_direction.hpp>

#include <cmath>
#include <optional>
#include <utility>

namespace slant {

/// Curvature pᵀAp below which p counts as a direction of the kernel: ε σ ‖p‖², σ ≈ σ_max.
template <class V, class S>
[[nodiscard]] S flatness(V const& p, S σ) {
  S const size = norm(p);
  return detail::epsilon<S>() * size * (size * σ);
}

/// The same for the direction of a CG method; 0 if A is declared definite, which has no kernel.
/// `learn`: σ is not known and grows with the curvatures that are seen.
template <bool Definite, class Directions, class S>
[[nodiscard]] S kernel_curvature(Directions const& d, S& σ, bool learn) {
  if constexpr (Definite) {
    return S(0);
  } else {
    if (learn) {
      S const seen = d.curvature / inner_product(d.p, d.p);
      if (seen > σ) σ = seen;
    }
    return flatness(d.p, σ);
  }
}

/// What rounding may leave of A d, as a whole and row by row: |aᵢⱼ| ≤ √(aᵢᵢ aⱼⱼ), so that of (A d)ᵢ
/// is some ε √aᵢᵢ Σⱼ √aⱼⱼ |dⱼ|. Rows are asked where A gives its diagonal, because unknowns in units
/// of their own have some far below σ. Allocates where that is first of interest, next to a proof.
template <class A, class V>
class image_rounding {
 public:
  using scalar = scalar_t<V>;

  image_rounding(A const& a, scalar σ) : a_(a), σ_(std::move(σ)) {}

  /// Whether the image of d is no more than a share of it.
  [[nodiscard]] bool covers(V const& image, V const& d, scalar const& share = scalar(1)) {
    using std::abs, std::sqrt;
    scalar const room =
        share * scalar(32) * detail::epsilon<scalar>() * sqrt(scalar(slant::global_size(d)));
    if (!(norm(image) <= room * norm(d) * σ_)) return false;
    if (!asked_) ask(d);
    if (!known_) return true;
    auto const root = slant::local(*root_).array();
    scalar const sum = slant::total(d, scalar((root * slant::local(d).array().abs()).sum()));
    return slant::everywhere(d, (slant::local(image).array().abs() <= room * sum * root).all());
  }

 private:
  void ask(V const& d) {
    asked_ = true;
    root_ = like(d, slant::local(d).size());
    known_ = slant::diagonal_if_known(a_, *root_);
    slant::local(*root_) = slant::local(*root_).cwiseMax(scalar(0)).cwiseSqrt();
  }

  A const& a_;
  scalar σ_;
  std::optional<V> root_{};  // √diag(A)
  bool asked_ = false, known_ = false;
};

/// Is q unbounded along d, with the image A d?
///
///     x + t d ∈ Λ for all t ≥ 0,   A d at rounding level,   bᵀd > 0 beyond its rounding errors.
///
/// Where A d = 0 the slope is −bᵀd, whatever of x is in r. With a solution x* far away bᵀd = x*ᵀA d,
/// which rounding of d may leave of terms that cancel: all but ∛ε of them must not.
template <class QP, class State, class V, class A>
[[nodiscard, gnu::cold]] bool is_endless_descent(QP const& qp, State const& s, V const& d,
                                                 V const& image, image_rounding<A, V>& rounding) {
  using S = scalar_t<V>;
  using std::cbrt;
  S const slope = inner_product(d, qp.b()) / s.unit;
  S const terms = slant::total(
      d, S((slant::local(d).array() * (slant::local(qp.b()).array() / s.unit)).abs().sum()));
  return is_descent(slope, d, S(4) * s.size_of_b) && slope > cbrt(detail::epsilon<S>()) * terms &&
         !(slant::minimum(s.x, qp.set().step_to_boundary(slant::local(s.x), slant::local(d))) <
           detail::infinity<S>()) &&
         rounding.covers(image, d);
}

/// Takes the part in range(A) out of a direction of descent d that does not leave Λ, and is flat or
/// long: conjugate gradients for
///
///     minimise   ½ δᵀA δ − (A d)ᵀδ   over what keep(x, y) keeps,      d ← d − δ.
///
/// A curvature of ε σ ‖d‖² leaves ‖A d‖ of √ε σ ‖d‖, no proof that there is no minimum. True if d
/// then is one, with image = A d computed anew. Scratch: w, Aw, g. One application for each of at
/// most `steps` steps and one for the proof.
template <class QP, class State, class Keep, class V, class S>
[[nodiscard, gnu::cold]] bool confirm_descent(QP const& qp, State& s, Keep const& keep, V& d,
                                              V& image, V& w, V& Aw, V& g, S σ, index steps) {
  using std::abs;
  S const first = norm(d);
  if (!(first > S(0)) || !detail::is_finite(first)) return false;
  S const size = unit_near(first), least = first / size / S(128);
  vectors::scale(S(1) / size, d);
  vectors::scale(S(1) / size, image);
  image_rounding<typename QP::operator_type, V> rounding(qp.a(), σ);
  S curvature(0);
  for (index k = 0; k < steps && norm(d) > least; ++k) {
    keep(image, g);
    if (rounding.covers(g, d, S(1) / S(8))) break;
    if (k == 0) {
      vectors::copy(g, w);
    } else {
      S const γ = inner_product(g, Aw) / curvature;
      vectors::waxpy(-γ, w, g, w);
    }
    slant::apply(qp.a(), w, Aw, s.a_workspace);
    ++s.work.operator_applications;
    curvature = inner_product(w, Aw);
    if (!(curvature > flatness(w, σ))) break;
    S const α = inner_product(g, w) / curvature;
    vectors::axpy(-α, w, d);
    vectors::axpy(-α, Aw, image);
  }
  // What is left of components that d does not have are rounding errors of the others.
  S const nothing = S(8) * detail::epsilon<S>() * norm(d);
  for (index i = 0; i < index(slant::local(d).size()); ++i) {
    S& entry = slant::local(d).coeffRef(i);
    if (abs(entry) <= nothing) entry = S(0);
  }
  slant::apply(qp.a(), d, image, s.a_workspace);
  ++s.work.operator_applications;
  return norm(d) > least && is_endless_descent(qp, s, d, image, rounding);
}
/// The same on the face of a method of conjugate gradients, of d = −s.directions.p, which stays that.
/// Scratch: trial, projected, reduced, directions.Ap.
template <class QP, class State>
[[nodiscard, gnu::cold]] bool confirm_descent(QP const& qp, State& s, index steps) {
  auto& p = s.directions.p;
  s.directions.live = false;
  vectors::negate(p, p);
  vectors::negate(s.directions.Ap, s.directions.Ap);
  auto const keep = [&](auto const& x, auto& y) { s.face.keep(x, y); };
  bool const is_one =
      confirm_descent(qp, s, keep, p, s.directions.Ap, s.projected, s.reduced, s.trial, s.σ, steps);
  vectors::negate(p, p);
  return is_one;
}

/// Compares iterates with an earlier one, which is replaced whenever the number of comparisons is a
/// power of two (Brent's cycle detection): steps may repeat in cycles of any length and add up to
/// such a direction, although none of them is one. A difference of iterates that looks like one by
/// the difference of its gradients, which is free of charge and has their rounding errors, is
/// confirmed by one application. The more steps lie between two iterates, the less the first of
/// them disturb; so after a failure the next one is confirmed only after twice as many.
template <class V>
class recession_watch {
 public:
  /// For vectors of n entries like the prototype.
  recession_watch(V const& prototype, index n) : x_(like(prototype, n)), r_(like(prototype, n)) {}

  /// Forgets the iterates so far: they belong to another gradient.
  void forget() { seen_ = next_ = 0; }

  /// Looks at s.x and its gradient s.r, in multiples of s.unit. If true, s.directions.p is the
  /// negative direction. Scratch: φ and trial.
  template <class QP, class State>
  [[nodiscard]] bool found(QP const& qp, State& s) {
    using S = scalar_t<V>;
    bool yes = false;
    if (seen_ > 0 && seen_ >= next_) {
      vectors::waxpy(-(unit_ / s.unit), r_, s.r, s.φ);
      vectors::difference(s.x, x_, s.trial);
      S const slope = -inner_product(s.trial, s.r);
      auto const& set = qp.set();
      if (!(inner_product(s.trial, s.φ) > flatness(s.trial, s.σ / s.unit)) &&
          is_descent(slope, s.trial, S(s.size_of_b + norm(s.r))) &&
          !(slant::minimum(s.x, set.step_to_boundary(slant::local(s.x), slant::local(s.trial))) <
            detail::infinity<S>())) {
        vectors::scale(S(1) / unit_near(norm(s.trial)), s.trial);
        slant::apply(qp.a(), s.trial, s.φ, s.a_workspace);
        ++s.work.operator_applications;
        image_rounding<typename QP::operator_type, V> rounding(qp.a(), s.σ);
        yes = is_endless_descent(qp, s, s.trial, s.φ, rounding);
        next_ = 2 * seen_;
      }
    }
    if (yes) vectors::negate(s.trial, s.directions.p);
    if ((seen_ & (seen_ - 1)) == 0) {
      vectors::copy(s.x, x_);
      vectors::copy(s.r, r_);
      unit_ = s.unit;
    }
    ++seen_;
    return yes;
  }

 private:
  V x_;                  // the earlier iterate
  V r_;                  // its gradient
  scalar_t<V> unit_{1};  // of that
  index seen_ = 0;       // comparisons so far
  index next_ = 0;       // at which a direction is confirmed
};

}  // namespace slant
