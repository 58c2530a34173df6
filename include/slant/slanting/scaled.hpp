// SPDX-License-Identifier: MIT
//
// A multiple of a slanting function: (c F)° = c F°. `positive(c) * f` keeps the laws of F° that
// hold for positive multiples only.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/scaled.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/slanting_base.hpp>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

template <class S, bool Positive>
struct scaled_rule {
  S factor;

  template <class A>
  [[nodiscard]] scaled_operator<S, A const&, Positive> operator()(A const& a) const {
    return scaled_operator<S, A const&, Positive>(factor, a);
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

}  // namespace slant
