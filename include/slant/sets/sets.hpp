// SPDX-License-Identifier: MIT
//
// All convex sets. The blocks of a point as a range, which takes <ranges>, have a header of their own.
#pragma once

// IWYU pragma: begin_exports
// Blocks:
#include <slant/sets/ball.hpp>
#include <slant/sets/ellipse.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/point.hpp>
#include <slant/sets/second_order_cone.hpp>

// Images of blocks:
#include <slant/sets/images.hpp>

// Products of blocks:
#include <slant/sets/any_set.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/syntax.hpp>  // Λ * Μ, c * Λ, Λ + c

// Functions with a proximal map:
#include <slant/sets/proximal_step.hpp>
#include <slant/sets/separable_sum.hpp>
#include <slant/sets/support.hpp>

// Faces, and slanting operators of projections:
#include <slant/sets/curved_face.hpp>
#include <slant/sets/face.hpp>
#include <slant/sets/slants.hpp>
// IWYU pragma: end_exports
