// SPDX-License-Identifier: MIT
//
// The Schur complement algorithm for contact problems [D §5]:
//
//     minimise   j(u) = ½ uᵀK u − fᵀu   over   B u ≤ c,     K = diag(K₁, …, K_p) semidefinite
//
//     A  (i)–(iii)     U: unknowns in no row of B; factors of UᵀKU; u
//     B  (iv), (v)     J = { i : b_iᵀu = c_i };  V = (U, V₀) spans ker B^J
//     C  (vi), (vii)   u ← u + U(UᵀKU)⁻¹Uᵀr,  r = f − K u
//     D  (viii), (ix)  Vᵀr = 0?  else E
//        (x)–(xii)     r = Bᵀλ;  λ ≥ 0: solution;  else rows leave J, and (v)
//     E  (xiii)        q = Q p
//        (xiv)         α = rᵀq / qᵀK q,  α₁ = min { (c_i − b_iᵀu) / b_iᵀq : b_iᵀq > 0 }
//        (xv), (xvi)   u ← u + min(α, α₁) q,  r ← r − min(α, α₁) K q
//        (xvii)        p = V Vᵀr − β p;  α < α₁: D, else B
//
// V is never formed: with orthonormal columns V Vᵀ is the orthogonal projector onto ker B^J. Q does
// not change when J does. A step costs one product with K and one application of Q. (vi) after a
// step (xv) would change nothing, because Qᵀr = r; it is made at the start and where rows leave.
//
// Which rows leave. Let d be the projection of r onto the tangent cone { d : b_iᵀd ≤ 0, i ∈ J }, r
// = Bᵀλ + d with λ ≥ 0 on J: a well-conditioned least-squares problem with λ for its answer. d = 0
// means that u is the solution, however many rows are redundant. Else J becomes { i ∈ J : b_iᵀd = 0
// }. Where rows are orthogonal that is (xii), the rows of negative multipliers leave; where they
// are not, dropping those may give a direction that a row which has just left blocks at α₁ = 0.
//
// Finite termination. Along d, the first direction of the new face, no tight row blocks (b_iᵀd ≤ 0)
// and rᵀd = ‖d‖² > 0: the step is longer than 0 and j falls. Steps with α₁ = 0 are possible only
// where a further row has become tight, along which a direction of ker B^J leaves: the rank of B^J
// grows with each, so that at most rank B of them follow each other, and none removes a row. (Rows
// that are met at the same point enter together, also those that depend on the others.) With exact
// minimisation on faces j at the minima of faces falls strictly from one release to the next: no
// face comes back, and there are finitely many. For Γ = release > 0 faces are left early where β
// outweighs φ, as in proportioning [Dostál 1997]; Γ is halved with each release after the first
// eight, down to the rounding errors of φ, so that there are finitely many early ones.
//
// No solution. A direction of the kernel of K along which j falls and that no row blocks ends the
// run; how one is told from a direction of small curvature is in krylov/flat_direction.hpp.
//
// Rows leave in any number. More than one at a time enter by a search along the boundary, see
// projected_search.hpp.
#pragma once

#include <slant/concepts/distributed.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/krylov/unit.hpp>
#include <slant/methods/detail/moved_rows.hpp>
#include <slant/methods/detail/schur_contact_kernel.hpp>
#include <slant/methods/detail/schur_contact_parts.hpp>
#include <slant/methods/projected_search.hpp>
#include <slant/methods/schur_contact_options.hpp>
#include <slant/methods/schur_contact_state.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

/// The method at the top of this file: solve(schur_contact{problem}, u0, residual_below(1e-10) ||
/// at_most(5000)). Begins at the point of B u ≤ c nearest to u0. Statuses of its own: converged (d
/// = 0), unbounded (no solution; the state has the direction), stalled, breakdown.
template <class P>
  requires polyhedral_program<std::remove_cvref_t<P>>
class schur_contact<P> {
 public:
  using problem = std::remove_cvref_t<P>;
  using vector_type = typename problem::vector_type;
  using scalar = typename problem::scalar;
  using options = schur_contact_options<scalar>;
  using state_type = schur_contact_state<problem>;

  explicit schur_contact(held<P> p) : schur_contact(std::move(p), options{}) {}
  /// Throws bad_input for options out of range.
  schur_contact(held<P> p, options o) : p_(std::move(p)), options_(o) { options_.validate(); }

  /// A, B, C. Throws bad_input if u0 or K u0 is not finite or of the wrong size, if no u satisfies
  /// B u ≤ c, or if the projector moves a row of B.
  [[nodiscard]] state_type start(vector_type const& u0) const {
    auto const& p = p_.get();
    detail::check_size("u0", index(slant::local(u0).size()), p.size(), "the size of f,");
    detail::check_finite("u0", u0);
    detail::check_projector(p.rows(), p.projection());
    state_type s(p, u0);
    s.rows.measure(p.rows(), s.x);
    // From far away the nearest point has the rounding errors of the way to it; from there it has
    // not.
    for (int tries = 0; tries < 3 && !everywhere(s.x, s.rows.is_feasible()); ++tries) {
      if (!everywhere(s.x, s.rows.active.project_on_set(p.rows(), s.x, s.λ))) {
        throw bad_input("c", "bounds that exclude each other", "a u with B u <= c");
      }
      s.rows.forget();
      s.rows.measure(p.rows(), s.x);
    }
    slant::apply(p.k(), s.x, s.r, s.k_workspace);
    ++s.work.operator_applications;
    detail::check_finite("K u0", s.r);
    s.residual_scale = norm(p.f());
    if (s.residual_scale == scalar(0)) s.residual_scale = norm(s.r);
    s.unit = unit_near(std::max<scalar>(s.residual_scale, norm(s.r)));
    vectors::difference(p.f(), s.r, s.r);
    vectors::scale(scalar(1) / s.unit, s.r);
    s.rows.take_tight(p.rows());
    detail::minimise_inside(p, s);
    detail::note_contact_residual(p, s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (s.β_norm > scalar(0) && s.φ_norm <= Γ(s) * s.β_norm) release(s);
    if (s.status == status::running && s.φ_norm == scalar(0)) stall(s);
    if (s.status == status::running) conjugate_step(s);
    if (s.status == status::running) detail::note_progress(p_.get(), s, options_.patience);
    if (s.status == status::stalled) look_again(s);
    ++s.iteration;
  }

  /// Slacks and r from x, if steps have been updating them. One product, or two where rounding
  /// errors have carried x over a bound or away from one, which is then put right.
  bool refresh(state_type& s) const {
    if (!s.updated) return false;
    s.status = status::running;
    detail::measure_anew(p_.get(), s, false);
    return true;
  }

 private:
  static constexpr scalar infinity = std::numeric_limits<scalar>::infinity();

  /// release, halved with each release after the first eight; what is below the least value is
  /// rounding error of φ.
  scalar Γ(state_type const& s) const {
    using std::ldexp;
    scalar const least = scalar(4096) * std::numeric_limits<scalar>::epsilon();
    int const halvings = static_cast<int>(std::clamp<index>(s.releases - 8, 0, 2000));
    return std::max<scalar>(least, ldexp(options_.release, -halvings));
  }
  /// (xii), (v)–(vii): rows leave J along which d moves away.
  void release(state_type& s) const {
    // Every process has rows of its own; what follows is done by all of them or by none.
    bool const left = s.rows.leave_along(p_.get().rows(), s.r, s.d, s.λ);
    if (everywhere(s.x, !left)) return;
    s.directions.live = false;
    s.regular = false;
    ++s.releases;
    detail::minimise_inside(p_.get(), s);
    detail::note_contact_residual(p_.get(), s);
  }

  /// (xviii), (xiii).
  void next_direction(state_type& s) const {
    auto const& p = p_.get();
    s.directions.advance(s.φ);
    s.directions.image(p.k(), s.k_workspace, p.projection(), s.q_workspace);
    ++s.work.operator_applications;
    ++s.projector_applications;
  }
  /// E
  void conjugate_step(state_type& s) const {
    auto const& p = p_.get();
    auto& q = s.directions;
    next_direction(s);
    bool const moved =
        detail::moves_rows(p.rows(), p.projection(), q.p, q.q, s.trial, s.rows.rates);
    if (!everywhere(s.x, !moved)) {
      s.trouble = schur_contact_trouble::moved_row;
      s.status = status::breakdown;
      return;
    }
    // rᵀq = ‖φ‖² in exact arithmetic; where φ was all but a multiple of p nothing is left of it.
    bool const lost = !(scalar(2) * inner_product(s.r, q.q) >= s.φ_norm * s.φ_norm);
    if (lost && std::exchange(q.live, false)) next_direction(s);
    auto const leads_nowhere = [&] {
      return s.flat.is_flat(q) || !(q.curvature > scalar(0) && inner_product(s.r, q.q) > scalar(0));
    };
    // Before the face is given up a kernel is looked for also where none was found before.
    bool const last = leads_nowhere();
    bool const flat =
        (last || !s.regular) && s.flat.is_nearly_flat(q) && detail::finds_kernel(p, s);
    if (last && !flat) {
      give_up_face(s);
      return;
    }
    scalar const α = flat ? infinity : scalar(inner_product(s.r, q.q) / q.curvature);  // (xiv)
    // A flat q has rounding errors everywhere, also where it should not move at all.
    using std::pow;
    scalar const noise =
        flat ? pow(std::numeric_limits<scalar>::epsilon(), scalar(0.75)) * norm(q.q) : scalar(0);
    scalar const α1 = minimum(s.x, s.rows.first_constraint(p.rows(), q.q, s.unit, noise));
    if (α < α1) {
      advance(s, α);
      s.last_step = schur_contact_step::conjugate_gradient;
    } else if (!(α1 < infinity)) {
      s.status = status::unbounded;
      vectors::copy(q.q, s.descent);
      return;
    } else if (flat || !projected_search(p, s, options_.projected_trials, α, α1)) {
      advance(s, α1);
      s.rows.take_blocking(p.rows(), α1);
      q.live = false;
      s.last_step = schur_contact_step::blocked;
    }
    detail::note_contact_residual(p_.get(), s);
  }
  /// (xv), (xvi).
  void advance(state_type& s, scalar const& α) const {
    vectors::axpy(s.unit * α, s.directions.q, s.x);
    vectors::axpy(-α, s.directions.Ap, s.r);
    s.rows.advance(p_.get().rows(), s.directions.q, s.unit * α);
    s.updated = true;
  }

  /// The face is solved as well as the precision allows: rows are released, or nothing is left.
  void give_up_face(state_type& s) const {
    index const before = s.releases;
    bool const broken = !(s.directions.curvature >= scalar(0)) && !s.flat.is_flat(s.directions);
    if (!broken && s.β_norm > scalar(0)) release(s);
    if (broken) s.status = status::breakdown;
    if (s.releases == before && s.status == status::running) stall(s);
  }
  void stall(state_type& s) const {
    s.trouble = schur_contact_trouble::precision;
    s.status = status::stalled;
  }
  /// Rounding errors of iterates that are long past may be what it has stalled on; goes on as long
  /// as looking at x alone gives half of the residual that it gave the last time.
  void look_again(state_type& s) const {
    auto const trouble = s.trouble;
    s.status = status::running;
    detail::measure_anew(p_.get(), s, true);
    if (s.status != status::running) return;
    s.progress = {};
    if (!(s.residual_norm < s.computed_norm / scalar(2))) {
      s.status = status::stalled;
      s.trouble = trouble;
    }
    s.computed_norm = s.residual_norm;
  }

  held<P> p_;
  options options_;
};

template <class P>
schur_contact(P&&) -> schur_contact<kept_t<P>>;
template <class P>
schur_contact(P&&, schur_contact_options<typename std::remove_cvref_t<P>::scalar>)
    -> schur_contact<kept_t<P>>;

}  // namespace slant
