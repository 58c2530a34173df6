// SPDX-License-Identifier: MIT
//
// When and how an active set method releases blocks from its active set.
//
//     KPRGP   β̃ = r̃ on 𝒜;   the face is kept while  β̃ᵀr < Γ² φ̃ᵀr;   x ← x − α̃ β̃           [K (33)]
//     QPQ     β of [K Lemma 1];  while  ‖β‖ < Γ ‖φ‖;                  x ← x − α β, α minimises q
//     QPC     β of [K Lemma 1];  until CG has minimised q on the face;  x ← x − α β
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/methods/parts/gradient_point.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/sets/face.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace slant {

// --- qpc options ---------------------------------------------------------------------------------
//
// The parameters of QPC.

/// Options of qpc: those of kprgp with another rule.
template <class S>
struct qpc_options {
  S face_accuracy = S(0.1);  ///< in [0, 1): CG goes on until ‖φ‖ is this fraction of its first size
                             ///< on the face, and of ‖β‖. Small: nearly the minimum on each face
  std::optional<S> step_length{};  ///< as for kprgp, and so the rest
  S step_factor = S(1.9);
  active_set_rule active_sets = active_set_rule::boundary;
  bool half_step = true;
  index refresh = 50;
  index patience = 1000;
  spectral_bound_options spectrum{};

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(face_accuracy >= S(0) && face_accuracy < S(1))) {
      throw bad_input("face_accuracy", detail::show(face_accuracy), "a number in [0, 1)");
    }
    kprgp_options<S>{.step_length = step_length,
                     .step_factor = step_factor,
                     .refresh = refresh,
                     .patience = patience,
                     .spectrum = spectrum}
        .validate();
  }
};

// --- kkt vector ----------------------------------------------------------------------------------
//
// The optimality conditions of [K Lemma 1], from which KPRGP's predecessors took their release
// directions: x ∈ Λ solves min q over Λ exactly if r_i = 0 where f_i(x_i) < 0 and
//
//     β_i = r_i + (‖r_i‖ / ‖∇f_i(x_i)‖) ∇f_i(x_i) = 0   where f_i(x_i) = 0.
//
// −β_i halves the angle between the directions that leave Λ_i and those in which q rises. Unlike
// the reduced gradient, β is discontinuous: just inside the boundary r_i stands for it, small or
// not.

namespace detail {

/// A block that tells the inequalities it has.
template <class Block, class X>
concept has_inequalities = has_inequality_form<Block, X> && (Block::inequalities > 0);

/// r + (‖r‖/‖∇f‖) ∇f with the constraint of a block that is the most active at x; `otherwise` where
/// the boundary has no normal.
template <class Block, class X>
[[nodiscard]] X kkt_block(Block const& block, X const& x, X const& r, X const& otherwise) {
  using S = typename X::Scalar;
  auto const values = block.inequality(x);
  auto const gradients = block.inequality_gradient(x);
  index active = 0;
  for (index j = 1; j < values.size(); ++j) {
    if (values(j) > values(active)) active = j;
  }
  X normal = gradients.col(active);
  S const largest = normal.cwiseAbs().maxCoeff();
  if (!(largest > S(0))) return otherwise;
  normal /= largest;  // no overflow of its square, whatever the units of x
  return r + (r.norm() / normal.norm()) * normal;
}

}  // namespace detail

/// Puts β_i in place of β's own entries for the blocks off the face that have a smooth boundary and
/// are not optimal: those with r̃_i = 0 keep what they have, as do blocks and sets that do not tell
/// their inequalities.
template <class Set, class Face, class V>
void kkt_vector(Set const& set, Face const& face, V const& x, V const& r, V const& reduced, V& β) {
  if constexpr (has_visit<Set> && !has_own_face<Set, local_t<V>>) {
    auto& out = slant::local(β);
    set.visit([&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (has_static_dimension<block_type>) {
        auto const x_i = place.value(slant::local(x));
        using point = std::remove_cvref_t<decltype(x_i)>;
        if constexpr (detail::has_inequalities<block_type, point>) {
          if (face.state(place.index()) == block_state::free) return;
          point const reduced_i = place.value(slant::local(reduced));
          if ((reduced_i.array() == scalar_t<V>(0)).all()) return;
          place.put(out,
                    detail::kkt_block(block, x_i, point(place.value(slant::local(r))), reduced_i));
        }
      }
    });
  }
}

// --- release rules -------------------------------------------------------------------------------

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
