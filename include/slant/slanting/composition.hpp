// SPDX-License-Identifier: MIT
//
// c F₁∘F₂∘…∘F_n: a number and one flat sequence of slanting functions. Its slanting operator is the
// flat product of theirs, each where it is evaluated (chain rule):
//
//     (c F₁∘…∘F_n)°(y) = c F₁°(z₁) … F_n°(z_n),     z_n = y,  z_k = F_{k+1}(z_{k+1})
//
// Both value and slant need the z. slant_after_value takes them from the workspace, so a Newton step
// that has just evaluated the residual at y costs one evaluation of each function, not two.
#pragma once

#include <slant/operators/product.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <boost/hana/concat.hpp>
#include <boost/hana/tuple.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// c F₁∘…∘F_n, C a number of operators/factors.hpp.
template <class C, class... F>
class composition_map : public slanting_base {
  static constexpr std::size_t n = sizeof...(F);
  template <class V>
  static constexpr bool usable = (slanting_function<std::remove_cvref_t<F>, V> && ...);

 public:
  using parts_type = boost::hana::tuple<held<F>...>;

  /// The sizes fit.
  composition_map(C c, parts_type parts) : c_(std::move(c)), parts_(std::move(parts)) {}

  [[nodiscard]] index rows() const { return function<0>().rows(); }
  [[nodiscard]] index cols() const { return function<n - 1>().cols(); }
  /// c.
  [[nodiscard]] C const& coefficient() const noexcept { return c_; }
  /// F_{K+1}.
  template <std::size_t K>
  [[nodiscard]] auto const& function() const noexcept {
    return boost::hana::at_c<K>(parts_).get();
  }
  /// The functions, as they are kept.
  [[nodiscard]] parts_type&& parts() && noexcept { return std::move(parts_); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    auto const inner = [&]<std::size_t K>(std::integral_constant<std::size_t, K>) {
      if constexpr (K == n - 1) {
        return slant::workspace(function<K>(), y);
      } else {
        return slant::workspace(function<K>(), slant::like(y, function<K>().cols()));
      }
    };
    return [&]<std::size_t... K, std::size_t... B>(std::index_sequence<K...>,
                                                   std::index_sequence<B...>) {
      using parts =
          boost::hana::tuple<decltype(inner(std::integral_constant<std::size_t, K>{}))...>;
      using workspace_type = expr::product_workspace<plain_t<Y>, n, parts>;
      if constexpr (n == 1) {
        return workspace_type{parts{inner(std::integral_constant<std::size_t, K>{})...}};
      } else {
        return workspace_type{{slant::like(y, function<B>().cols())...},
                              parts{inner(std::integral_constant<std::size_t, K>{})...}};
      }
    }(std::make_index_sequence<n>{}, std::make_index_sequence<n - 1>{});
  }
  template <class Y, class V, class W>
    requires usable<plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    value_without_number(y, v, w);
    if constexpr (!std::is_same_v<C, expr::one>) {
      vectors::scale(expr::value_as<scalar_t<Y>>(c_), v);
    }
  }
  /// F₁(…(F_n(y))).
  template <class Y, class V, class W>
  void value_without_number(Y const& y, V& v, W& w) const {
    evaluate_arguments<n - 1>(y, w);
    slant::evaluate(function<0>(), argument<0>(y, w), v, boost::hana::at_c<0>(w.inner));
  }

  template <class Y>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    auto w = workspace(y);
    evaluate_arguments<n - 1>(y, w);
    return slants(y, w, function<0>().slant(argument<0>(y, w)));
  }
  template <class Y, class W>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return slants(
        y, w,
        slant::slant_from_value(function<0>(), argument<0>(y, w), boost::hana::at_c<0>(w.inner)));
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    evaluate_arguments<n - 1>(y, w);
    slant::update_slant(function<0>(), argument<0>(y, w), slant_of<0>(g),
                        boost::hana::at_c<0>(w.inner));
    renew_after_value<1>(y, g, w);
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    renew_after_value<0>(y, g, w);
  }

  [[nodiscard]] detail::written write(detail::written y) const {
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      ((y = detail::write(function<n - 1 - K>(), y)), ...);
    }(std::make_index_sequence<n>{});
    std::string const number = expr::text_in_front(c_);
    return number.empty() ? y : detail::written{number + y.as_factor(), false};
  }

 private:
  /// z_K, which is in the workspace but for the last one.
  template <std::size_t K, class Y, class W>
  [[nodiscard]] static auto const& argument(Y const& y, W& w) {
    if constexpr (K == n - 1) {
      return y;
    } else {
      return w.between[K];
    }
  }
  /// z_{K−1}, …, z₀.
  template <std::size_t K, class Y, class W>
  void evaluate_arguments(Y const& y, W& w) const {
    if constexpr (K > 0) {
      slant::evaluate(function<K>(), argument<K>(y, w), w.between[K - 1],
                      boost::hana::at_c<K>(w.inner));
      evaluate_arguments<K - 1>(y, w);
    }
  }
  template <class Y, class W, class First>
  [[nodiscard]] auto slants(Y const& y, W const& w, First first) const {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      return expr::make_product(
          c_,
          boost::hana::make_tuple(std::move(first),
                                  slant::slant_from_value(function<K + 1>(), argument<K + 1>(y, w),
                                                          boost::hana::at_c<K + 1>(w.inner))...));
    }(std::make_index_sequence<n - 1>{});
  }
  template <std::size_t K, class Y, class G, class W>
  void renew_after_value(Y const& y, G& g, W& w) const {
    if constexpr (K < n) {
      slant::update_slant_after_value(function<K>(), argument<K>(y, w), slant_of<K>(g),
                                      boost::hana::at_c<K>(w.inner));
      renew_after_value<K + 1>(y, g, w);
    } else if constexpr (!std::is_same_v<C, expr::one>) {
      g.coefficient() = c_;
    }
  }
  /// The slanting operator of F_{K+1} in that of the composition, which make_product gives bare if
  /// it is the only one and has no number.
  template <std::size_t K, class G>
  [[nodiscard]] static auto& slant_of(G& g) {
    if constexpr (n == 1 && std::is_same_v<C, expr::one>) {
      return g;
    } else {
      return g.template factor<K>();
    }
  }

  [[no_unique_address]] C c_;
  parts_type parts_;
};

template <class C, class... F>
composition_map(C, boost::hana::tuple<held<F>...>) -> composition_map<C, F...>;

namespace detail {

template <class F>
inline constexpr bool is_composition = false;
template <class C, class... F>
inline constexpr bool is_composition<composition_map<C, F...>> = true;

/// An own composition is taken apart; what is referenced stays whole.
template <class F> concept own_composition = !std::is_lvalue_reference_v<F> && is_composition<F>;

/// Its number.
template <class F>
[[nodiscard]] auto coefficient_in_front(F const& f) {
  if constexpr (own_composition<F>) {
    return f.coefficient();
  } else {
    return expr::one{};
  }
}
template <slanting_part F>
[[nodiscard]] auto parts_of_function(F&& f) {
  if constexpr (own_composition<F>) {
    return std::move(f).parts();
  } else {
    return boost::hana::tuple<held<kept_t<F>>>(held<kept_t<F>>(std::forward<F>(f)));
  }
}

/// What stands inside of a composition: of an own one without a number its parts.
template <slanting_part G>
[[nodiscard]] auto inner_parts(G&& g) {
  if constexpr (std::is_same_v<decltype(coefficient_in_front<G>(g)), expr::one>) {
    return parts_of_function(std::forward<G>(g));
  } else {
    return boost::hana::tuple<held<kept_t<G>>>(held<kept_t<G>>(std::forward<G>(g)));
  }
}

/// c F, whatever the number.
template <class C, class F>
[[nodiscard]] auto scale_by(C const& c, F&& f) {
  auto const product = expr::multiply_numbers(c, detail::coefficient_in_front<F>(f));
  return composition_map(product, detail::parts_of_function(std::forward<F>(f)));
}

}  // namespace detail

/// F∘G: y ↦ F(G(y)), also spelled f * g. Lvalues are referenced.
/// @throws bad_input unless F takes as many arguments as G has values.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto compose(F&& f, G&& g) {
  detail::require_equal_sizes("g.rows()", g.rows(), f.cols(), "f.cols()");
  auto const c = detail::coefficient_in_front<F>(f);
  return composition_map(c, boost::hana::concat(detail::parts_of_function(std::forward<F>(f)),
                                                detail::inner_parts(std::forward<G>(g))));
}

}  // namespace slant
