// SPDX-License-Identifier: MIT
//
// All slanting functions.
#pragma once

// Functions:
#include <slant/slanting/affine.hpp>
#include <slant/slanting/inequalities.hpp>
#include <slant/slanting/inequality_jacobian.hpp>
#include <slant/slanting/pairs.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/slanting/smooth.hpp>

// Coulomb's law as equations, functions given block by block:
#include <slant/slanting/coulomb_law.hpp>

// Made of functions:
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/stack.hpp>

// Optimality conditions:
#include <slant/slanting/kkt_function.hpp>
#include <slant/slanting/symmetrized.hpp>

// What they share:
#include <slant/slanting/slanting_part.hpp>
