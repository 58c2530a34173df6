// SPDX-License-Identifier: MIT
//
// Contact problems: from data to a dual problem, and back to displacements.
#pragma once

// IWYU pragma: begin_exports
// From data to a solution with its error:
#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/solve.hpp>
#include <slant/contact/solve_friction.hpp>
#include <slant/contact/solve_options.hpp>

// Data:
#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/contact/load_steps.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/plausibility.hpp>

// Problems in λ or u:
#include <slant/contact/bodies.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/primal.hpp>
#include <slant/contact/primal_dual.hpp>
#include <slant/contact/primal_stepper.hpp>
#include <slant/contact/total_feti.hpp>

// Preconditioners, load steps, motions, checks:
#include <slant/contact/certificate.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/route.hpp>

// Coulomb friction of elastic bodies:
#include <slant/contact/coulomb/coulomb.hpp>
#include <slant/contact/coulomb/coulomb_certificate.hpp>

// Coulomb friction from u = W r + q:
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/contact/friction/friction_gauss_seidel.hpp>
#include <slant/contact/friction/friction_interior_point.hpp>
#include <slant/contact/friction/friction_newton.hpp>
#include <slant/contact/friction/friction_problem.hpp>
#include <slant/contact/friction/verify.hpp>
// IWYU pragma: end_exports
