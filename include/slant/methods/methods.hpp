// SPDX-License-Identifier: MIT
//
// All methods, and the problem that they solve.
#pragma once

// IWYU pragma: begin_exports
// First: a complaint about it begins with the trail of headers that has led to it.
#include <slant/methods/kprgp.hpp>

#include <slant/methods/active_rows.hpp>
#include <slant/methods/anderson_mixing.hpp>
#include <slant/methods/any_qp.hpp>
#include <slant/methods/augmented_problem.hpp>
#include <slant/methods/barrier.hpp>
#include <slant/methods/barrier_minimum.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/constrained_newton_core.hpp>
#include <slant/methods/constrained_newton_options.hpp>
#include <slant/methods/constrained_newton_state.hpp>
#include <slant/methods/constraint_rows.hpp>
#include <slant/methods/curved_minimum.hpp>
#include <slant/methods/cut_face.hpp>
#include <slant/methods/equilibrated.hpp>
#include <slant/methods/estimated_diagonal.hpp>
#include <slant/methods/estimated_multipliers.hpp>
#include <slant/methods/face_preconditioner.hpp>
#include <slant/methods/gimssn.hpp>
#include <slant/methods/gradient_point.hpp>
#include <slant/methods/imssn.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/interior_point_options.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/interior_start.hpp>
#include <slant/methods/kkt_vector.hpp>
#include <slant/methods/kprgp_options.hpp>
#include <slant/methods/kprgp_state.hpp>
#include <slant/methods/lorentz_pairs.hpp>
#include <slant/methods/modified_newton.hpp>
#include <slant/methods/modified_newton_options.hpp>
#include <slant/methods/modified_newton_parts.hpp>
#include <slant/methods/modified_newton_state.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/newton_options.hpp>
#include <slant/methods/newton_parts.hpp>
#include <slant/methods/newton_segment.hpp>
#include <slant/methods/newton_state.hpp>
#include <slant/methods/polyhedral_qp.hpp>
#include <slant/methods/preconditioner_for.hpp>
#include <slant/methods/projected_search.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/methods/proximal_point.hpp>
#include <slant/methods/qpc.hpp>
#include <slant/methods/qpc_options.hpp>
#include <slant/methods/qpq.hpp>
#include <slant/methods/reduced_gradient.hpp>
#include <slant/methods/reduced_systems.hpp>
#include <slant/methods/release_rules.hpp>
#include <slant/methods/rounded_products.hpp>
#include <slant/methods/row_slacks.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/methods/schur_contact_options.hpp>
#include <slant/methods/schur_contact_state.hpp>
#include <slant/methods/semismooth_newton.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/smalse_options.hpp>
#include <slant/methods/smalse_state.hpp>
#include <slant/methods/solve_program.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/methods/ssnm_options.hpp>
#include <slant/methods/ssnm_problem.hpp>
#include <slant/methods/ssnm_state.hpp>
#include <slant/methods/successive_approximations.hpp>
#include <slant/methods/successive_options.hpp>
#include <slant/methods/successive_state.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/symmetric_newton_core.hpp>
#include <slant/methods/symmetric_newton_options.hpp>
#include <slant/methods/symmetric_newton_state.hpp>
#include <slant/methods/unconstrained_start.hpp>
// IWYU pragma: end_exports
