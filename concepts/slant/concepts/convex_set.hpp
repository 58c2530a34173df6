// SPDX-License-Identifier: MIT
//
// Closed convex sets, described by what algorithms do with them.
//
// Intuition. A set is its projection. A block is tiny and of fixed dimension (an interval, a disc);
// products of blocks model the same concept.
//
// Minimal definition.
//     dimension (static) or size()     number of components
//     project(x) → value, or project(x, y) in place (y may alias x; both have as many entries as
//                the set has components, which slant::project checks)
//     contains(x)                      membership, up to rounding
//
// Capabilities, each where it exists:
//     slant(x)                  a slanting operator G of the projection, symmetric, 0 ⪯ G ⪯ I
//     step_to_boundary(x, d)    sup {α ≥ 0 : x + α d ∈ Λ} for x ∈ Λ
//     support(y)                sup {yᵀz : z ∈ Λ}
//     state(x)                  a block: free, sliding or fixed (face.hpp)
//     inequality(x), inequality_gradient(x), inequality_hessian(x, ν), inequalities (static)
//                               smooth f with Λ = {f ≤ 0}; {f < 0} is the interior, if there is one
//     whole_space = true (static)   a block without any constraint, which products pass over
//     visit(f)                  products: f(block, place) for each block, place.in(x) is its part
//     visit_block(k, f)         products: f(block, place) for block k of these
//     with(parameters…)         a block: the same shape with other parameters, for power(block, …)
//     scalar (a type)           a block: that of its points, for products; without it double
//
// Laws.   P(P(x)) = P(x),   ‖P(x) − P(y)‖ ≤ ‖x − y‖,   ⟨x − P(x), z − P(x)⟩ ≤ 0 for z ∈ Λ,
//         contains(P(x)),   ‖P(x+h) − P(x) − G(x+h) h‖ = o(‖h‖),   support(y) = sup over Λ,
//         ∇f_i(x)ᵀ(z − x) ≤ 0 for z ∈ Λ where f_i(x) = 0.
// The last is what convexity of Λ implies. The f_i themselves need not be convex: of the cone
// ‖x_t‖ ≤ μ x_n, ‖x_t‖² − μ²x_n² is not.
//
// Models. everything in slant/sets, slant::testing::archetype::convex_set.
//
// Kinks. The slanting operator takes the value from inside: 1 for x ≥ l, I for ‖x‖ ≤ g
// [K (49), (50)]; any choice is admissible, this one is the same everywhere.
//
// Rounding. contains(P(x)) holds, and P(y) of a y outside is not free: so both need a band around
// the boundary that is wider than the error of project. Twice the number of roundings, times ε,
// times the largest number that enters is enough; the law checks accept some 60 ε from `contains`
// and far more from `state`.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/vector.hpp>

namespace slant {

template <class C>
concept has_static_dimension = requires {
  { C::dimension } -> std::convertible_to<index>;
};
template <class C>
concept has_size = requires(C const& c) {
  { c.size() } -> std::convertible_to<index>;
};

namespace detail {

struct dimension_of_fn {
  template <class C>
  [[nodiscard]] constexpr index operator()(C const& c) const {
    if constexpr (has_static_dimension<C>) {
      return C::dimension;
    } else {
      return c.size();
    }
  }
};

/// The same as far as the type tells.
template <class C>
[[nodiscard]] consteval index dimension_of_type() {
  if constexpr (has_static_dimension<C>) {
    return C::dimension;
  } else {
    return unknown_size;
  }
}

}  // namespace detail

/// Number of components of the points of a set.
inline constexpr detail::dimension_of_fn dimension_of{};

template <class C, class V>
concept has_project_value = requires(C const& c, V const& x) { c.project(x); };
template <class C, class V>
concept has_project_in_place = requires(C const& c, V const& x, V& y) { c.project(x, y); };
template <class C, class V>
concept has_project = has_project_value<C, V> || has_project_in_place<C, V>;

namespace detail {

/// What project(x) returns; V if there is only project(x, y).
template <class C, class V>
struct projected {
  using type = V;
};
template <class C, class V>
  requires has_project_value<C, V>
struct projected<C, V> {
  using type = decltype(std::declval<C const&>().project(std::declval<V const&>()));
};

}  // namespace detail

/// What project(x) returns, if there is such a member, is a point of the set's dimension.
template <class C, class V>
concept projects_to_points =
    numbers_like<typename detail::projected<C, V>::type, V, detail::dimension_of_type<C>(), 1>;

template <class C, class V>
concept has_contains = requires(C const& c, V const& x) {
  { c.contains(x) } -> std::convertible_to<bool>;
};

namespace detail {

struct project_fn {
  /// y = P(x); y may alias x.
  template <class C, class X, class Y>
  void operator()(C const& c, X const& x, Y& y) const {
    check_rows("x", x, index(slant::dimension_of(c)), "the dimension of the set");
    check_rows("y", y, index(slant::dimension_of(c)), "the dimension of the set");
    if constexpr (requires { c.project(x, y); }) {
      c.project(x, y);
    } else {
      slant::local(y) = c.project(slant::local(x));  // a block returns its few numbers by value
    }
  }
  template <class C, class X>
  [[nodiscard]] auto operator()(C const& c, X const& x) const {
    check_rows("x", x, index(slant::dimension_of(c)), "the dimension of the set");
    if constexpr (requires { c.project(x); }) {
      return c.project(x);
    } else {
      auto y = slant::like(x, slant::dimension_of(c));
      c.project(x, y);
      return y;
    }
  }
};

}  // namespace detail

/// Nearest point of the set: project(c, x) by value, project(c, x, y) in place.
/// Throws bad_input if x or y has a wrong size.
inline constexpr detail::project_fn project{};

/// An operator on vectors like V, or an N × N matrix of the same scalar.
template <class R, class V, index N>
concept slant_like = numbers_like<R, V, N, N> || linear_operator<std::remove_cvref_t<R>, V>;

template <class C, class V>
concept has_slant = requires(C const& c, V const& x) {
  { c.slant(x) } -> slant_like<V, detail::dimension_of_type<C>()>;
};
template <class C, class V>
concept has_step_to_boundary = requires(C const& c, V const& x) {
  { c.step_to_boundary(x, x) } -> std::convertible_to<scalar_t<V>>;
};
template <class C, class V>
concept has_support = requires(C const& c, V const& y) {
  { c.support(y) } -> std::convertible_to<scalar_t<V>>;
};
template <class C, class V>
concept has_state = requires(C const& c, V const& x) {
  { c.state(x) } -> std::same_as<block_state>;
};
template <class C, class V>
concept has_inequality_form = requires(C const& c, V const& x) {
  { C::inequalities } -> std::convertible_to<int>;
  requires C::inequalities >= 0;
  { c.inequality(x) } -> numbers_like<V, C::inequalities, 1>;
  { c.inequality_gradient(x) } -> numbers_like<V, detail::dimension_of_type<C>(), C::inequalities>;
  {
    c.inequality_hessian(x, c.inequality(x))
  } -> numbers_like<V, detail::dimension_of_type<C>(), detail::dimension_of_type<C>()>;
};

/// The set {x : p ∈ L} with p = T x + t and the Lorentz cone L = {p : ‖p_t‖ ≤ p_0}:
/// lorentz_point(x) = p, lorentz_matrix() = T, of fixed size. Its first inequality is
/// ‖p_t‖² − p_0² ≤ 0.
template <class C, class V>
concept has_lorentz_form = has_inequality_form<C, V> && requires(C const& c, V const& x) {
  requires decltype(c.lorentz_matrix())::RowsAtCompileTime >= 2;
  {
    c.lorentz_matrix()
  } -> numbers_like<V, decltype(c.lorentz_matrix())::RowsAtCompileTime,
                    detail::dimension_of_type<C>()>;
  { c.lorentz_point(x) } -> numbers_like<V, decltype(c.lorentz_matrix())::RowsAtCompileTime, 1>;
};

namespace detail {
struct visit_probe {
  template <class Block, class Place>
  void operator()(Block const&, Place const&) const {}
};
}  // namespace detail

template <class C> concept has_visit = requires(C const& c) { c.visit(detail::visit_probe{}); };
template <class C>
concept has_visit_block =
    requires(C const& c, index k) { c.visit_block(k, detail::visit_probe{}); };

/// A closed convex set of points of type V; see the top of this file.
template <class C, class V>
concept convex_set = (has_static_dimension<C> || has_size<C>)&&has_project<C, V> &&
                     projects_to_points<C, V> && has_contains<C, V>;

/// A convex set whose points can be classified: one block, or a product of blocks.
template <class C, class V>
concept separable_set = convex_set<C, V> && (has_visit<C> || has_state<C, V>);

}  // namespace slant
