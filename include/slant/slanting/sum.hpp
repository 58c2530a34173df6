// SPDX-License-Identifier: MIT
//
// The sum of two slanting functions: (F + G)° = F° + G°.
#pragma once

#include <slant/operators/sum.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/parts/pairs.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

// --- two terms -----------------------------------------------------------------------------------
//
// What the sum and the difference of two slanting functions share.

/// Temporaries of a function of two functions; `other` holds the values of the second.
template <class First, class Second, class Vector>
struct two_terms_workspace {
  First first;
  Second second;
  Vector other;
};

/// F(y) ± G(y). Rule::combine(v, other) joins the values, rule(F°, G°) the slanting operators.
template <class Rule, class F, class G>
class two_terms : public function_pair<F, G> {
  using pair = function_pair<F, G>;

 public:
  using pair::left;
  using pair::pair;
  using pair::right;
  using pair::rows;

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    using first = decltype(slant::workspace(left(), y));
    using second = decltype(slant::workspace(right(), y));
    return two_terms_workspace<first, second, plain_t<Y>>{
        slant::workspace(left(), y), slant::workspace(right(), y), slant::like(y, rows())};
  }
  template <class Y, class V, class W>
    requires pair::template
  usable<plain_t<Y>> void value(Y const& y, V& v, W& w) const {
    slant::evaluate(left(), y, v, w.first);
    slant::evaluate(right(), y, w.other, w.second);
    Rule::combine(slant::local(v), slant::local(w.other));
  }
  template <class Y>
    requires pair::template
  usable<plain_t<Y>> [[nodiscard]] auto slant(Y const& y) const {
    return assembled_operator(Rule{}, left().slant(y), right().slant(y));
  }
  template <class Y, class W>
    requires pair::template
  usable<plain_t<Y>> [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return assembled_operator(Rule{}, slant::slant_from_value(left(), y, w.first),
                              slant::slant_from_value(right(), y, w.second));
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    slant::update_slant(left(), y, s.template part<0>(), w.first);
    slant::update_slant(right(), y, s.template part<1>(), w.second);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    slant::update_slant_after_value(left(), y, s.template part<0>(), w.first);
    slant::update_slant_after_value(right(), y, s.template part<1>(), w.second);
  }
};

}  // namespace slant::detail

namespace slant {

// --- sum -----------------------------------------------------------------------------------------

namespace detail {

struct sum_rule {
  template <class V, class T>
  static void combine(V&& v, T const& other) {
    v += other;
  }
  template <class A, class B>
  [[nodiscard]] sum_operator<A const&, B const&> operator()(A const& a, B const& b) const {
    return sum_operator<A const&, B const&>(a, b);
  }
};

}  // namespace detail

/// F(y) + G(y). F and G are `Function const&` (referenced) or function types (owned).
template <class F, class G>
using sum_map = detail::two_terms<detail::sum_rule, F, G>;

/// y ↦ F(y) + G(y), also spelled f + g. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto add(F&& f, G&& g) {
  return sum_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

// --- difference ----------------------------------------------------------------------------------
//
// The difference of two slanting functions: (F − G)° = F° − G°.

namespace detail {

struct difference_rule {
  template <class V, class T>
  static void combine(V&& v, T const& other) {
    v -= other;
  }
  template <class A, class B>
  [[nodiscard]] difference_operator<A const&, B const&> operator()(A const& a, B const& b) const {
    return difference_operator<A const&, B const&>(a, b);
  }
};

}  // namespace detail

/// F(y) − G(y). F and G are `Function const&` (referenced) or function types (owned).
template <class F, class G>
using difference_map = detail::two_terms<detail::difference_rule, F, G>;

/// y ↦ F(y) − G(y), also spelled f - g. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto subtract(F&& f, G&& g) {
  return difference_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
