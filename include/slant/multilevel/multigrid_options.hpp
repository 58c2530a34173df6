// SPDX-License-Identifier: MIT
//
// Options of smoothed aggregation.
#pragma once

#include <slant/concepts/checks.hpp>

namespace slant {

/// Options of multigrid.
struct multigrid_options {
  index block_size = 0;  ///< unknowns of a node, consecutive; 0: from the pattern of K, 1 to 3
  double strength = 0.04;  ///< θ in [0, 1): nodes i, j are neighbours if ‖K_ij‖² > θ² ‖K_ii‖ ‖K_jj‖
  double damping = 4.0 / 3;  ///< ω λ_max(D⁻¹K) in (0, 2): the smoothing of the prolongation
  index sweeps = 1;          ///< of Gauss–Seidel before and after each coarse correction, >= 1
  index coarsest = 600;      ///< a level with so few unknowns is factored, >= 1
  index levels = 20;         ///< at most so many, >= 1

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using detail::show;
    if (block_size < 0) throw bad_input("block_size", show(block_size), "a number >= 0");
    if (!(strength >= 0 && strength < 1)) {
      throw bad_input("strength", show(strength), "a number in [0, 1)");
    }
    if (!(damping > 0 && damping < 2)) {
      throw bad_input("damping", show(damping), "a number in (0, 2)");
    }
    if (sweeps < 1) throw bad_input("sweeps", show(sweeps), "at least 1");
    if (coarsest < 1) throw bad_input("coarsest", show(coarsest), "at least 1");
    if (levels < 1) throw bad_input("levels", show(levels), "at least 1");
  }
};

}  // namespace slant
