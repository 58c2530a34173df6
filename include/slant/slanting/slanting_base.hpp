// SPDX-License-Identifier: MIT
//
// What marks a type as a slanting function for the arithmetic of arithmetic.hpp.
//
// Lifetime, for all of slant/slanting. A composition references the functions, operators, sets and
// vectors that were passed as lvalues and owns those passed as rvalues. An operator F°(y) owns what
// depends on y and refers to F for the rest (the matrix A of an affine part, say), so it must not
// outlive F: `auto G = (f + g).slant(y)` is a mistake, `auto F = f + g; auto G = F.slant(y)` is
// not.
#pragma once

#include <slant/concepts/member_names.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/operators/held.hpp>

#include <type_traits>

namespace slant {

/// Empty base of slanting functions that want `f + g`, `f - g`, `α * f`, `A * f`, `f * g`, `-f`.
/// The named factories (compose, stack, max, ...) need no base. Why a base at all: without a vector
/// type nothing else tells a function (value, slant) from an operator (apply) by its members.
struct slanting_base {};

/// A map whose type is marked, whatever the vectors.
template <class F>
concept slanting_map = std::is_base_of_v<slanting_base, std::remove_cvref_t<F>> &&
                       has_rows<std::remove_cvref_t<F>> && has_cols<std::remove_cvref_t<F>>;

/// A slanting function as far as can be known before the vectors are: what factories ask of their
/// arguments.
template <class F>
concept slanting_part =
    has_rows<std::remove_cvref_t<F>> && has_cols<std::remove_cvref_t<F>> &&
    has_value_member<std::remove_cvref_t<F>> && has_slant_member<std::remove_cvref_t<F>>;

}  // namespace slant
