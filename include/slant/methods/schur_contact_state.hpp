// SPDX-License-Identifier: MIT
//
// The state of the Schur complement contact algorithm.
#pragma once

#include <slant/concepts/vector_algebra.hpp>
#include <slant/iteration/report.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/krylov/projected_directions.hpp>
#include <slant/methods/polyhedral_qp.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/methods/row_slacks.hpp>

#include <limits>
#include <string>

namespace slant {

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
  vector_type φ;                                 ///< V Vᵀr
  vector_type d;                                 ///< r − Bᵀλ, the projected gradient, as r
  vector_type trial;                             ///< scratch
  vector_type correction;                        ///< scratch
  vector_type descent;                           ///< direction without end, if unbounded
  row_vector λ;                                  ///< multipliers, see multipliers()
  row_vector row_units;                          ///< in which the rows of B are kept
  row_slacks<scalar> rows;                       ///< c − B u and J
  projected_directions<vector_type> directions;  ///< p, q = Q p, K q, qᵀKq
  workspace_t<typename P::operator_type, vector_type> k_workspace;
  workspace_t<typename P::projector_type, vector_type> q_workspace;
  slant::work work{};
  flat_direction<vector_type, definite> flat;  ///< tells directions of the kernel of K
  progress_watch<scalar> progress;             ///< looks for steps that get nowhere

  scalar unit{1};            ///< a power of two, see krylov/unit.hpp
  scalar residual_norm{0};   ///< ‖d‖, zero exactly at a solution
  scalar residual_scale{0};  ///< ‖f‖, or ‖K u₀‖ if f = 0
  scalar φ_norm{0};          ///< ‖φ‖ / unit
  scalar β_norm{0};          ///< ‖d − φ‖ / unit
  bool regular = false;      ///< K has no kernel on this face
  bool updated = false;      ///< x has moved since slacks were measured at it

  scalar computed_norm = std::numeric_limits<scalar>::infinity();  ///< when it last seemed stalled
  schur_contact_trouble trouble = schur_contact_trouble::none;     ///< see reason()

  index projector_applications = 0;  ///< of Q, or of U(UᵀKU)⁻¹Uᵀ
  index releases = 0;                ///< how often rows were released
  schur_contact_step last_step = schur_contact_step::none;
  index iteration = 0;
  slant::status status = slant::status::running;

  schur_contact_state(P const& p, vector_type const& x0)
      : x(x0),
        r(like(x0, p.size())),
        φ(r),
        d(r),
        trial(r),
        correction(r),
        descent(r),
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

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the residual vanishes and no multiplier is negative";
      case slant::status::unbounded:
        return "no solution: the energy falls for ever along `descent`";
      case slant::status::stalled:
        if (trouble == schur_contact_trouble::patience) {
          return "neither the residual nor the energy has fallen any more";
        }
        return "rounding errors leave no direction in which the energy falls";
      case slant::status::breakdown:
        if (trouble == schur_contact_trouble::moved_row) {
          return "the projector moves a row of B: it is not that of a U with B U = 0";
        }
        return "a number left the range of the scalar, or K is not positive semidefinite";
      default:
        return std::string(to_string(status));
    }
  }
};

}  // namespace slant
