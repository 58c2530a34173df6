// SPDX-License-Identifier: MIT
//
// All methods, and the problem that they solve.
#pragma once

// IWYU pragma: begin_exports
// First: a complaint about it begins with the trail of headers that has led to it.
#include <slant/problems/quadratic_program.hpp>

#include <slant/methods/barrier.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/envelope_newton.hpp>
#include <slant/methods/forward_backward.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/interior_point_state.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/proportioning.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/solve_constrained_program.hpp>
#include <slant/methods/solve_program.hpp>
#include <slant/methods/ssnm.hpp>
#include <slant/methods/successive_approximations.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/problems/problems.hpp>
// IWYU pragma: end_exports
