// SPDX-License-Identifier: MIT
//
// The whole vocabulary.
#pragma once

// IWYU pragma: begin_exports
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/member_names.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/concepts/vector.hpp>
// IWYU pragma: end_exports
