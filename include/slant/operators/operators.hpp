// SPDX-License-Identifier: MIT
//
// All operators, and formulas of them: B * Kinv * adjoint(B) + 1e-3 * identity(m). Headers of their
// own have describe(A), which prints the tree of one, and sum(range), which takes <ranges>.
#pragma once

// IWYU pragma: begin_exports
// Made of numbers:
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/restriction.hpp>
#include <slant/operators/small_blocks.hpp>

// Written as mathematics, with laws that the compiler knows:
#include <slant/operators/applied.hpp>  // A * x
#include <slant/operators/explain.hpp>  // errors that name the formula
#include <slant/operators/factors.hpp>  // laws of products and sums
#include <slant/operators/letter.hpp>   // names, adjoint
#include <slant/operators/product.hpp>  // A B C, B A Bᵀ
#include <slant/operators/sum.hpp>      // A + B − C
#include <slant/operators/syntax.hpp>   // + − *, printing
#include <slant/operators/text.hpp>     // names and symbols

// Made of operators:
#include <slant/operators/block.hpp>
#include <slant/operators/block_diagonal.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/kronecker.hpp>

// Any of them: with other laws, counted, of one type:
#include <slant/operators/any_operator.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/declare.hpp>
// IWYU pragma: end_exports
