// SPDX-License-Identifier: MIT
//
// A body with Coulomb friction. Compiled apart from the problems with Tresca friction.
#pragma once

#include "coulomb_methods.hpp"
#include "problem_folder.hpp"
#include "solution.hpp"

namespace from_files {

/// The solution by such a method; its kkt_residual is that of the problem with Tresca friction
/// whose slip bounds are F λ_ν. Throws slant::bad_input if K is not symmetric positive definite.
[[nodiscard]] solution solve_coulomb(coulomb_problem const& p, coulomb_kind kind,
                                     coulomb_settings const& s);

}  // namespace from_files
