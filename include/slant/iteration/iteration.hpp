// SPDX-License-Identifier: MIT
//
// Driver, range of iterates, stopping rules, observers, report.
#pragma once

// IWYU pragma: begin_exports
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/nested.hpp>
#include <slant/iteration/observers.hpp>
#include <slant/iteration/report.hpp>
#include <slant/iteration/sequel.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/step_below.hpp>
#include <slant/iteration/stopping.hpp>
// IWYU pragma: end_exports
