// SPDX-License-Identifier: MIT
//
// A body with Coulomb friction: successive approximations over the recommended method. Compiled
// apart from the problems with Tresca friction.
#pragma once

#include "problem_folder.hpp"
#include "solution.hpp"

namespace from_files {

/// The solution; its kkt_residual is that of the problem with Tresca friction whose slip bounds are
/// F λ_ν. Throws slant::bad_input if K is not symmetric positive definite.
[[nodiscard]] solution solve_coulomb(coulomb_problem const& p, settings const& s);

}  // namespace from_files
