// SPDX-License-Identifier: MIT
//
// What range_cg knows between two steps, and what its statuses mean.
#pragma once

#include <slant/concepts/vector.hpp>
#include <slant/iteration/report.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/krylov/projected_directions.hpp>

#include <limits>
#include <string>

namespace slant {

/// State of range_cg.
template <class V, class WK, class WC, class WQ, bool Definite>
struct range_cg_state {
  using flat_type = flat_direction<V, Definite>;

  V x;                                 ///< iterate
  V r;                                 ///< gradient K x − b, in multiples of unit
  V z;                                 ///< C r
  projected_directions<V> directions;  ///< p, q = Q p, K q, qᵀKq
  V descent;                           ///< where j falls for ever, if the status is unbounded
  WK a_workspace;                      ///< temporaries of K
  WC c_workspace;                      ///< temporaries of C
  WQ q_workspace;                      ///< temporaries of Q
  slant::work work{};
  flat_type flat;                 ///< tells directions of the kernel of K
  scalar_t<V> unit{1};            ///< a power of two, see unit.hpp
  scalar_t<V> residual_norm{0};   ///< ‖C r‖
  scalar_t<V> residual_scale{0};  ///< ‖C b‖, or ‖C r₀‖ if that is 0
  scalar_t<V> computed_norm =
      std::numeric_limits<scalar_t<V>>::infinity();  ///< at the last refresh
  bool updated = false;                              ///< r was updated since it was computed from x
  bool regular = false;              ///< a kernel was looked for, and j does not fall in it
  bool flat_ended = false;           ///< it stalled on a direction without curvature
  index projector_applications = 0;  ///< of Q, or of U(UᵀKU)⁻¹Uᵀ
  index iteration = 0;
  slant::status status = slant::status::running;

  /// What a status other than running means here.
  [[nodiscard, gnu::cold]] std::string reason() const {
    switch (status) {
      case slant::status::converged:
        return "the gradient vanishes on the range";
      case slant::status::unbounded:
        return "the function decreases for ever along `descent`";
      case slant::status::stalled:
        if (!flat_ended) return "the gradient computed from x has not fallen any more";
        return flat.is_exact() ? "the curvature of the next direction is that of rounding errors, "
                                 "and no kernel was found near it"
                               : "the curvature of the next direction is that of rounding errors, "
                                 "as far as the mean of the diagonal tells; K gives no diagonal";
      case slant::status::breakdown:
        return "a number left the range of the scalar, or an operator is not semidefinite";
      default:
        return std::string(to_string(status));
    }
  }
};

}  // namespace slant
