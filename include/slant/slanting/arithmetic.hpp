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

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/parts/pairs.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

// --- sum -----------------------------------------------------------------------------------------
//
// The sum of two slanting functions: (F + G)° = F° + G°.

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
  [[nodiscard]] auto operator()(A const& a, B const& b) const {
    return expr::add(expr::view(a), expr::view(b));
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
  [[nodiscard]] auto operator()(A const& a, B const& b) const {
    return expr::add(expr::view(a), expr::negate(expr::view(b)));
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

// --- scaled --------------------------------------------------------------------------------------
//
// A multiple of a slanting function: (c F)° = c F°. `positive(c) * f` keeps the laws of F° that
// hold for positive multiples only.

namespace detail {

template <class S, bool Positive>
struct scaled_rule {
  S factor;

  template <class A>
  [[nodiscard]] auto operator()(A const& a) const {
    constexpr expr::sign sign = Positive ? expr::sign::plus : expr::sign::any;
    return expr::multiply_by(expr::number<S, sign>{factor, S(1)}, expr::view(a));
  }
};

}  // namespace detail

/// c F(y). F is `Function const&` (referenced) or a function type (owned).
template <class S, class F, bool Positive>
class scaled_map : public slanting_base {
  using inner_type = std::remove_cvref_t<F>;
  using rule = detail::scaled_rule<S, Positive>;

 public:
  /// c is finite, and > 0 if Positive; slant::scale checks it.
  scaled_map(S c, held<F> f) : c_(std::move(c)), f_(std::move(f)) {}

  [[nodiscard]] index rows() const { return inner().rows(); }
  [[nodiscard]] index cols() const { return inner().cols(); }
  [[nodiscard]] S const& factor() const noexcept { return c_; }
  [[nodiscard]] inner_type const& inner() const noexcept { return f_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return slant::workspace(inner(), y);
  }
  template <class Y, class V, class W>
    requires slanting_function<inner_type, plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    slant::evaluate(inner(), y, v, w);
    vectors::scale(static_cast<scalar_t<Y>>(c_), v);
  }
  template <class Y>
    requires slanting_function<inner_type, plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    return detail::assembled_operator(rule{c_}, inner().slant(y));
  }
  template <class Y, class W>
    requires slanting_function<inner_type, plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return detail::assembled_operator(rule{c_}, slant::slant_from_value(inner(), y, w));
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    g.rule() = rule{c_};
    slant::update_slant(inner(), y, g.template part<0>(), w);
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    g.rule() = rule{c_};
    slant::update_slant_after_value(inner(), y, g.template part<0>(), w);
  }

 private:
  S c_;
  held<F> f_;
};

/// y ↦ c F(y), also spelled c * f. An lvalue f is referenced.
/// @throws bad_input if c is NaN or infinite.
template <class S, slanting_part F>
  requires scalar<S> || std::is_integral_v<S>
[[nodiscard]] auto scale(S c, F&& f) {
  if (!detail::is_finite(c)) throw bad_input("c", detail::show(c), "a finite number");
  return scaled_map<S, kept_t<F>, false>(std::move(c), std::forward<F>(f));
}

/// y ↦ c F(y) for a factor known to be positive: scale(positive(ρ), f).
template <class S, slanting_part F>
[[nodiscard]] auto scale(positive_factor<S> c, F&& f) {
  return scaled_map<S, kept_t<F>, true>(c.value(), std::forward<F>(f));
}

// --- arithmetic ----------------------------------------------------------------------------------

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
