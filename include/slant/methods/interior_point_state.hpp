// SPDX-License-Identifier: MIT
//
// The state of the interior-point method.
#pragma once

#include <slant/iteration/report.hpp>
#include <slant/methods/barrier.hpp>
#include <slant/methods/barrier_minimum.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/lorentz_pairs.hpp>
#include <slant/methods/progress_watch.hpp>
#include <slant/newton/forcing.hpp>

#include <limits>
#include <string>

namespace slant {

/// State of interior_point for a separable_qp of type QP with the preconditioner M. x in the
/// interior of Λ with its gradient r and its reduced gradient are those of gradient_point. Vectors
/// of multipliers have one entry per inequality of the set, those of unknowns qp.size().
template <class QP, class M>
struct interior_point_state : gradient_point<QP> {
  using typename gradient_point<QP>::vector_type;
  using typename gradient_point<QP>::scalar;

  slant::barrier<scalar> barrier;  ///< inequalities, G, W, P_SC at x
  lorentz_pairs<scalar> pairs;     ///< forces on discs and cones, in multiples of unit
  vector_type multipliers;         ///< ν > 0; 0 where there is no bound. The multiplier of f_i is
                                   ///< unit · ν_i · barrier.per_unit()_i; of pairs an estimate
  vector_type slacks;              ///< z = −f(x)/σ > 0, lengths
  vector_type lagrangian;          ///< ∇L = r + G ν − Σ Tᵀy, in multiples of unit
  vector_type products;            ///< ν_i z_i; pᵀy in the first row of a pair
  vector_type counted;          ///< 1 in the rows of which ϑ is the mean of the products, else 0
  vector_type smooth;           ///< 1 in those of them that belong to no pair, else 0
  vector_type diagonal;         ///< D ≈ diag(A), of M if there is one
  vector_type centre;           ///< a point in the middle of every block
  vector_type step;             ///< Δx
  vector_type multiplier_step;  ///< Δν
  vector_type slack_step;       ///< −Δz = GᵀΔx
  vector_type rhs;              ///< scratch: minus the right-hand side of [K (43)]
  vector_type row_scratch;      ///< scratch, one entry per inequality
  vector_type trial_slacks, trial_multipliers;  ///< those of the trial point
  barrier_minimum<vector_type, M> inner;        ///< solves for Δx
  forcing_history<scalar> forcing{};            ///< errors and inner tolerances so far
  progress_watch<scalar> progress;              ///< looks for steps that get nowhere

  index constraints = 0;    ///< number of inequalities with a bound, on all processes
  scalar degree{0};         ///< Σ counted
  scalar trace{0};          ///< of A, at least its largest eigenvalue; an estimate
  scalar measure{0};        ///< ϑ = (νᵀz + Σ pᵀy) / degree, in multiples of unit
  scalar least{0};          ///< the smallest of the products, for pairs λ_min²
  scalar infeasible{1};     ///< φ, the product of 1 − α: what steps leave of the first ∇L
  scalar first_measure{0};  ///< ϑ of the start
  scalar trial_measure{0}, trial_least{0};                     ///< those of the trial point
  scalar lagrangian_norm{0};                                   ///< ‖∇L‖
  scalar residual_bound{0};                                    ///< β
  scalar centring{0};                                          ///< c of the last step
  scalar step_fraction{0};                                     ///< α of the last step
  scalar step_norm = std::numeric_limits<scalar>::infinity();  ///< ‖Δx‖, of the whole step
  scalar x_norm{0};                                            ///< ‖x‖
  index inner_iterations = 0;                                  ///< of the last step
  bool under_way = false;  ///< a step was longer than half of what Newton proposed
  index raises = 0;        ///< how often ϑ was raised
  index iteration = 0;
  slant::status status = slant::status::running;

  interior_point_state(QP const& qp, M const& m, vector_type const& x0)
      : gradient_point<QP>(qp, x0),
        barrier(qp.set()),
        pairs(qp.set()),
        multipliers(like(x0, barrier.rows())),
        slacks(like(x0, barrier.rows())),
        lagrangian(like(x0, qp.size())),
        products(like(x0, barrier.rows())),
        counted(like(x0, barrier.rows())),
        smooth(like(x0, barrier.rows())),
        diagonal(like(x0, qp.size())),
        centre(like(x0, qp.size())),
        step(like(x0, qp.size())),
        multiplier_step(like(x0, barrier.rows())),
        slack_step(like(x0, barrier.rows())),
        rhs(like(x0, qp.size())),
        row_scratch(like(x0, barrier.rows())),
        trial_slacks(like(x0, barrier.rows())),
        trial_multipliers(like(x0, barrier.rows())),
        inner(x0, qp.size(), m) {}

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the reduced gradient is zero: x is the solution";
      case slant::status::stalled:
        return "no step gets any further at this precision";
      case slant::status::breakdown:
        return "a number left the range of the scalar, or A is not semidefinite";
      case slant::status::unbounded:
        return "the function decreases for ever along step";
      default:
        return std::string(to_string(status));
    }
  }
};

}  // namespace slant
