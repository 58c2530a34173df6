// SPDX-License-Identifier: MIT
//
// All Krylov methods, the bound of the largest eigenvalue, and the mean of the diagonal.
#pragma once

// IWYU pragma: begin_exports
// Methods:
#include <slant/krylov/bicgstab.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/krylov/range_cg.hpp>

// Their steps:
#include <slant/krylov/conjugate_directions.hpp>
#include <slant/krylov/feasible_step.hpp>
#include <slant/krylov/flat_direction.hpp>
#include <slant/krylov/linear_system.hpp>

// What they need to know of an operator:
#include <slant/krylov/preconditioner.hpp>
#include <slant/krylov/spectrum.hpp>
// IWYU pragma: end_exports
