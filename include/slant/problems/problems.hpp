// SPDX-License-Identifier: MIT
//
// What is to be solved, apart from how.
#pragma once

// IWYU pragma: begin_exports
#include <slant/problems/any_qp.hpp>
#include <slant/problems/augmented_problem.hpp>
#include <slant/problems/cut_face.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/problems/equilibrated.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/problems/polyhedral_qp.hpp>
#include <slant/problems/quadratic_program.hpp>
#include <slant/problems/separable_qp.hpp>
// IWYU pragma: end_exports
