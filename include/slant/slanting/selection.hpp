// SPDX-License-Identifier: MIT
//
// Some coordinates of the argument, or some rows of a function:
//
//     auto pressure = slant::selection(n, {0, 1, 2});           // y ↦ (y₀, y₁, y₂)
//     auto rows     = slant::select(F, {3, 5});                 // y ↦ (F(y)₃, F(y)₅)
#pragma once

#include <slant/operators/restriction.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/composition.hpp>

#include <initializer_list>
#include <utility>

namespace slant {

/// y ↦ (y_c for the components c), a linear function of n unknowns; F° is the restriction.
/// @throws bad_input unless the components are different numbers in [0, n).
template <class Components>
[[nodiscard]] auto selection(index n, Components const& components) {
  return slant::linear(restriction(n, components));
}
[[nodiscard]] inline auto selection(index n, std::initializer_list<index> components) {
  return slant::linear(restriction(n, components));
}

/// y ↦ (F(y)_c for the components c). An lvalue f is referenced. All of F is evaluated.
/// @throws bad_input unless the components are different numbers in [0, f.rows()).
template <slanting_part F, class Components>
[[nodiscard]] auto select(F&& f, Components const& components) {
  auto chosen = slant::selection(f.rows(), components);
  return slant::compose(std::move(chosen), std::forward<F>(f));
}
template <slanting_part F>
[[nodiscard]] auto select(F&& f, std::initializer_list<index> components) {
  auto chosen = slant::selection(f.rows(), components);
  return slant::compose(std::move(chosen), std::forward<F>(f));
}

}  // namespace slant
