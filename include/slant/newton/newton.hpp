// SPDX-License-Identifier: MIT
//
// The exchangeable parts of Newton's method: linear solvers, forcing terms, globalisations.
#pragma once

// IWYU pragma: begin_exports
#include <slant/newton/bicgstab_solver.hpp>
#include <slant/newton/by_laws.hpp>
#include <slant/newton/cg_solver.hpp>
#include <slant/newton/direct_solver.hpp>
#include <slant/newton/direction.hpp>
#include <slant/newton/forcing.hpp>
#include <slant/newton/globalisation.hpp>
#include <slant/newton/gmres_solver.hpp>
#include <slant/newton/saddle_direct.hpp>
#include <slant/newton/schur_bicgstab.hpp>
#include <slant/newton/schur_cg.hpp>
#include <slant/newton/slant_preconditioner.hpp>
#include <slant/newton/sparse_direct_solver.hpp>
#include <slant/newton/symmetrized_cg.hpp>
// IWYU pragma: end_exports
