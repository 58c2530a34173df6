// SPDX-License-Identifier: MIT
//
// The products that contact problems are made of, by name.
#pragma once

#include <slant/sets/ball.hpp>
#include <slant/sets/free_space.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <concepts>
#include <type_traits>

namespace slant {

/// x_i >= 0, i < m: normal contact forces.
template <scalar S = double>
[[nodiscard]] auto half_lines(std::integral auto m) {
  return power(half_line<S>{}, m);
}

/// x_i >= l_i. @throws bad_input "l[3]: …".
template <detail::parameter_list L>
[[nodiscard]] auto half_lines(L const& l) {
  return power(half_line<detail::list_scalar_t<L>>{}, l);
}

/// l_i <= x_i <= u_i. @throws bad_input "l[3]: …".
template <detail::parameter_list L, detail::parameter_list U>
[[nodiscard]] auto intervals(L const& l, U const& u) {
  return power(interval<detail::list_scalar_t<L>>{}, l, u);
}

/// |x_i| <= g_i: friction bounds in the plane. @throws bad_input "radius[3]: …".
template <detail::parameter_list G>
[[nodiscard]] auto intervals(G const& g) {
  return power(symmetric_interval<detail::list_scalar_t<G>>{}, g);
}

/// Discs of radii g_i: friction bounds in space. Consecutive pairs by default; discs<planar>(g) has
/// the pairs (x_i, x_{m+i}) of [T], [K]. @throws bad_input "radius[3]: …".
template <class Layout = consecutive, detail::parameter_list G>
[[nodiscard]] auto discs(G const& g) {
  return power<Layout>(ball<2, detail::list_scalar_t<G>>{}, g);
}

/// Friction cones |x_t| <= μ_i x_n, contact by contact [n, t₁(, t₂)]; N = 2 are those of the plane,
/// as polyhedra. @throws bad_input "mu[3]: …".
template <int N, detail::parameter_list M>
  requires(N == 2 || N == 3)
[[nodiscard]] auto friction_cones(M const& mu) {
  using S = detail::list_scalar_t<M>;
  return power(std::conditional_t<N == 2, plane_cone<S>, second_order_cone<N, S>>{}, mu);
}

/// n components without any constraint. They cost one copy in a projection and nothing elsewhere.
template <scalar S = double>
[[nodiscard]] auto free_components(std::integral auto n) {
  return power(free_space<1, S>{}, n);
}

}  // namespace slant
