// SPDX-License-Identifier: MIT
//
// Friction laws as types: which set the tangential multipliers live in.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/sets/any_set.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <utility>

namespace slant::contact {

struct frictionless {};   ///< no tangential multipliers
struct friction_line {};  ///< one tangent per node (2D bodies): |λ_t,i| ≤ gᵢ
struct friction_disc {};  ///< two tangents per node (3D bodies): ‖λ_t,i‖ ≤ gᵢ

/// The law that data stand for by the rows of T; its set is an any_set, so that what is written for
/// it is one type for all of them.
struct friction_of_data {
  index tangents;  ///< per node: 0, 1 or 2

  explicit friction_of_data(index k) : tangents(k) {}
};

namespace detail {

/// Λ for m nodes with the slip bounds g.
template <class V>
auto feasible_set(frictionless, index m, V const&) {
  return half_lines<scalar_t<V>>(m);
}
template <class V>
auto feasible_set(friction_line, index m, V const& g) {
  return cartesian(half_lines<scalar_t<V>>(m), intervals(g));
}
template <class V>
auto feasible_set(friction_disc, index m, V const& g) {
  return cartesian(half_lines<scalar_t<V>>(m), discs(g));
}
template <class V>
auto feasible_set(friction_of_data law, index m, V const& g) {
  using set = any_set<scalar_t<V>, contact_runs<scalar_t<V>>>;
  switch (law.tangents) {
    case 0:
      return set(detail::feasible_set(frictionless{}, m, g));
    case 1:
      return set(detail::feasible_set(friction_line{}, m, g));
    default:
      return set(detail::feasible_set(friction_disc{}, m, g));
  }
}
template <class Friction, class S>
auto feasible_set(Friction friction, data<S> const& c) {
  return detail::feasible_set(friction, c.nodes(), c.g);
}

template <class Friction, class S>
using feasible_set_t =
    decltype(detail::feasible_set(std::declval<Friction>(), std::declval<data<S> const&>()));

/// Tangents per node.
[[nodiscard]] inline index tangents_of(frictionless) {
  return 0;
}
[[nodiscard]] inline index tangents_of(friction_line) {
  return 1;
}
[[nodiscard]] inline index tangents_of(friction_disc) {
  return 2;
}
[[nodiscard]] inline index tangents_of(friction_of_data law) {
  return law.tangents;
}

/// The data, after a look at them. Throws bad_input unless they are valid, K has as many rows as f
/// and the friction law as many tangents as T.
template <class Friction, class S>
data<S> const& validated(Friction friction, data<S> const& c, index unknowns) {
  c.validate();
  slant::detail::check_size("rows of K", unknowns, c.f.size(), "the size of f,");
  index const tangents = tangents_of(friction);
  if (c.tangents() != tangents) {
    throw bad_input("tangents per contact node", slant::detail::show(c.tangents()),
                    slant::detail::show(tangents) + " for this friction law");
  }
  return c;
}

}  // namespace detail

}  // namespace slant::contact
