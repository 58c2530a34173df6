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
// projected search, below.
#pragma once

#include <slant/base/progress_watch.hpp>
#include <slant/base/report.hpp>
#include <slant/base/scaling.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/methods/parts/active_rows.hpp>
#include <slant/problems/polyhedral_qp.hpp>
#include <slant/sets/blocks.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// Options of schur_contact.
template <scalar S = double>
struct schur_contact_options {
  /// Γ ≥ 0 in the test of the residuum [D (ix)]: rows are released where ‖φ‖ ≤ Γ ‖β‖, φ = V Vᵀr
  /// what the face can still gain and β what releasing rows can. 0: only where φ = 0 up to
  /// rounding, as the paper has it. Measured on stacks of bricks: ½ and 1 alike, 0 three to four
  /// times the steps.
  S release = S(0.5);
  /// Points P(u + t q), t = α, α/2, …, that are tried where the step to the minimum along q leaves
  /// the set, before the step to the first constraint. Each costs one product and one application
  /// of Q. 0: the paper's update, by one index as a rule. Measured on stacks of bricks with gaps: 1
  /// and 3 alike, half of the products and a sixth of the changes of J that 0 needs; without gaps
  /// no difference.
  index projected_trials = 1;
  index patience = 1000;  ///< steps in which neither the residual nor the energy falls: stalled

  [[gnu::cold]] void validate() const {
    detail::check_option("release", release, release >= S(0) && detail::is_finite(release),
                         "a number >= 0");
    detail::check_option("projected_trials", projected_trials, projected_trials >= 0,
                         "a number >= 0");
    if (patience < 0) throw bad_input("patience", detail::show(patience), "a number >= 0");
  }
};

/// What the last step did: a conjugate gradient step to the minimum along q, one to the first
/// constraint, or one beyond it along the boundary. Rows may have been released before it.
enum class schur_contact_step : unsigned char { none, conjugate_gradient, blocked, projected };

/// Why a run has ended as stalled or with a breakdown.
enum class schur_contact_trouble : unsigned char { none, precision, patience, moved_row };

/// State of schur_contact for a polyhedral_qp of type P.
template <class P>
struct schur_contact_state {
  using vector_type = typename P::vector_type;
  using scalar = typename P::scalar;
  using row_vector = typename constraint_rows<scalar>::vector_type;
  static constexpr bool definite = declares_positive_definite<typename P::operator_type>;

  vector_type x;                                 ///< u, with B u ≤ c
  vector_type r;                                 ///< f − K u, in multiples of unit
  vector_type φ = r;                             ///< V Vᵀr
  vector_type d = r;                             ///< r − Bᵀλ, the projected gradient, as r
  vector_type trial = r;                         ///< scratch
  vector_type correction = r;                    ///< scratch
  vector_type descent = r;                       ///< direction without end, if unbounded
  row_vector λ;                                  ///< multipliers, see multipliers()
  row_vector row_units;                          ///< in which the rows of B are kept
  row_slacks<scalar> rows;                       ///< c − B u and J
  projected_directions<vector_type> directions;  ///< p, q = Q p, K q, qᵀKq
  workspace_t<typename P::operator_type, vector_type> k_workspace;
  workspace_t<typename P::projector_type, vector_type> q_workspace;
  slant::work work{};
  flat_direction<vector_type, definite> flat;  ///< tells directions of the kernel of K
  progress_watch<scalar> progress;             ///< looks for steps that get nowhere

  scalar unit{1};            ///< a power of two, see base/scaling.hpp
  scalar residual_norm{0};   ///< ‖d‖, zero exactly at a solution
  scalar residual_scale{0};  ///< ‖f‖, or ‖K u₀‖ if f = 0
  scalar φ_norm{0};          ///< ‖φ‖ / unit
  scalar β_norm{0};          ///< ‖d − φ‖ / unit
  bool regular = false;      ///< K has no kernel on this face
  bool updated = false;      ///< x has moved since slacks were measured at it

  scalar computed_norm = detail::infinity<scalar>();            ///< when it last seemed stalled
  schur_contact_trouble trouble = schur_contact_trouble::none;  ///< see reason()

  index projector_applications = 0;  ///< of Q, or of U(UᵀKU)⁻¹Uᵀ
  index releases = 0;                ///< how often rows were released
  schur_contact_step last_step = schur_contact_step::none;
  index iteration = 0;
  slant::status status = slant::status::running;

  schur_contact_state(P const& p, vector_type const& x0)
      : x(x0),
        r(like(x0, p.size())),
        λ(row_vector::Zero(p.rows().count())),
        row_units(p.rows().units()),
        rows(p.rows()),
        directions(x0),
        k_workspace(workspace(p.k(), x0)),
        q_workspace(workspace(p.projection(), x0)),
        flat(p.k(), x0, work.setup_applications) {
    vectors::set_zero(descent);
  }

  /// The Lagrange multipliers of B u ≤ c, ≥ 0: forces. In λ they are in multiples of unit, and
  /// belong to the rows of B in the units of those.
  [[nodiscard]] row_vector multipliers() const { return unit * λ.cwiseQuotient(row_units); }

  [[nodiscard, gnu::cold]] std::string reason() const {
    return detail::reason_of(
        status,
        {.converged = "the residual vanishes and no multiplier is negative",
         .stalled = trouble == schur_contact_trouble::patience
                        ? "neither the residual nor the energy has fallen any more"
                        : "rounding errors leave no direction in which the energy falls",
         .unbounded = "no solution: the energy falls for ever along `descent`",
         .breakdown = trouble == schur_contact_trouble::moved_row
                          ? "the projector moves a row of B: it is not that of a U with B U = 0"
                          : "a number left the range of the scalar, or K is not positive "
                            "semidefinite"});
  }
};

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

  /// Throws bad_input for options out of range.
  explicit schur_contact(held<P> p, options o = {}) : p_(std::move(p)), options_(o) {
    options_.validate();
  }

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
    minimise_inside(s);
    note_contact_residual(s);
    return s;
  }

  void step(state_type& s) const {
    if (s.status != status::running) return;
    if (s.β_norm > scalar(0) && s.φ_norm <= Γ(s) * s.β_norm) release(s);
    if (s.status == status::running && s.φ_norm == scalar(0)) stall(s);
    if (s.status == status::running) conjugate_step(s);
    if (s.status == status::running) note_progress(s);
    if (s.status == status::stalled) look_again(s);
    ++s.iteration;
  }

  /// Slacks and r from x, if steps have been updating them. One product, or two where rounding
  /// errors have carried x over a bound or away from one, which is then put right.
  bool refresh(state_type& s) const {
    if (!s.updated) return false;
    s.status = status::running;
    measure_anew(s, false);
    return true;
  }

 private:
  static constexpr scalar infinity = detail::infinity<scalar>();

  // --- parts -------------------------------------------------------------------------------------
  //
  // Parts C and D of the Schur complement contact algorithm [D §5]: the residual, and what the
  // active set makes of it.

  /// (vii).
  void compute_residual(state_type& s) const {
    auto const& p = p_.get();
    slant::apply(p.k(), s.x, s.r, s.k_workspace);
    ++s.work.operator_applications;
    vectors::difference(p.f(), s.r, s.r);
    vectors::scale(scalar(1) / s.unit, s.r);
  }
  /// (vi), (vii).
  void minimise_inside(state_type& s) const {
    auto const& p = p_.get();
    p.projection().add_minimiser(s.unit, s.r, s.x, s.q_workspace);
    ++s.projector_applications;
    compute_residual(s);
  }
  /// (viii), (x): φ, d, λ of r, and what follows from them for the status.
  void note_contact_residual(state_type& s) const {
    auto const& p = p_.get();
    auto const& rows = p.rows();
    s.rows.active.project_on_kernel(rows, s.r, s.φ);
    s.rows.active.project_on_cone(rows, s.r, s.d, s.λ);
    // What both are differences of has rounding errors of this size; along such a φ, which is in no
    // kernel, a step can be long.
    scalar const zero = scalar(16) * detail::epsilon<scalar>() * norm(s.r);
    s.φ_norm = norm(s.φ);
    if (s.φ_norm <= zero) {
      vectors::set_zero(s.φ);
      s.φ_norm = scalar(0);
    }
    scalar const size = norm(s.d);
    s.residual_norm = s.unit * size;
    vectors::difference(s.d, s.φ, s.trial);
    s.β_norm = size > zero ? norm(s.trial) : scalar(0);
    if (size <= zero) s.status = status::converged;
    if (!detail::is_finite(s.residual_norm)) s.status = status::breakdown;
  }

  /// Slacks, J and r of s.x from s.x alone. What rounding errors of iterates far away have made of
  /// it is put right: rows that are violated by more than those of x itself, or that have left
  /// their bound while they were in J. u is minimised over U again if `inside`, and where that has
  /// moved x.
  void measure_anew(state_type& s, bool inside) const {
    auto const& p = p_.get();
    s.updated = false;
    s.directions.live = false;
    s.rows.forget();
    s.rows.measure(p.rows(), s.x);
    bool const sound = everywhere(s.x, s.rows.is_feasible() && s.rows.are_tight(p.rows(), s.x));
    if (!sound) {
      (void)s.rows.active.project_on_set(p.rows(), s.x, s.λ);
      s.rows.measure(p.rows(), s.x);
      s.rows.take_tight(p.rows());
      s.regular = false;
    }
    compute_residual(s);
    note_contact_residual(s);
    if (sound && !inside) return;
    minimise_inside(s);
    note_contact_residual(s);
  }

  // --- kernel ------------------------------------------------------------------------------------
  //
  // Where the Schur complement contact algorithm cannot go on by conjugate gradients: directions of
  // the kernel of K, and progress that has ended.

  /// Replaces q by a direction of the kernel near it in which j falls, if there is one.
  bool finds_kernel(state_type& s) const {
    auto const& p = p_.get();
    auto& q = s.directions;
    detail::kernel_projector<scalar> const c(p.rows(), s.rows.active);
    no_workspace none;
    auto const search = s.flat.split(q, p.k(), s.k_workspace, c, none, p.projection(),
                                     s.q_workspace, global_size(s.x));
    s.work.operator_applications += search.products;
    s.projector_applications += search.projections;
    s.regular = true;  // until a row leaves
    if (!search.found) return false;
    scalar const slope = inner_product(s.r, q.q);
    scalar const size = (s.residual_scale + s.flat.force(s.x)) / s.unit;
    using std::abs;
    if (!is_descent(scalar(abs(slope)), q.q, size)) {
      s.flat.restore(q);
      return false;
    }
    q.live = false;
    s.regular = false;
    if (slope >= scalar(0)) return true;
    vectors::scale(scalar(-1), q.q);
    vectors::scale(scalar(-1), q.Ap);
    return true;
  }

  /// Stalled if neither the residual nor the energy has fallen for `patience` steps.
  void note_progress(state_type& s) const {
    auto const energy = [&] {
      scalar const of_load = inner_product(p_.get().f(), s.x);
      scalar const of_rest = s.unit * inner_product(s.r, s.x);
      using std::abs;
      return std::pair(
          scalar(-(of_load + of_rest) / scalar(2)),
          scalar(scalar(8) * detail::epsilon<scalar>() * (abs(of_load) + abs(of_rest))));
    };
    if (s.progress.stalled(s.iteration, s.residual_norm, options_.patience, energy)) {
      s.trouble = schur_contact_trouble::patience;
      s.status = status::stalled;
    }
  }

  // --- projected search --------------------------------------------------------------------------
  //
  // More than one row at a time [D §6; Calamai, Moré 1987]: where the step α to the minimum along q
  // leaves B u ≤ c, the points
  //
  //     P(u + t q),   t = α, α/2, … > α₁,     P onto { B u ≤ c },
  //
  // are tried before the step α₁ to the first constraint. P changes no unknown of U, which follow
  // by Q: with e = P(u + t q) − (u + t q) the trial point is u + t q + Q e, and its residual r − t
  // K q − K Q e is again orthogonal to U. It is taken if j falls by as much as it would with α₁,
  // and if no row of J has left its bound: J then grows, as it does with α₁, and what is known of
  // the finite termination remains. One product and one application of Q for each. Directions that
  // are flat to half of the digits are not followed so far.

  /// Moves s to the first trial point that is good enough, with its r and J; false if none is.
  [[nodiscard]] bool projected_search(state_type& s, scalar const& α, scalar const& α1) const {
    auto const& p = p_.get();
    index const trials = options_.projected_trials;
    auto const& q = s.directions;
    if (trials == 0 || s.flat.is_nearly_flat(q)) return false;
    scalar const gain = α1 * (inner_product(s.r, q.q) - α1 * q.curvature / scalar(2));
    scalar t = α;
    for (index i = 0; i < trials && t > α1; ++i, t /= scalar(2)) {
      vectors::waxpy(s.unit * t, q.q, s.x, s.trial);
      vectors::copy(s.trial, s.d);
      s.rows.note_sizes(p.rows(), s.trial);
      (void)s.rows.active.project_on_set(p.rows(), s.trial, s.λ);
      if (!everywhere(s.x, s.rows.are_tight(p.rows(), s.trial))) continue;
      vectors::difference(s.trial, s.d, s.d);
      vectors::scale(scalar(1) / s.unit, s.d);
      slant::apply(p.projection(), s.d, s.correction, s.q_workspace);
      slant::apply(p.k(), s.correction, s.d, s.k_workspace);
      ++s.work.operator_applications;
      ++s.projector_applications;
      vectors::axpy(t, q.q, s.correction);
      vectors::difference(s.r, s.d, s.d);
      vectors::axpy(-t, q.Ap, s.d);
      vectors::sum(s.r, s.d, s.trial);
      if (!(inner_product(s.correction, s.trial) / scalar(2) >= gain)) continue;
      vectors::axpy(s.unit, s.correction, s.x);
      vectors::copy(s.d, s.r);
      s.updated = true;
      s.rows.measure(p.rows(), s.x);
      s.rows.take_tight(p.rows());
      s.directions.live = false;
      s.last_step = schur_contact_step::projected;
      return true;
    }
    return false;
  }

  /// See the top of this file; what is below the least value is rounding error of φ.
  scalar Γ(state_type const& s) const {
    using std::ldexp;
    scalar const least = scalar(4096) * detail::epsilon<scalar>();
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
    minimise_inside(s);
    note_contact_residual(s);
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
    bool const flat = (last || !s.regular) && s.flat.is_nearly_flat(q) && finds_kernel(s);
    if (last && !flat) {
      give_up_face(s);
      return;
    }
    scalar const α = flat ? infinity : scalar(inner_product(s.r, q.q) / q.curvature);  // (xiv)
    // A flat q has rounding errors everywhere, also where it should not move at all.
    using std::pow;
    scalar const noise =
        flat ? pow(detail::epsilon<scalar>(), scalar(0.75)) * norm(q.q) : scalar(0);
    scalar const α1 = minimum(s.x, s.rows.first_constraint(p.rows(), q.q, s.unit, noise));
    if (α < α1) {
      advance(s, α);
      s.last_step = schur_contact_step::conjugate_gradient;
    } else if (!(α1 < infinity)) {
      s.status = status::unbounded;
      vectors::copy(q.q, s.descent);
      return;
    } else if (flat || !projected_search(s, α, α1)) {
      advance(s, α1);
      s.rows.take_blocking(p.rows(), α1);
      q.live = false;
      s.last_step = schur_contact_step::blocked;
    }
    note_contact_residual(s);
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
    measure_anew(s, true);
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
schur_contact(P&&, schur_contact_options<set_scalar_t<P>> = {}) -> schur_contact<kept_t<P>>;

}  // namespace slant
