// SPDX-License-Identifier: MIT
//
// Driver, stopping rules, observers, nested iteration.
#pragma once

// IWYU pragma: begin_exports
#include <slant/iteration/nested.hpp>
#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
// IWYU pragma: end_exports
