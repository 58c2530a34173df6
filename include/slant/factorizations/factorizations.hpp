// SPDX-License-Identifier: MIT
//
// All factorisations that need nothing but Eigen, and CHOLMOD where it was found.
#pragma once

// IWYU pragma: begin_exports
// Factorisations:
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/ldlt.hpp>

// Operators that hold one:
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/factorizations/generalized_inverse.hpp>
#include <slant/factorizations/woodbury.hpp>

// Kernels of semidefinite matrices:
#include <slant/factorizations/kernel_basis.hpp>

// The contact unknowns late in the elimination:
#include <slant/factorizations/condensation_options.hpp>
#include <slant/factorizations/condensed_operator.hpp>
#include <slant/factorizations/fill_estimate.hpp>
#include <slant/factorizations/static_condensation.hpp>
// IWYU pragma: end_exports
