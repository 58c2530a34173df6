// SPDX-License-Identifier: MIT
//
// All operators.
#pragma once

// IWYU pragma: begin_exports
// Made of numbers:
#include <slant/operators/diagonal.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/restriction.hpp>
#include <slant/operators/small_blocks.hpp>

// Made of operators:
#include <slant/operators/adjoint.hpp>
#include <slant/operators/block.hpp>
#include <slant/operators/block_diagonal.hpp>
#include <slant/operators/congruence.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/scaled.hpp>
#include <slant/operators/schur_complement.hpp>
#include <slant/operators/sum.hpp>

// Any of them: with other laws, counted, of one type:
#include <slant/operators/any_operator.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/declare.hpp>
// IWYU pragma: end_exports
