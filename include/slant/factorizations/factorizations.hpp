// SPDX-License-Identifier: MIT
//
// All factorisations that need nothing but Eigen, and CHOLMOD where it was found.
#pragma once

// IWYU pragma: begin_exports
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/ldlt.hpp>
// IWYU pragma: end_exports
