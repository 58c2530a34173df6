// SPDX-License-Identifier: MIT
//
// When and how an active set method releases blocks from its active set.
//
//     KPRGP   β̃ = r̃ on 𝒜;   the face is kept while  β̃ᵀr < Γ² φ̃ᵀr;   x ← x − α̃ β̃           [K (33)]
//     QPQ     β of [K Lemma 1];  while  ‖β‖ < Γ ‖φ‖;                  x ← x − α β, α minimises q
//     QPC     β of [K Lemma 1];  until CG has minimised q on the face;  x ← x − α β
#pragma once

#include <slant/methods/kkt_vector.hpp>
#include <slant/methods/kprgp_options.hpp>
#include <slant/methods/qpc_options.hpp>
#include <slant/methods/reduced_gradient.hpp>

#include <algorithm>
#include <limits>

namespace slant {

/// The rule of KPRGP.
struct reduced_gradient_release {
  template <class S>
  using options = kprgp_options<S>;
  static constexpr bool minimising = false;  ///< the step of length α̃ along −β̃, projected

  /// What the two parts of r̃ can gain.
  template <class QP, class State>
  static void weigh(QP const&, State& s) {
    using S = typename State::scalar;
    S const ε = std::numeric_limits<S>::epsilon();
    S const rounding = ε * norm(s.x) / (s.step_length * s.unit);  // of r̃
    S const noise = rounding * norm(s.r);
    s.face.keep(s.reduced, s.φ);
    s.φr = gain(s.φ, s.r, noise);
    s.face.keep_complement(s.reduced, s.φ);
    s.βr = gain(s.φ, s.r, noise);
  }

  /// [K (33)]: the error on the active set is small against the one on the free set.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    return s.βr < o.proportioning * o.proportioning * s.φr;
  }
};

/// What QPQ and QPC share: φ and the vector β of [K Lemma 1], along which q is minimised.
struct kkt_release {
  static constexpr bool minimising = true;

  /// ‖φ‖² and ‖β‖².
  template <class QP, class State>
  static void weigh(QP const& qp, State& s) {
    s.face.keep(s.r, s.φ);
    s.φr = inner_product(s.φ, s.φ);
    release_direction(qp, s, s.φ);
    s.βr = inner_product(s.φ, s.φ);
  }

  /// β.
  template <class QP, class State, class V>
  static void release_direction(QP const& qp, State const& s, V& β) {
    s.face.keep_complement(s.reduced, β);
    kkt_vector(qp.set(), s.face, s.x, s.r, s.reduced, β);
  }
};

/// The rule of QPQ.
struct kkt_proportioning : kkt_release {
  template <class S>
  using options = kprgp_options<S>;

  /// ‖β‖ < Γ ‖φ‖.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    return s.βr < o.proportioning * o.proportioning * s.φr;
  }
};

/// The rule of QPC.
struct face_minimum_release : kkt_release {
  template <class S>
  using options = qpc_options<S>;

  /// Is ‖φ‖ larger than a fraction of what it was on this face at first, and of ‖β‖? True if there
  /// is nothing to release.
  template <class State, class Options>
  static bool keeps_face(State const& s, Options const& o) {
    using S = typename State::scalar;
    S const scale = std::max<S>(s.φr_at_restart, s.βr);
    return s.βr == S(0) || s.φr > o.face_accuracy * o.face_accuracy * scale;
  }
};

}  // namespace slant
