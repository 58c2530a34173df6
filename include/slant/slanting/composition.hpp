// SPDX-License-Identifier: MIT
//
// The composition of two slanting functions and its chain rule (F∘G)°(y) = F°(G(y)) G°(y).
//
// Both value and slant need G(y). update_slant_after_value takes it from the workspace, so a Newton
// step that has just evaluated the residual at y costs one evaluation of G, not two.
#pragma once

#include <slant/operators/product.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

struct product_rule {
  template <class A, class B>
  [[nodiscard]] auto operator()(A const& a, B const& b) const {
    return expr::make_product(expr::one{}, boost::hana::make_tuple(expr::view(a), expr::view(b)));
  }
};

/// `between` holds G(y).
template <class Inner, class Vector, class Outer>
struct composition_workspace {
  Inner inner;
  Vector between;
  Outer outer;
};

}  // namespace detail

/// F(G(y)). F and G are `Function const&` (referenced) or function types (owned).
template <class F, class G>
class composition_map : public slanting_base {
  using outer_type = std::remove_cvref_t<F>;
  using inner_type = std::remove_cvref_t<G>;

 public:
  /// @throws bad_input unless F takes as many arguments as G has values.
  composition_map(held<F> f, held<G> g) : f_(std::move(f)), g_(std::move(g)) {
    detail::require_equal_sizes("g.rows()", inner().rows(), outer().cols(), "f.cols()");
  }

  [[nodiscard]] index rows() const { return outer().rows(); }
  [[nodiscard]] index cols() const { return inner().cols(); }
  [[nodiscard]] outer_type const& outer() const noexcept { return f_.get(); }
  [[nodiscard]] inner_type const& inner() const noexcept { return g_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    auto between = slant::like(y, inner().rows());
    using inner_workspace = decltype(slant::workspace(inner(), y));
    using outer_workspace = decltype(slant::workspace(outer(), between));
    auto outer_temporaries = slant::workspace(outer(), between);
    return detail::composition_workspace<inner_workspace, decltype(between), outer_workspace>{
        slant::workspace(inner(), y), std::move(between), std::move(outer_temporaries)};
  }
  template <class Y, class V, class W>
    requires slanting_function<inner_type, plain_t<Y>> && slanting_function<outer_type, plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    slant::evaluate(inner(), y, w.between, w.inner);
    slant::evaluate(outer(), w.between, v, w.outer);
  }
  template <class Y>
    requires slanting_function<inner_type, plain_t<Y>> && slanting_function<outer_type, plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    auto const between = slant::evaluate(inner(), y);
    return detail::assembled_operator(detail::product_rule{}, outer().slant(between),
                                      inner().slant(y));
  }
  template <class Y, class W>
    requires slanting_function<inner_type, plain_t<Y>> && slanting_function<outer_type, plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return detail::assembled_operator(detail::product_rule{},
                                      slant::slant_from_value(outer(), w.between, w.outer),
                                      slant::slant_from_value(inner(), y, w.inner));
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    slant::evaluate(inner(), y, w.between, w.inner);
    slant::update_slant(outer(), w.between, s.template part<0>(), w.outer);
    slant::update_slant_after_value(inner(), y, s.template part<1>(), w.inner);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    slant::update_slant_after_value(outer(), w.between, s.template part<0>(), w.outer);
    slant::update_slant_after_value(inner(), y, s.template part<1>(), w.inner);
  }

 private:
  held<F> f_;
  held<G> g_;
};

/// F∘G: y ↦ F(G(y)), also spelled f * g. Lvalues are referenced.
/// @throws bad_input unless F takes as many arguments as G has values.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto compose(F&& f, G&& g) {
  return composition_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
