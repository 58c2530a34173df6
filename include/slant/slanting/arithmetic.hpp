// SPDX-License-Identifier: MIT
//
// Formulas with slanting functions, as they stand on paper:
//
//     slant::identity_map const x(n);
//     auto F = x - projection(Λ) * (x - ρ * (A * x - b));
//     std::cout << F;                // x ↦ x − P(x − 0.5 (A x − c))   (12 → 12)
//     std::cout << F.slant(y);       // I − P° (I − 0.5 A)   (12 × 12, no laws)
//
//     f + g, f - g, -f     sums and differences, kept flat:  (F ± G)° = F° ± G°
//     f + c, f - c         c a vector:  (F ± c)° = F°
//     c * f                c a number > 0, or any_sign(c):  (c F)° = c F°
//     f * g                compose(f, g): y ↦ f(g(y)), as for operators; never a pointwise product
//     A * f, f * A         A an operator or Eigen matrix: compose with y ↦ A y
//
// Found by argument-dependent lookup for every type derived from slanting_base; for other types use
// the named functions.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/syntax.hpp>
#include <slant/slanting/affine.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <boost/hana/concat.hpp>
#include <boost/hana/tuple.hpp>

#include <ostream>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// Temporaries of each term; `other` holds the values of all but the first, one after the other.
template <class Inner, class Vector>
struct sum_map_workspace {
  Inner inner;
  Vector other;
};

}  // namespace detail

/// F₁(y) + F₂(y) + …; F₁ − F₂ has the term −F₂.
template <class... F>
class sum_map : public slanting_base {
  static constexpr std::make_index_sequence<sizeof...(F) - 1> rest{};
  template <class V>
  static constexpr bool usable = (slanting_function<std::remove_cvref_t<F>, V> && ...);

 public:
  using parts_type = boost::hana::tuple<held<F>...>;

  /// The sizes agree.
  explicit sum_map(parts_type parts) : parts_(std::move(parts)) {}

  [[nodiscard]] index rows() const { return term<0>().rows(); }
  [[nodiscard]] index cols() const { return term<0>().cols(); }
  /// F_{I+1}.
  template <std::size_t I>
  [[nodiscard]] auto const& term() const noexcept {
    return boost::hana::at_c<I>(parts_).get();
  }
  /// The terms, as they are kept.
  [[nodiscard]] parts_type&& parts() && noexcept { return std::move(parts_); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    using inner = boost::hana::tuple<decltype(slant::workspace(
        std::declval<std::remove_cvref_t<F> const&>(), y))...>;
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return detail::sum_map_workspace<inner, plain_t<Y>>{inner{slant::workspace(term<I>(), y)...},
                                                          slant::like(y, rows())};
    }(std::index_sequence_for<F...>{});
  }
  template <class Y, class V, class W>
    requires usable<plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    slant::evaluate(term<0>(), y, v, boost::hana::at_c<0>(w.inner));
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (add(term<I + 1>(), y, v, w.other, boost::hana::at_c<I + 1>(w.inner)), ...);
    }(rest);
  }
  template <class Y>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    return slants([&](auto const& f, auto) { return f.slant(y); });
  }
  template <class Y, class W>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return slants([&](auto const& f, auto i) {
      return slant::slant_from_value(f, y, boost::hana::at_c<i()>(w.inner));
    });
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i) {
      slant::update_slant(f, y, g.template term<i()>(), boost::hana::at_c<i()>(w.inner));
    });
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    for_each([&](auto const& f, auto i) {
      slant::update_slant_after_value(f, y, g.template term<i()>(),
                                      boost::hana::at_c<i()>(w.inner));
    });
  }

  [[nodiscard]] detail::written write(detail::written const& y) const {
    detail::written sum;
    for_each([&](auto const& f, auto i) { sum.append(detail::write(f, y), i() == 0); });
    return sum;
  }

 private:
  /// v ← v + f(y). The number in front of a composition goes into the addition.
  template <class T, class Y, class V, class O, class W>
  static void add(T const& f, Y const& y, V& v, O& other, W& w) {
    if constexpr (detail::is_composition<T>) {
      f.value_without_number(y, other, w);
      vectors::axpy(expr::value_as<scalar_t<Y>>(f.coefficient()), other, v);
    } else {
      slant::evaluate(f, y, other, w);
      vectors::add(other, v);
    }
  }
  template <class Slant>
  [[nodiscard]] auto slants(Slant const& slant_of) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return expr::make_sum(boost::hana::make_tuple(
          slant_of(term<I>(), std::integral_constant<std::size_t, I>{})...));
    }(std::index_sequence_for<F...>{});
  }
  /// visit(term, its number as a constant).
  template <class Visit>
  void for_each(Visit const& visit) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit(term<I>(), std::integral_constant<std::size_t, I>{}), ...);
    }(std::index_sequence_for<F...>{});
  }

  parts_type parts_;
};

template <class... F>
sum_map(boost::hana::tuple<held<F>...>) -> sum_map<F...>;

namespace detail {

template <class F>
inline constexpr bool is_sum_map = false;
template <class... F>
inline constexpr bool is_sum_map<sum_map<F...>> = true;

/// The terms of an own sum; anything else is one term.
template <class F>
[[nodiscard]] auto terms_of_function(F&& f) {
  if constexpr (!std::is_lvalue_reference_v<F> && is_sum_map<F>) {
    return std::move(f).parts();
  } else {
    return boost::hana::tuple<held<kept_t<F>>>(held<kept_t<F>>(std::forward<F>(f)));
  }
}

/// Throws bad_input unless f and g have as many values and arguments.
template <class F, class G>
void require_terms(F const& f, G const& g) {
  require_equal_sizes("g.rows()", g.rows(), f.rows(), "f.rows()");
  require_equal_sizes("g.cols()", g.cols(), f.cols(), "f.cols()");
}

}  // namespace detail

/// y ↦ F(y) + G(y), also spelled f + g. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto add(F&& f, G&& g) {
  detail::require_terms(f, g);
  return sum_map(boost::hana::concat(detail::terms_of_function(std::forward<F>(f)),
                                     detail::terms_of_function(std::forward<G>(g))));
}

/// y ↦ F(y) − G(y), also spelled f - g. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto subtract(F&& f, G&& g) {
  detail::require_terms(f, g);
  return slant::add(std::forward<F>(f), detail::scale_by(expr::minus_one{}, std::forward<G>(g)));
}

/// y ↦ c F(y), also spelled c * f. An lvalue f is referenced. F° keeps the laws that hold for
/// positive multiples, so a plain c is > 0; any_sign(c) loses them.
/// @throws bad_input unless 0 < c < ∞, or c is marked by any_sign.
template <expr::number_in_front S, slanting_part F>
[[nodiscard]] auto scale(S const& c, F&& f) {
  auto const number = expr::as_number(c);
  if constexpr (expr::sign_of<std::remove_const_t<decltype(number)>> == expr::sign::plus) {
    if (!(number.value > decltype(number.value)(0))) {
      throw bad_input("c", detail::show(number.value),
                      "a number > 0 in front of a function; for others write -(c * f) or "
                      "any_sign(c) * f");
    }
  }
  return detail::scale_by(number, std::forward<F>(f));
}

/// An operator or Eigen matrix that is not itself a slanting function.
template <class A> concept linear_factor = operand<A> && !slanting_map<A>;

/// A vector that is added to the values of a function.
template <class C> concept constant_term = has_like<std::remove_cvref_t<C>> && !slanting_map<C>;

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
  return detail::scale_by(expr::minus_one{}, std::forward<F>(f));
}

template <slanting_map F, constant_term C>
[[nodiscard]] auto operator+(F&& f, C&& c) {
  return detail::shifted_by<false>(std::forward<F>(f), std::forward<C>(c));
}
template <slanting_map F, constant_term C>
[[nodiscard]] auto operator-(F&& f, C&& c) {
  return detail::shifted_by<true>(std::forward<F>(f), std::forward<C>(c));
}

template <constant_term C, slanting_map F>
[[nodiscard]] auto operator+(C&& c, F&& f) {
  return detail::shifted_by<false>(std::forward<F>(f), std::forward<C>(c));
}
template <constant_term C, slanting_map F>
[[nodiscard]] auto operator-(C&& c, F&& f) {
  return detail::shifted_by<false>(-std::forward<F>(f), std::forward<C>(c));
}

template <class S, slanting_map F>
  requires expr::number_in_front<S>
[[nodiscard]] auto operator*(S const& c, F&& f) {
  return slant::scale(c, std::forward<F>(f));
}

template <slanting_map F, slanting_map G>
[[nodiscard]] auto operator*(F&& f, G&& g) {
  return slant::compose(std::forward<F>(f), std::forward<G>(g));
}
template <linear_factor A, slanting_map F>
[[nodiscard]] auto operator*(A&& a, F&& f) {
  if constexpr (std::is_same_v<std::remove_cvref_t<F>, identity_map>) {
    detail::require_cols("A", a, f.rows(), "the size of x");
    return slant::linear(std::forward<A>(a));
  } else {
    return slant::compose(slant::linear(std::forward<A>(a)), std::forward<F>(f));
  }
}
template <slanting_map F, linear_factor A>
[[nodiscard]] auto operator*(F&& f, A&& a) {
  return slant::compose(std::forward<F>(f), slant::linear(std::forward<A>(a)));
}

/// x ↦ x − P(x − 0.5 (A x − c))   (12 → 12)
template <slanting_map F>
std::ostream& operator<<(std::ostream& out, F const& f) {
  return out << "x ↦ " << detail::write(f, {"x", false}).text << "   (" << f.cols() << " → "
             << f.rows() << ")";
}

}  // namespace slant
