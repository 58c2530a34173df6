// SPDX-License-Identifier: MIT
//
// Multigrid: an approximate inverse of a sparse definite matrix that costs a few products by it.
#pragma once

// IWYU pragma: begin_exports
#include <slant/multilevel/aggregation.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/hierarchy.hpp>
#include <slant/multilevel/multigrid.hpp>
// IWYU pragma: end_exports
