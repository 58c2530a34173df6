// SPDX-License-Identifier: MIT
//
// Operators written as mathematics: B * Kinv * adjoint(B) + 1e-3 * identity(m), with laws that the
// compiler knows. describe(A), which prints the tree, has a header of its own.
#pragma once

// IWYU pragma: begin_exports
#include <slant/expressions/applied.hpp>  // A * x
#include <slant/expressions/explain.hpp>  // errors that name the expression
#include <slant/expressions/letter.hpp>   // names, inverse, adjoint
#include <slant/expressions/mirror.hpp>   // laws of products and sums
#include <slant/expressions/number.hpp>   // numbers in front and their signs
#include <slant/expressions/product.hpp>  // A B C
#include <slant/expressions/sum.hpp>      // A + B − C
#include <slant/expressions/syntax.hpp>   // + − * of operators, printing
#include <slant/expressions/text.hpp>     // names and symbols
// IWYU pragma: end_exports
