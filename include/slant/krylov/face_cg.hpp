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

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/base/report.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/krylov/linear_system.hpp>

#include <string>
#include <utility>
#include <vector>

namespace slant {

/// State of face_cg: x, equal to x₀ off the face, with the full gradient r; the residual is φ.
template <class V, class WA>
struct face_cg_state : detail::residual_state<V> {
  V φ;                                 ///< free gradient: r on the face, 0 elsewhere
  conjugate_directions<V> directions;  ///< p, Ap, pᵀAp
  WA a_workspace;                      ///< temporaries of A
};

namespace detail {

/// φ from r, and its norm.
template <class Face, class State>
void note_free_gradient(Face const& face, State& s) {
  face.keep(s.r, s.φ);
  note_norm(s, norm(s.φ));
}

}  // namespace detail

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class A, class V, class F>
class face_cg : public detail::refused_method<std::remove_cvref_t<V>> {
  using vector_type = std::remove_cvref_t<V>;

  static_assert(detail::vector_demands<vector_type>::told);
  static_assert(detail::operator_demands<std::remove_cvref_t<A>, vector_type,
                                         detail::law_demand::semidefinite>::told);
  static_assert(has_keep<detail::asked_t<vector<vector_type>, std::remove_cvref_t<F>>,
                         detail::asked_t<vector<vector_type>, vector_type>>,
                "the face must cut vectors down to it by keep(x, y)");

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
    state_type s{{x0}, like(x0, n), conjugate_directions<vector_type>(x0), workspace(a_.get(), x0)};
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
  void note(state_type& s) const { detail::note_free_gradient(face_.get(), s); }

  held<A> a_;
  held<V> b_;
  held<F> face_;
};

template <class A, class V, class F>
face_cg(A&&, V&&, F&&) -> face_cg<kept_t<A>, kept_t<V>, kept_t<F>>;

// --- cg feas -------------------------------------------------------------------------------------
//
// CG_feas [K §3.3.4 (ii)]: conjugate gradients on a face that do not leave a convex set Λ. Where a
// step would, a half step is taken to the boundary and the run ends.
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over the free components of a face, as long as x ∈ Λ

/// State of cg_feas: x ∈ Λ, equal to x₀ off the face, with the full gradient r; the residual is φ.
template <class V, class WA>
struct cg_feas_state : detail::residual_state<V> {
  V φ;                                 ///< free gradient: r on the face, 0 elsewhere
  V trial;                             ///< scratch
  conjugate_directions<V> directions;  ///< p, Ap, pᵀAp
  WA a_workspace;                      ///< temporaries of A
  index since_refresh = 0;             ///< steps since r was computed from x
  bool at_boundary = false;            ///< the last step was a half step
  std::vector<index> blocked{};        ///< the blocks that made it one

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    return at_boundary ? "the boundary of the set is reached before the minimum on the face"
                       : "the method reports: " + std::string(to_string(this->status));
  }
};

/// Arguments that lack something end here and are told so; see base/diagnosis.hpp.
template <class A, class V, class C, class F>
class cg_feas : public detail::refused_method<std::remove_cvref_t<V>> {
  template <class T>
  using asked = detail::asked_t<vector<std::remove_cvref_t<V>>, std::remove_cvref_t<T>>;

  static_assert(detail::vector_demands<std::remove_cvref_t<V>>::told);
  static_assert(detail::operator_demands<std::remove_cvref_t<A>, std::remove_cvref_t<V>,
                                         detail::law_demand::semidefinite>::told);
  static_assert(has_step_to_boundary<asked<C>, local_t<asked<V>>>,
                "the set must tell its step_to_boundary(x, d)");
  static_assert(has_keep<asked<F>, asked<V>>, "the face must cut vectors down to it by keep(x, y)");

 public:
  using cg_feas::refused_method::refused_method;
};

/// CG in a set and on a face: solve(cg_feas{A, b, set, face}, x0, residual_below(1e-10)).
/// Requires psd_operator and a convex set with step_to_boundary. Statuses: stalled with
/// state.at_boundary after a half step, state.blocked telling whose boundary it was; unbounded if
/// neither q nor Λ ends along −p; breakdown if A was seen not to be semidefinite.
template <class A, class V, class C, class F>
  requires vector<std::remove_cvref_t<V>> &&
           psd_operator<std::remove_cvref_t<A>, std::remove_cvref_t<V>> &&
           convex_set<std::remove_cvref_t<C>, local_t<std::remove_cvref_t<V>>> &&
           has_step_to_boundary<std::remove_cvref_t<C>, local_t<std::remove_cvref_t<V>>> &&
           has_keep<std::remove_cvref_t<F>, std::remove_cvref_t<V>>
class cg_feas<A, V, C, F> {
 public:
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = std::remove_cvref_t<V>;
  using scalar = scalar_t<vector_type>;
  using state_type = cg_feas_state<vector_type, workspace_t<operator_type, vector_type>>;

  /// Throws bad_input if sizes do not match or b is not finite.
  cg_feas(held<A> a, held<V> b, held<C> set, held<F> face)
      : a_(std::move(a)), b_(std::move(b)), set_(std::move(set)), face_(std::move(face)) {
    detail::check_linear_system(a_.get(), b_.get());
    detail::check_size("dimension of the set", slant::dimension_of(set_.get()),
                       index(slant::local(b_.get()).size()));
  }

  /// Throws bad_input if x0 is not in Λ, or if x0 or A x0 is not finite or of the wrong size.
  [[nodiscard]] state_type start(vector_type const& x0) const {
    detail::check_start(x0, b_.get());
    if (!slant::everywhere(x0, set_.get().contains(slant::local(x0)))) {
      throw bad_input("x0", "a point outside", "a point of the set");
    }
    auto const n = index(slant::local(x0).size());
    state_type s{{x0},
                 like(x0, n),
                 like(x0, n),
                 conjugate_directions<vector_type>(x0),
                 workspace(a_.get(), x0)};
    s.blocked.reserve(static_cast<std::size_t>(slant::block_count(set_.get())));
    detail::start_residual(a_.get(), b_.get(), s);
    s.status = status::running;
    note(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    next_direction(a_.get(), s);
    ++s.iteration;
    auto const step = step_within(set_.get(), s, scalar(0));
    switch (step.end) {
      case feasible_step_end::minimum:
        s.updated = true;
        note(s);
        return;
      case feasible_step_end::boundary:
        find_blocking(set_.get(), slant::local(s.x), slant::local(s.trial), step.length, s.blocked);
        half_step_within(set_.get(), s, step);
        s.updated = true;
        note(s);
        s.at_boundary = true;
        if (s.status == status::running) s.status = status::stalled;
        return;
      case feasible_step_end::endless:
        s.status = step.flat ? status::unbounded : status::breakdown;
        return;
      default:
        s.status = status::breakdown;
    }
  }

  /// r from x, if steps have been updating it; the next direction is φ itself.
  bool refresh(state_type& s) const {
    s.directions.live = false;
    s.since_refresh = 0;
    return detail::refresh_residual(a_.get(), b_.get(), s, [this](state_type& t) { note(t); });
  }

 private:
  void note(state_type& s) const { detail::note_free_gradient(face_.get(), s); }

  held<A> a_;
  held<V> b_;
  held<C> set_;
  held<F> face_;
};

template <class A, class V, class C, class F>
cg_feas(A&&, V&&, C&&, F&&) -> cg_feas<kept_t<A>, kept_t<V>, kept_t<C>, kept_t<F>>;

}  // namespace slant
