// SPDX-License-Identifier: MIT
//
// Operators, sets, slanting functions and the methods over them: what a solver is composed of. What
// only some programs need has headers of its own, since the compiler reads all that is included:
//
//     <slant/contact/contact.hpp>                contact from stiffness matrices, friction laws
//     <slant/io/io.hpp>, <slant/io/vtu.hpp>      files (the second one needs pugixml)
//     <slant/operators/describe.hpp>             the tree of an expression
//     <slant/factorizations/factorizations.hpp>  kernels, static condensation, generalised inverses
//     <slant/iteration/iterates.hpp>             a run as a range (range-v3)
//     <slant/sets/block_range.hpp>               the blocks of a point as a range (<ranges>)
//     <slant/operators/range_sum.hpp>            sums of ranges of operators (<ranges>)
//     <slant/operators/timed.hpp>                seconds spent in an operator (<chrono>)
//     <slant/testing/…>                          law checks, for test suites (partly with doctest)
//
// CHOLMOD takes part where SLANT_HAS_CHOLMOD is 1, as with the CMake target slant::cholmod.
#pragma once

// IWYU pragma: begin_exports
// First: a complaint about a method begins with the trail of headers that has led to it.
#include <slant/methods/methods.hpp>

#include <slant/certificates/certificates.hpp>
#include <slant/concepts/concepts.hpp>
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/iteration.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/multilevel/multilevel.hpp>
#include <slant/newton/newton.hpp>
#include <slant/operators/operators.hpp>
#include <slant/sets/sets.hpp>
#include <slant/slanting/slanting.hpp>
// IWYU pragma: end_exports
