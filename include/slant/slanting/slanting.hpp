// SPDX-License-Identifier: MIT
//
// All slanting functions.
#pragma once

#include <slant/slanting/affine.hpp>
#include <slant/slanting/alart_curnier.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/blockwise.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/de_saxce.hpp>
#include <slant/slanting/fischer_burmeister.hpp>
#include <slant/slanting/inequalities.hpp>
#include <slant/slanting/inequality_jacobian.hpp>
#include <slant/slanting/kkt_function.hpp>
#include <slant/slanting/max.hpp>
#include <slant/slanting/natural_residual.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/slanting/selection.hpp>
#include <slant/slanting/slanting_base.hpp>
#include <slant/slanting/smooth.hpp>
#include <slant/slanting/stack.hpp>
#include <slant/slanting/symmetrized.hpp>
