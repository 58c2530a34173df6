// SPDX-License-Identifier: MIT
//
// The whole library, but for what needs more than Eigen, Boost and range-v3: <slant/io/vtu.hpp>
// (pugixml) and <slant/testing/…> (for test suites, partly with doctest). CHOLMOD takes part where
// SLANT_HAS_CHOLMOD is 1, as with the CMake target slant::cholmod.
#pragma once

// IWYU pragma: begin_exports
// First: a complaint about a method begins with the trail of headers that has led to it.
#include <slant/methods/methods.hpp>

#include <slant/certificates/certificates.hpp>
#include <slant/concepts/concepts.hpp>
#include <slant/contact/contact.hpp>
#include <slant/factorizations/factorizations.hpp>
#include <slant/io/io.hpp>
#include <slant/iteration/iteration.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/multilevel/multilevel.hpp>
#include <slant/newton/newton.hpp>
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
// IWYU pragma: end_exports
