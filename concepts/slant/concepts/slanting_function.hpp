// SPDX-License-Identifier: MIT
//
// Slanting functions: maps with a generalised Newton derivative.
//
// Intuition. F is slantly differentiable if operators F°(y), bounded near y, predict F from the far
// end of each step [T Def 1.3, K Def 1]; a smooth map is the special case F° = F′. Knowing F° is
// all that Newton's method needs.
//
// Minimal definition.
//     rows(), cols()      numbers of values and of arguments
//     value(y, f)         f = F(y), overwritten, no aliasing; or value(y, f, w) with workspace(y);
//                         y has cols() entries, f has rows(), which slant::evaluate checks
//     slant(y)            F°(y), a linear operator rows() × cols()
// Optional, for iterations without allocation:
//     slant(y, G) or slant(y, G, w)   G = F°(y) into an operator that slant(y₀) made earlier
//     slant_after_value(y, G, w)      the same where w comes from value(y, f, w) at this very y:
//                                     what value left in w (G(y) of a composition F∘G) is reused
//     slant_from_value(y, w)          the same as a new operator: slant(y) that reuses w
//
// Formulas. Types derived from slant::slanting_base take part in
// f + g, f * g, A * f, …; for others there are the named add, subtract, scale, compose.
//
// Lifetime. slant(y) returns an operator that owns what depends on y: diagonal(std::move(d)), since
// diagonal(d) would refer to a local d.
//
// Laws.   ‖F(y+h) − F(y) − F°(y+h) h‖ = o(‖h‖),   ‖F°‖ bounded near y.
//
// Models. everything in slant/slanting, slant::testing::archetype::slanting_function.
//
// Counterexample. √|y| sign(y): its difference quotients are unbounded at 0, no F°(0) exists.
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant {

template <class F, class V>
concept has_plain_value = requires(F const& f, V const& y, V& v) { f.value(y, v); };

template <class F, class V>
concept has_workspace_value =
    requires(F const& f, V const& y, V& v, workspace_t<F, V>& w) { f.value(y, v, w); };

template <class F, class V>
concept has_slant_operator = requires(F const& f, V const& y) {
  { f.slant(y) } -> linear_operator<V>;
};

/// The type of F°(y).
template <class F, class V>
using slant_operator_t = decltype(std::declval<F const&>().slant(std::declval<V const&>()));

/// F°(y) can be renewed in place.
template <class F, class V>
concept has_slant_update = requires(F const& f, V const& y, slant_operator_t<F, V>& g) {
  f.slant(y, g);
} || requires(F const& f, V const& y, slant_operator_t<F, V>& g, workspace_t<F, V>& w) {
  f.slant(y, g, w);
};

/// A slantly differentiable function on vectors of type V; see the top of this file.
template <class F, class V>
concept slanting_function =
    has_rows<F> && has_cols<F> &&
    (has_plain_value<F, V> || has_workspace_value<F, V>)&&has_slant_operator<F, V>;

namespace detail {

/// Throws bad_input unless F can be evaluated at y.
void check_argument(auto const& f, auto const& y) {
  check_rows("y", y, index(f.cols()), "cols() of the function");
}

struct evaluate_fn {
  template <class F, class X, class Y, class W>
  void operator()(F const& f, X const& y, Y& v, W& w) const {
    check_argument(f, y);
    check_rows("f", v, index(f.rows()), "rows() of the function");
    if constexpr (requires { f.value(y, v, w); }) {
      f.value(y, v, w);
    } else {
      f.value(y, v);
    }
  }
  template <class F, class X>
  [[nodiscard]] auto operator()(F const& f, X const& y) const {
    auto v = slant::like(y, f.rows());
    into(f, y, v);
    return v;
  }

 private:
  /// Not inlined: g++ 12 would see Eigen free v twice, were it resized here and `new` to throw.
  template <class F, class X, class Y>
  [[gnu::noinline]] static void into(F const& f, X const& y, Y& v) {
    auto w = slant::workspace(f, y);
    evaluate_fn{}(f, y, v, w);
  }
};

struct update_slant_fn {
  template <class F, class X, class G, class W>
  void operator()(F const& f, X const& y, G& g, W& w) const {
    check_argument(f, y);
    if constexpr (requires { f.slant(y, g, w); }) {
      f.slant(y, g, w);
    } else if constexpr (requires { f.slant(y, g); }) {
      f.slant(y, g);
    } else {
      g = f.slant(y);
    }
  }
};

struct slant_from_value_fn {
  template <class F, class X, class W>
  [[nodiscard]] auto operator()(F const& f, X const& y, W const& w) const {
    check_argument(f, y);
    if constexpr (requires { f.slant_from_value(y, w); }) {
      return f.slant_from_value(y, w);
    } else {
      return f.slant(y);
    }
  }
};

struct update_slant_after_value_fn {
  template <class F, class X, class G, class W>
  void operator()(F const& f, X const& y, G& g, W& w) const {
    check_argument(f, y);
    if constexpr (requires { f.slant_after_value(y, g, w); }) {
      f.slant_after_value(y, g, w);
    } else {
      update_slant_fn{}(f, y, g, w);
    }
  }
};

}  // namespace detail

/// F(y): evaluate(f, y, v, w) in place, evaluate(f, y) as a new vector.
/// Throws bad_input if y has not cols() rows, or v not rows().
inline constexpr detail::evaluate_fn evaluate{};

/// G = F°(y), in place if the function can.
inline constexpr detail::update_slant_fn update_slant{};

/// F°(y) as a new operator, right after evaluate(f, y, v, w) with the same y and w.
inline constexpr detail::slant_from_value_fn slant_from_value{};

/// G = F°(y) right after evaluate(f, y, v, w) with the same y and w: nothing that w holds is
/// computed again. The caller answers for "the same y"; update_slant has no such condition.
inline constexpr detail::update_slant_after_value_fn update_slant_after_value{};

/// Empty base of slanting functions that want `f + g`, `f - g`, `α * f`, `A * f`, `f * g`, `-f`.
/// The named factories (compose, stack, max, ...) need no base. Why a base at all: without a vector
/// type nothing else tells a function (value, slant) from an operator (apply) by its members.
struct slanting_base {};

/// A map whose type is marked, whatever the vectors.
template <class F>
concept slanting_map = std::is_base_of_v<slanting_base, std::remove_cvref_t<F>> &&
                       has_rows<std::remove_cvref_t<F>> && has_cols<std::remove_cvref_t<F>>;

}  // namespace slant
