// SPDX-License-Identifier: MIT
//
// Formulas with slanting functions, as they stand on paper:
//
//     auto F = identity_map{n} - projection(Λ) * (identity_map{n} - positive(ρ) * affine(A, -b));
//
//     f + g, f - g, -f     add, subtract, scale(-1, f)
//     c * f                scale(c, f);  c may be positive(ρ)
//     f * g                compose(f, g): y ↦ f(g(y)), as for operators; never a pointwise product
//     A * f, f * A         A an operator or Eigen matrix: compose with y ↦ A y
//
// Found by argument-dependent lookup for every type derived from slanting_base; for other types use
// the named functions.
#pragma once

#include <slant/slanting/affine.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/scaled.hpp>
#include <slant/slanting/sum.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// An operator or Eigen matrix that is not itself a slanting function.
template <class A> concept linear_factor = operand<A> && !slanting_map<A>;

template <slanting_map F, slanting_map G>
[[nodiscard]] auto operator+(F&& f, G&& g) {
  return slant::add(std::forward<F>(f), std::forward<G>(g));
}

template <slanting_map F, slanting_map G>
[[nodiscard]] auto operator-(F&& f, G&& g) {
  return slant::subtract(std::forward<F>(f), std::forward<G>(g));
}

template <slanting_map F>
[[nodiscard]] auto operator-(F&& f) {
  return slant::scale(-1, std::forward<F>(f));
}

template <class S, slanting_map F>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] auto operator*(S c, F&& f) {
  return slant::scale(std::move(c), std::forward<F>(f));
}

template <class S, slanting_map F>
[[nodiscard]] auto operator*(positive_factor<S> c, F&& f) {
  return slant::scale(std::move(c), std::forward<F>(f));
}

template <slanting_map F, slanting_map G>
[[nodiscard]] auto operator*(F&& f, G&& g) {
  return slant::compose(std::forward<F>(f), std::forward<G>(g));
}

template <linear_factor A, slanting_map F>
[[nodiscard]] auto operator*(A&& a, F&& f) {
  return slant::compose(slant::linear(std::forward<A>(a)), std::forward<F>(f));
}

template <slanting_map F, linear_factor A>
[[nodiscard]] auto operator*(F&& f, A&& a) {
  return slant::compose(std::forward<F>(f), slant::linear(std::forward<A>(a)));
}

}  // namespace slant
