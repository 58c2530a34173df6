// SPDX-License-Identifier: MIT
//
// All slanting functions.
#pragma once

// Functions:
#include <slant/slanting/affine.hpp>
#include <slant/slanting/fischer_burmeister.hpp>
#include <slant/slanting/inequalities.hpp>
#include <slant/slanting/inequality_jacobian.hpp>
#include <slant/slanting/max.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/slanting/smooth.hpp>

// Friction laws as equations:
#include <slant/slanting/alart_curnier.hpp>
#include <slant/slanting/de_saxce.hpp>

// Made of functions:
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/blockwise.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/selection.hpp>
#include <slant/slanting/stack.hpp>

// Optimality conditions:
#include <slant/slanting/kkt_function.hpp>
#include <slant/slanting/natural_residual.hpp>
#include <slant/slanting/symmetrized.hpp>

// What they share:
#include <slant/slanting/slanting_part.hpp>
