// SPDX-License-Identifier: MIT
//
// The exchangeable parts of Newton's method: linear solvers, forcing terms, globalisations.
#pragma once

// IWYU pragma: begin_exports
// The method:
#include <slant/newton/semismooth_newton.hpp>

// Linear solvers:
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/saddle_solvers.hpp>
#include <slant/newton/symmetrized_cg.hpp>

// How accurately, and how far:
#include <slant/newton/forcing.hpp>
// IWYU pragma: end_exports
