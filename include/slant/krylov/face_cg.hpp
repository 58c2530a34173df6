// SPDX-License-Identifier: MIT
//
// Conjugate gradients on a face: minimise q(x) = ½ xᵀA x − bᵀx over the free components of a face,
// the others staying as they are in x₀. This is the inner solver of the active-set methods [K
// §3.1.2].
//
//     r = A x − b,  φ = r on the face and 0 elsewhere,  p ← φ − γ p,  x ← x − α p,  r ← r − α A p
//
// Directions vanish off the face, so A itself is applied and no restricted copy of it is built. The
// full gradient r comes along, whose other components decide which block to release next.
#pragma once

#include <slant/concepts/face.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/iteration/report.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/linear_system.hpp>
#include <slant/operators/held.hpp>

#include <limits>
#include <utility>

namespace slant {

/// State of face_cg.
template <class V, class WA>
struct face_cg_state {
  V x;                                 ///< iterate; equal to x₀ off the face
  V r;                                 ///< full gradient A x − b, in multiples of unit
  V φ;                                 ///< free gradient: r on the face, 0 elsewhere
  conjugate_directions<V> directions;  ///< p, Ap, pᵀAp
  WA a_workspace;                      ///< temporaries of A
  scalar_t<V> unit{1};                 ///< a power of two, see unit.hpp
  scalar_t<V> residual_norm{0};        ///< ‖φ‖
  scalar_t<V> residual_scale{0};       ///< ‖b‖, or ‖A x₀‖ if b = 0
  scalar_t<V> computed_norm =
      std::numeric_limits<scalar_t<V>>::infinity();  ///< at the last refresh
  bool updated = false;                              ///< r was updated since it was computed from x
  index iteration = 0;
  slant::status status = slant::status::running;
  slant::work work{};
};

/// Arguments that lack something end here and are told so; see iteration/detail/refused.hpp.
template <class A, class V, class F>
class face_cg : public detail::refused_method<std::remove_cvref_t<V>> {
  using a = detail::questions_about<std::remove_cvref_t<A>, std::remove_cvref_t<V>>;

  static_assert(vector<std::remove_cvref_t<V>>,
                "face_cg: b must be a slant::vector; an expression or a view is none");
  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "face_cg: A must be a linear operator on vectors like b");
  static_assert(detail::usable_part<typename a::part, typename a::vector_type>,
                "face_cg: a part of A cannot be used on vectors like b");
  static_assert(psd_operator<typename a::promise, typename a::vector_type>,
                "face_cg: A must declare self_adjoint and positive_semidefinite");
  static_assert(has_keep<detail::asked_t<vector<std::remove_cvref_t<V>>, std::remove_cvref_t<F>>,
                         typename a::vector_type>,
                "face_cg: the face must cut vectors down to it by keep(x, y)");

 public:
  using face_cg::refused_method::refused_method;
};

/// CG on a face: solve(face_cg{A, b, face}, x0, residual_below(1e-10)).
/// Requires psd_operator; A must be definite on the face, else the status is breakdown.
template <class A, class V, class F>
  requires vector<std::remove_cvref_t<V>> &&
           psd_operator<std::remove_cvref_t<A>, std::remove_cvref_t<V>> &&
           has_keep<std::remove_cvref_t<F>, std::remove_cvref_t<V>>
class face_cg<A, V, F> {
 public:
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = std::remove_cvref_t<V>;
  using scalar = scalar_t<vector_type>;
  using state_type = face_cg_state<vector_type, workspace_t<operator_type, vector_type>>;

  /// Throws bad_input if sizes do not match or b is not finite.
  face_cg(held<A> a, held<V> b, held<F> face)
      : a_(std::move(a)), b_(std::move(b)), face_(std::move(face)) {
    detail::check_linear_system(a_.get(), b_.get());
  }

  /// Throws bad_input if x0 or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start(x0, b_.get());
    auto const n = index(slant::local(x0).size());
    state_type s{x0, like(x0, n), like(x0, n), conjugate_directions<vector_type>(x0),
                 workspace(a_.get(), x0)};
    detail::start_residual(a_.get(), b_.get(), s);
    s.status = status::running;
    note(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    auto& d = s.directions;
    d.advance(s.φ);
    d.image(a_.get(), s.a_workspace);
    ++s.work.operator_applications;
    if (!(d.curvature > scalar(0))) {
      s.status = status::breakdown;
      return;
    }
    scalar const α = inner_product(s.r, d.p) / d.curvature;
    vectors::axpy(-(s.unit * α), d.p, s.x);
    vectors::axpy(-α, d.Ap, s.r);
    s.updated = true;
    note(s);
    ++s.iteration;
  }

  /// r from x, if steps have been updating it; the next direction is φ itself.
  bool refresh(state_type& s) const {
    s.directions.live = false;
    return detail::refresh_residual(a_.get(), b_.get(), s, [this](state_type& t) { note(t); });
  }

 private:
  void note(state_type& s) const {
    face_.get().keep(s.r, s.φ);
    s.residual_norm = s.unit * norm(s.φ);
    if (s.residual_norm == scalar(0)) s.status = status::converged;
    if (!detail::is_finite(s.residual_norm)) s.status = status::breakdown;
  }

  held<A> a_;
  held<V> b_;
  held<F> face_;
};

template <class A, class V, class F>
face_cg(A&&, V&&, F&&) -> face_cg<kept_t<A>, kept_t<V>, kept_t<F>>;

}  // namespace slant
